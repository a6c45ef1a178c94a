#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/rig/read_rig.h"
#include "frangia/scan/capture_scan.h"
#include "frangia/simulate/default_patterns.h"

#include "drivers.h"
#include "verbs.h"

namespace frangia {
namespace {

struct ScanArguments {
  std::filesystem::path rig;
  std::filesystem::path output;
  int views = 8;
  std::string exposure = "10";
  double gain_db = 0.0;
  double black_level_counts = 0.0;
  int settle_ms = 0;
  bool no_step_control = false;
  PatternPlan patterns;
};

void add_options(CLI::App& verb, ScanArguments& arguments) {
  verb.add_option("--rig", arguments.rig, "the rig.toml, with its [devices.*]")->required();
  verb.add_option("-o,--output", arguments.output, "the scan folder; one begun is gone on with")
      ->required();
  verb.add_option("--views", arguments.views, "stops of the turntable, evenly over a turn")
      ->check(CLI::Range(1, 3600))
      ->capture_default_str();
  verb.add_option("--shifts", arguments.patterns.shifts, "frames of each fringe pattern")
      ->check(CLI::Range(3, 360))
      ->capture_default_str();
  verb.add_option("--periods",
                  arguments.patterns.periods_px,
                  "a digital projector's fringe periods in pixels, such as 1280,160,20")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  verb.add_option("--fringes-per-degree",
                  arguments.patterns.fringes_per_degree,
                  "an angular projector's fringes")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb.add_option("--exposure", arguments.exposure, "milliseconds, or auto: chosen at view 0")
      ->check(CLI::PositiveNumber | CLI::IsMember({"auto"}))
      ->capture_default_str();
  verb.add_option("--gain", arguments.gain_db, "of the camera, dB")->capture_default_str();
  verb.add_option("--black-level", arguments.black_level_counts, "of the camera, counts")
      ->capture_default_str();
  verb.add_option("--settle", arguments.settle_ms, "wait after a move of the table, ms")
      ->check(CLI::Range(0, 60000))
      ->capture_default_str();
  verb.add_flag("--no-step-control",
                arguments.no_step_control,
                "do not correct the phase shifter by the steps that the frames show");
}

/// The phase shifter's measured curve, which its [devices.phase_shifter] holds for the session.
void read_curve(const std::vector<DeviceSettings>& settings, CaptureOptions& options) {
  for (const DeviceSettings& one : settings) {
    if (one.role() != "phase_shifter") continue;
    for (const double deg : one.numbers("curve_deg"))
      options.curve_rad.push_back(rad_from_deg(deg));
    options.curve_v = one.numbers("curve_v");
    if (options.curve_rad.size() != options.curve_v.size()) {
      one.fail("curve_v", "must have as many numbers as curve_deg");
    }
  }
}

void print(const ScanArguments& arguments, const CaptureReport& report, Terminal& terminal) {
  terminal.finish();
  if (terminal.json) {
    nlohmann::ordered_json result{{"scan", arguments.output.string()},
                                  {"taken", report.taken},
                                  {"resumed", report.resumed},
                                  {"frame_retries", report.frame_retries},
                                  {"set_retakes", report.set_retakes},
                                  {"skipped", report.skipped}};
    result["warnings"] = terminal.warnings();
    fmt::print("{}\n", result.dump(2));
    return;
  }
  terminal.run().note(
      fmt::format("{}: {} frames taken, {} frames retried, {} sets retaken, {} views skipped",
                  arguments.output.string(),
                  report.taken,
                  report.frame_retries,
                  report.set_retakes,
                  report.skipped.size()));
}

void scan(const ScanArguments& arguments, Terminal& terminal) {
  const Run run = terminal.run();
  run.stage("devices");
  const auto settings = read_device_settings(arguments.rig);
  Scan plan;
  plan.folder = arguments.output;
  plan.name = arguments.output.filename().string();
  plan.rig = read_rig(arguments.rig, run);
  plan.patterns = default_patterns(plan.rig, arguments.patterns);
  for (int i = 0; i < arguments.views; ++i) {
    plan.views.push_back({kTurn * i / arguments.views, fmt::format("views/{:03}", i)});
  }
  CaptureOptions options;
  options.auto_exposure = arguments.exposure == "auto";
  if (!options.auto_exposure) options.camera.exposure_ms = std::stod(arguments.exposure);
  options.camera.gain_db = arguments.gain_db;
  options.camera.black_level_counts = arguments.black_level_counts;
  options.settle = std::chrono::milliseconds(arguments.settle_ms);
  options.control_steps = !arguments.no_step_control;
  read_curve(settings, options);
  const Devices devices = open_devices(settings, all_drivers(), plan.rig, run);
  run.stage("scan");
  print(arguments, capture_scan(plan, devices, options, run), terminal);
}

}  // namespace

void add_scan_verb(CLI::App& program, Terminal& terminal) {
  auto* verb = program.add_subcommand("scan", "capture a scan, or the rest of one");
  verb->footer(
      "Example:\n"
      "  frangia scan --rig examples/simulated-digital/rig.toml -o my-scan\n"
      "  frangia reconstruct my-scan -o part.ply");
  auto arguments = std::make_shared<ScanArguments>();
  add_options(*verb, *arguments);
  verb->callback([arguments, &terminal] { scan(*arguments, terminal); });
}

}  // namespace frangia
