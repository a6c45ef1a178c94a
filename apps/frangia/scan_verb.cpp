#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/acquisition/capture_scan.h"
#include "frangia/core/angles.h"
#include "frangia/rig/read_rig.h"
#include "frangia/simulate/default_patterns.h"

#include "drivers.h"
#include "option_values.h"
#include "verbs.h"

namespace frangia {
namespace {

struct ScanArguments {
  std::filesystem::path rig;
  std::filesystem::path output;
  int views = 8;
  std::string exposure = "10";
  bool no_step_control = false;
  bool not_inverted = false;
  PatternPlan patterns;
  CaptureOptions options;
};

void add_plan_options(CLI::App& verb, ScanArguments& arguments) {
  PatternPlan& patterns = arguments.patterns;
  verb.add_option("rig,--rig", arguments.rig, "the rig.toml, with its [devices.*]")->required();
  verb.add_option("-o,--output", arguments.output, "the scan folder; one begun is gone on with")
      ->required();
  verb.add_option("--views", arguments.views, "stations of the turntable, evenly over a turn")
      ->check(from_to(1, 3600))
      ->capture_default_str();
  verb.add_option("--shifts", patterns.shifts, "frames of each fringe pattern")
      ->check(from_to(3, 360))
      ->capture_default_str();
  verb.add_option("--periods",
                  patterns.periods_px,
                  "a digital projector's fringe periods in pixels, such as 1280,160,20")
      ->delimiter(',')
      ->check(above_zero());
  verb.add_option("--fringes-per-degree",
                  patterns.fringes_per_degree,
                  "an angular projector's finest fringes")
      ->check(above_zero())
      ->capture_default_str();
  verb.add_option("--sequence",
                  patterns.sequence,
                  "instead: doubling, negative-exponential, heterodyne or gray, up to --fringes");
  verb.add_option("--fringes", patterns.fringes, "over the field, of the --sequence")
      ->check(above_zero())
      ->capture_default_str();
  verb.add_option("--ramp",
                  patterns.ramp,
                  "levels of a grey ramp, to measure the projector's response by; 0 for none")
      ->check(from_to(0, 256));
}

void add_light_options(CLI::App& verb, ScanArguments& arguments) {
  CaptureOptions& options = arguments.options;
  verb.add_option(
          "--exposure",
          arguments.exposure,
          "milliseconds; or auto: as long as nothing much saturates; or bracket: as many as "
          "a part that shines needs")
      ->check(above_zero({"auto", "bracket"}))
      ->capture_default_str()
      ->group("Light");
  verb.add_option("--exposures",
                  arguments.patterns.exposures_ms,
                  "take each frame at these exposures in ms, such as 2,8")
      ->delimiter(',')
      ->check(above_zero())
      ->group("Light");
  verb.add_option("--gain", options.camera.gain_db, "of the camera, dB")
      ->check(from_to(0.0, 60.0))
      ->capture_default_str()
      ->group("Light");
  verb.add_option("--black-level", options.camera.black_level_counts, "of the camera, counts")
      ->check(from_to(0.0, 65535.0))
      ->capture_default_str()
      ->group("Light");
}

void add_reliability_options(CLI::App& verb, ScanArguments& arguments) {
  CaptureOptions& options = arguments.options;
  const auto add = [&](const char* name, auto& value, const char* help) {
    verb.add_option(name, value, help)
        ->check(zero_or_more())
        ->capture_default_str()
        ->group("Reliability");
  };
  add("--settle", options.settle_s, "wait after a move of the table, s");
  add("--patience", options.timeout_s, "of each call to a device, s");
  add("--frame-attempts", options.frame_attempts, "for a frame that arrives incomplete");
  add("--set-attempts", options.set_attempts, "for a set of frames that shows motion");
  add("--view-attempts", options.view_attempts, "for a view with a device's fault");
  verb.add_flag("--no-step-control",
                arguments.no_step_control,
                "do not correct the phase shifter by the steps that the frames show")
      ->group("Reliability");
}

void print(const ScanArguments& arguments, const CaptureReport& report, Terminal& terminal) {
  terminal.finish();
  if (terminal.json) {
    nlohmann::ordered_json result{{"scan", arguments.output.string()},
                                  {"captured", report.captured},
                                  {"resumed", report.resumed},
                                  {"frame_retries", report.frame_retries},
                                  {"set_retakes", report.set_retakes},
                                  {"skipped", report.skipped},
                                  {"exposures_ms", report.exposures_ms},
                                  {"device_s", report.device_s},
                                  {"disk_s", report.disk_s},
                                  {"overhead_ms_per_frame", report.overhead_ms()},
                                  {"warnings", terminal.warnings()}};
    fmt::print("{}\n", result.dump(2));
    return;
  }
  terminal.run().note(fmt::format(
      "{}: {} frames taken, {} already there, {} taken again, {} sets retaken, {} views skipped",
      arguments.output.string(),
      report.captured,
      report.resumed,
      report.frame_retries,
      report.set_retakes,
      report.skipped.size()));
  if (report.captured > 0) {
    terminal.run().note(
        fmt::format("devices {:.1f} s, disk {:.1f} s, and {:.1f} ms a frame of the program's own",
                    report.device_s,
                    report.disk_s,
                    report.overhead_ms()));
  }
}

Scan plan_of(const ScanArguments& arguments, const Run& run) {
  Scan plan;
  plan.folder = arguments.output;
  plan.name = std::filesystem::absolute(arguments.output).lexically_normal().filename().string();
  plan.rig = read_rig(arguments.rig, run);
  plan.patterns = default_patterns(plan.rig, arguments.patterns);
  for (int i = 0; i < arguments.views; ++i)
    plan.views.push_back({kTwoPi * i / arguments.views, fmt::format("views/{:03}", i)});
  return plan;
}

void scan(const ScanArguments& arguments, Terminal& terminal) {
  const Run run = terminal.run();
  run.stage("devices");
  const Scan plan = plan_of(arguments, run);
  CaptureOptions options = arguments.options;
  options.control_steps = !arguments.no_step_control;
  if (arguments.exposure == "auto") {
    options.exposure = ExposureChoice::Automatic;
  } else if (arguments.exposure == "bracket") {
    options.exposure = ExposureChoice::Bracketed;
  } else {
    options.camera.exposure_ms = std::stod(arguments.exposure);
  }
  if (options.exposure != ExposureChoice::Given && !arguments.patterns.exposures_ms.empty()) {
    throw Error(ErrorKind::Input,
                "--exposures and --exposure " + arguments.exposure +
                    " contradict each other; leave one of them out");
  }
  constexpr double kOpening_s = 30.0;
  RigDevices devices =
      open_devices(arguments.rig, plan.rig, all_drivers(), Deadline::in(kOpening_s, run.stop), run);
  run.stage("scan");
  print(arguments, capture_scan(plan, devices, options, run), terminal);
}

}  // namespace

void add_scan_verb(CLI::App& program, Terminal& terminal) {
  auto* verb = program.add_subcommand("scan", "capture a scan, or the rest of one");
  verb->footer(
      "Example:\n"
      "  frangia scan examples/simulated-digital.toml -o my-scan\n"
      "  frangia reconstruct my-scan -o part.ply\n"
      "What was interrupted goes on when the same command is given again.");
  auto arguments = std::make_shared<ScanArguments>();
  add_plan_options(*verb, *arguments);
  add_light_options(*verb, *arguments);
  add_reliability_options(*verb, *arguments);
  verb->callback([arguments, &terminal] { scan(*arguments, terminal); });
}

}  // namespace frangia
