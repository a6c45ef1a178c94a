#include "calibrate_refine_verb.h"

#include <filesystem>
#include <memory>

#include <nlohmann/json.hpp>

#include "frangia/reconstruct/refine_scan_rig.h"
#include "frangia/rig/write_rig.h"

#include "check_can_write.h"
#include "option_values.h"
#include "print_text.h"
#include "reconstruct_options.h"
#include "refinement_text.h"

namespace frangia {
namespace {

struct RefineArguments {
  std::filesystem::path scan;
  std::filesystem::path output;
  ReconstructOptions options;
};

void calibrate_refine_verb(const RefineArguments& arguments, Terminal& terminal) {
  check_can_write(arguments.output);
  const Run run = terminal.run();
  const Scan scan = read_scan(arguments.scan, run);
  RigRefinement result = refine_scan_rig(scan, arguments.options, run);
  if (result.rig.calibration && !result.rig.calibration->covariance.empty()) {
    result.rig.calibration->covariance_file = arguments.output.stem().string() + "-covariance.csv";
  }
  write_rig(arguments.output, result.rig, Durability::Buffered, scan.folder / "rig.toml");
  terminal.finish();
  if (terminal.json) {
    nlohmann::ordered_json json = json_of(result);
    json["rig"] = arguments.output.string();
    json["warnings"] = terminal.warnings();
    print_json(json);
    return;
  }
  if (!terminal.quiet) {
    print_text("{}\n", result.text());
    print_changes(result);
  }
  terminal.print_written(arguments.output.string());
}

}  // namespace

void add_calibrate_refine_verb(CLI::App& calibrate, Terminal& terminal) {
  auto arguments = std::make_shared<RefineArguments>();
  CLI::App* verb = calibrate.add_subcommand(
      "refine", "refine a rig that drifted, by the views of a scan of any part");
  verb->footer(
      "Example:\n  frangia calibrate refine part-scan -o rig.toml\n"
      "The rig of the scan is the start. What the part does not determine is held and named.");
  verb->add_option("SCAN", arguments->scan, "the scan folder, with scan.toml and rig.toml")
      ->required();
  verb->add_option("-o,--output", arguments->output, "rig.toml to write")->required();
  add_known_length(*verb, arguments->options.refinement.ball_distance_mm);
  verb->add_option("--clip-below",
                   arguments->options.clip_below_mm,
                   "ignore points below this height over the turntable's origin, mm")
      ->transform(a_length());
  verb->add_option("--clip-radius",
                   arguments->options.clip_radius_mm,
                   "ignore points farther than this from the turntable's axis, mm")
      ->transform(length_above_zero());
  add_decode_options(*verb, arguments->options.decode);
  verb->callback([arguments, &terminal] { calibrate_refine_verb(*arguments, terminal); });
}

}  // namespace frangia
