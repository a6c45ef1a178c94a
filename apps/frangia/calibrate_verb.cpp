#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/acquisition/sweep_piezo.h"
#include "frangia/core/angles.h"
#include "frangia/core/durable_file.h"
#include "frangia/rig/read_rig.h"

#ifdef FRANGIA_WITH_CALIBRATION
#include "calibrate_board_verb.h"
#include "calibrate_capture_verb.h"
#include "calibrate_check_verb.h"
#include "calibrate_exchange_verbs.h"
#include "calibrate_rig_verb.h"
#include "calibrate_targets_verb.h"
#include "calibrate_turntable_verb.h"
#endif
#include "calibrate_display_verb.h"
#include "calibrate_refine_verb.h"
#include "check_can_write.h"
#include "drivers.h"
#include "option_values.h"
#include "print_text.h"
#include "verbs.h"

namespace frangia {
namespace {

struct PiezoArguments {
  std::filesystem::path rig;
  std::filesystem::path output;
  SweepOptions options;
};

std::vector<double> degrees(const std::vector<double>& angles_rad) {
  std::vector<double> angles_deg;
  angles_deg.reserve(angles_rad.size());
  for (const double angle_rad : angles_rad)
    angles_deg.push_back(deg_from_rad(angle_rad));
  return angles_deg;
}

std::string lines_of(const PhaseCurve& curve) {
  return fmt::format("curve_commands = [{:.5g}]\ncurve_phases_deg = [{:.3f}]\n",
                     fmt::join(curve.commands, ", "),
                     fmt::join(degrees(curve.phases_rad), ", "));
}

/// The text of the rig with the curve in [devices.fringes] instead of the keys it replaces.
std::string with_curve(const std::filesystem::path& rig, const PhaseCurve& curve) {
  std::ifstream in(rig);
  std::string out;
  bool in_fringes = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind('[', 0) == 0) in_fringes = line.rfind("[devices.fringes]", 0) == 0;
    bool dropped = false;
    for (const auto* key : {"command_per_turn", "curve_commands", "curve_phases_deg"})
      dropped = dropped || (in_fringes && line.rfind(key, 0) == 0);
    if (!dropped) out += line + "\n";
    if (line.rfind("[devices.fringes]", 0) == 0) out += lines_of(curve);
  }
  return out;
}

void calibrate_piezo(const PiezoArguments& arguments, Terminal& terminal) {
  if (!arguments.output.empty()) check_can_write(arguments.output);
  const Run run = terminal.run();
  run.stage("devices");
  const Rig rig = read_rig(arguments.rig, run);
  OpenRig open(arguments.rig, rig, run);
  run.stage("sweep");
  const PiezoSweep sweep = sweep_piezo(open.devices(), rig, arguments.options, run);
  if (!arguments.output.empty()) {
    write_text_file(arguments.output, with_curve(arguments.rig, sweep.curve));
  }
  terminal.finish();
  if (terminal.json) {
    const nlohmann::ordered_json result{{"curve_commands", sweep.curve.commands},
                                        {"curve_phases_deg", degrees(sweep.curve.phases_rad)},
                                        {"residual_ratio", sweep.residual_ratio}};
    print_json(result);
  } else if (!terminal.quiet) {
    write_output("# for [devices.fringes], instead of command_per_turn\n" + lines_of(sweep.curve));
    if (!arguments.output.empty()) terminal.print_written(arguments.output.string());
  }
}

}  // namespace

void add_calibrate_verb(CLI::App& program, Terminal& terminal) {
  auto* verb = program.add_subcommand("calibrate", "calibrate a rig and its devices");
  verb->require_subcommand(1);
#ifdef FRANGIA_WITH_CALIBRATION
  add_calibrate_board_verb(*verb, terminal);
  add_calibrate_targets_verb(*verb, terminal);
  add_calibrate_capture_verb(*verb, terminal);
  add_calibrate_rig_verb(*verb, terminal);
  add_calibrate_turntable_verb(*verb, terminal);
  add_calibrate_check_verb(*verb, terminal);
  add_calibrate_exchange_verbs(*verb, terminal);
#endif
  add_calibrate_refine_verb(*verb, terminal);
  add_calibrate_display_verb(*verb, terminal);
  auto* piezo = verb->add_subcommand(
      "piezo", "measure the phase shift of each command of a phase shifter, from the frames alone");
  piezo->footer(
      "Example:\n  frangia calibrate piezo rig.toml -o rig-calibrated.toml\n"
      "Put a part or a sheet of paper into the fringes; the turntable does not move.");
  auto arguments = std::make_shared<PiezoArguments>();
  piezo->add_option("rig,--rig", arguments->rig, "the rig.toml, with [devices.*]")->required();
  piezo->add_option(
      "-o,--output", arguments->output, "write the rig with the measured curve to this file");
  piezo
      ->add_option(
          "--steps", arguments->options.steps, "number of commands over the range of the shifter")
      ->check(from_to(6, 200))
      ->capture_default_str();
  piezo->add_option("--exposure", arguments->options.capture.camera.exposure_ms, "exposure, ms")
      ->check(above_zero())
      ->capture_default_str();
  piezo
      ->add_option("--fringes-per-degree",
                   arguments->options.fringes_per_degree,
                   "pitch of the fringes that are shown")
      ->check(above_zero())
      ->capture_default_str();
  piezo->callback([arguments, &terminal] { calibrate_piezo(*arguments, terminal); });
}

}  // namespace frangia
