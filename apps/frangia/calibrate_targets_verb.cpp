#include "calibrate_targets_verb.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/calibrate/board/write_targets_pdf.h"
#include "frangia/core/error.h"
#include "frangia/core/text.h"

#include "option_values.h"
#include "print_text.h"

namespace frangia {
namespace {

struct TargetsArguments {
  std::filesystem::path output;
  std::string paper = "a4";
  std::size_t discs = 40;
  std::size_t coded = 20;
  TargetSet targets{.diameter_mm = 5.0, .dictionary = "DICT_4X4_50", .marker_mm = 10.0};
  bool light = false;
  int first_code = 0;
};

void calibrate_targets_verb(TargetsArguments arguments, Terminal& terminal) {
  require(
      lowercase_extension(arguments.output) == ".pdf",
      "targets are written as .pdf, which prints at true scale; give a file name that ends with "
      ".pdf");
  TargetSet& targets = arguments.targets;
  if (arguments.light) targets.tone = TargetTone::Light;
  if (arguments.discs == 0) targets.diameter_mm = 0.0;
  if (arguments.coded == 0) {
    targets.dictionary.clear();
    targets.marker_mm = 0.0;
  }
  require(arguments.discs + arguments.coded > 0,
          "there is no target to print; set `discs` or `coded` above 0");
  const PrintedTargets printed = write_targets_pdf(arguments.output,
                                                   targets,
                                                   arguments.discs,
                                                   arguments.coded,
                                                   arguments.first_code,
                                                   paper_size(arguments.paper));
  if (terminal.json) {
    print_json({{"file", arguments.output.string()},
                {"discs", printed.discs},
                {"coded", printed.coded},
                {"pages", printed.pages},
                {"diameter_mm", targets.diameter_mm},
                {"dictionary", targets.dictionary},
                {"marker_mm", targets.marker_mm}});
    return;
  }
  if (!terminal.quiet) {
    print_text("# for scan.toml, once the ruler on the print measures 100 mm\n[targets]\n");
    if (printed.discs > 0) {
      print_text("diameter_mm = {:g}\ndisc = \"{}\"\n",
                 targets.diameter_mm,
                 arguments.light ? "light" : "dark");
    }
    if (printed.coded > 0) {
      print_text("dictionary = \"{}\"\nmarker_mm = {:g}\n", targets.dictionary, targets.marker_mm);
    }
  }
  terminal.print_written(arguments.output.string());
}

}  // namespace

void add_calibrate_targets_verb(CLI::App& calibrate, Terminal& terminal) {
  auto arguments = std::make_shared<TargetsArguments>();
  CLI::App* verb = calibrate.add_subcommand(
      "targets", "write round stickers to print, which tie the views of parts without shape");
  verb->footer("Example:\n  frangia calibrate targets --diameter 4mm --coded 12 -o targets.pdf");
  verb->add_option("-o,--output", arguments->output, "PDF to write")->required();
  verb->add_option("--paper", arguments->paper, "a5, a4, a3 or letter")
      ->check(one_of({"a5", "a4", "a3", "letter"}))
      ->capture_default_str();
  verb->add_option("--discs", arguments->discs, "number of uncoded targets")
      ->check(from_to(0, 10000))
      ->capture_default_str();
  verb->add_option("--diameter", arguments->targets.diameter_mm, "of the discs, mm")
      ->transform(length_above_zero())
      ->capture_default_str();
  verb->add_flag("--light", arguments->light, "light discs on dark stickers, for dark parts");
  verb->add_option("--coded", arguments->coded, "number of coded targets")
      ->check(from_to(0, 250))
      ->capture_default_str();
  verb->add_option("--marker", arguments->targets.marker_mm, "side of a coded target's marker, mm")
      ->transform(length_above_zero())
      ->capture_default_str();
  verb->add_option("--dictionary",
                   arguments->targets.dictionary,
                   "of the coded targets, as OpenCV names it: DICT_4X4_50 to DICT_7X7_250")
      ->capture_default_str();
  verb->add_option("--first-code", arguments->first_code, "code of the first coded target")
      ->check(from_to(0, 249))
      ->capture_default_str();
  verb->callback([arguments, &terminal] { calibrate_targets_verb(*arguments, terminal); });
}

}  // namespace frangia
