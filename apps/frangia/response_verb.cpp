#include <filesystem>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/dataset/read_frames.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/phase/measure_fringe_response.h"
#include "frangia/phase/measure_response.h"
#include "frangia/rig/read_rig.h"

#include "check_can_write.h"
#include "print_text.h"
#include "verbs.h"

namespace frangia {
namespace {

struct ResponseArguments {
  std::filesystem::path scan;
  std::filesystem::path output;
};

void response_verb(const ResponseArguments& arguments, Terminal& terminal) {
  check_can_write(arguments.output);
  const Run run = terminal.run();
  const Scan scan = read_scan(arguments.scan, run);
  std::vector<FrameStack> ramps;
  std::vector<FrameStack> fringes;
  for (std::size_t i = 0; i < scan.views.size(); ++i) {
    for (FrameStack& stack : read_frames(scan, i, run)) {
      if (stack.pattern.kind == PatternKind::Ramp) {
        ramps.push_back(std::move(stack));
      } else if (determines_response(stack.pattern)) {
        fringes.push_back(std::move(stack));
      }
    }
  }
  const ResponseCurve left =
      ramps.empty() ? measure_fringe_response(fringes) : measure_response(ramps);
  Rig rig = scan.rig;
  auto& response = rig.projector.response;
  response = response ? compose(*response, left) : left;
  write_rig(arguments.output, rig);
  terminal.finish();
  if (terminal.json) {
    print_json({{"light", response->light}});
  } else if (!terminal.quiet) {
    print_text("half of full drive gives {:.1f} % of full light\n",
               100.0 * response->light_of(0.5));
    terminal.print_written(arguments.output.string());
  }
}

}  // namespace

void add_response_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<ResponseArguments>();
  CLI::App* verb = program.add_subcommand(
      "response", "measure the response of a projector from a grey ramp or fringes");
  verb->footer(
      "example:\n  frangia simulate plate --display-gamma 2.2 --ramp 17 -o ramp\n"
      "  frangia response ramp -o rig.toml");
  verb->add_option("SCAN",
                   arguments->scan,
                   "scan with a pattern of kind \"ramp\", or with fringes of 6 frames or more")
      ->required();
  verb->add_option("-o,--output", arguments->output, "rig.toml to write, with the response")
      ->required();
  verb->callback([arguments, &terminal] { response_verb(*arguments, terminal); });
}

}  // namespace frangia
