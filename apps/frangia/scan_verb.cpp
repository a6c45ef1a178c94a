#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/acquisition/capture_scan.h"
#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/rig/read_rig.h"
#include "frangia/simulate/default_patterns.h"

#include "counted.h"
#include "drivers.h"
#include "option_values.h"
#include "print_text.h"
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
  verb.add_option("rig,--rig", arguments.rig, "the rig.toml, with [devices.*]")->required();
  verb.add_option(
          "-o,--output", arguments.output, "scan folder to write; an interrupted scan is continued")
      ->required();
  verb.add_option("--views", arguments.views, "turntable stations, evenly over one turn")
      ->check(from_to(1, 3600))
      ->capture_default_str();
  verb.add_option("--shifts", patterns.shifts, "frames per fringe pattern")
      ->check(from_to(3, 360))
      ->capture_default_str();
  verb.add_option("--periods",
                  patterns.periods_px,
                  "digital projector: fringe periods, px, such as 1280,160,20")
      ->delimiter(',')
      ->check(above_zero());
  verb.add_option(
          "--fringes-per-degree", patterns.fringes_per_degree, "angular projector: finest fringes")
      ->check(above_zero())
      ->capture_default_str();
  auto* sequence = verb.add_option(
      "--sequence",
      patterns.sequence,
      "instead of these: doubling, negative-exponential, heterodyne or gray, with --fringes");
  verb.add_option("--fringes", patterns.fringes, "finest fringes of --sequence over the field")
      ->check(above_zero())
      ->needs(sequence)
      ->capture_default_str();
  verb.add_option("--ramp",
                  patterns.ramp,
                  "levels of a grey ramp to measure the projector response; 0 for none")
      ->check(from_to(0, 256));
}

void add_light_options(CLI::App& verb, ScanArguments& arguments) {
  CaptureOptions& options = arguments.options;
  verb.add_option("--exposure",
                  arguments.exposure,
                  "exposure, ms; or auto: the longest without saturation; or bracket: several "
                  "exposures, for "
                  "glossy parts")
      ->check(above_zero({"auto", "bracket"}))
      ->capture_default_str()
      ->group("Light");
  verb.add_option("--exposures",
                  arguments.patterns.exposures_ms,
                  "capture each frame at these exposures, ms, such as 2,8")
      ->delimiter(',')
      ->check(above_zero())
      ->group("Light");
  verb.add_option("--gain", options.camera.gain_db, "camera gain, dB")
      ->check(from_to(0.0, 60.0))
      ->capture_default_str()
      ->group("Light");
  verb.add_option("--black-level", options.camera.black_level_counts, "camera black level, counts")
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
  add("--settle", options.settle_s, "wait after each turntable move, s");
  add("--patience", options.timeout_s, "timeout of each call to a device, s");
  add("--frame-attempts", options.frame_attempts, "attempts for a frame that arrives incomplete");
  add("--set-attempts", options.set_attempts, "attempts for a set of frames that shows motion");
  add("--view-attempts", options.view_attempts, "attempts for a view in which a device fails");
  verb.add_flag("--no-step-control",
                arguments.no_step_control,
                "do not correct the phase shifter by the steps measured in the frames")
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
    print_json(result);
    return;
  }
  terminal.run().note(
      fmt::format("{}: {} captured, {} already there, {} repeated, {} retaken, {} skipped",
                  arguments.output.string(),
                  counted(report.captured, "frame"),
                  report.resumed,
                  report.frame_retries,
                  counted(report.set_retakes, "set"),
                  counted(report.skipped.size(), "view")));
  if (report.captured > 0 && terminal.verbose) {
    terminal.run().note(fmt::format("devices {:.1f} s, disk {:.1f} s, program {:.1f} ms per frame",
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
                "`exposures` and `exposure` " + arguments.exposure +
                    " exclude each other; set only one of them");
  }
  constexpr double kOpening_s = 30.0;
  RigDevices devices =
      open_devices(arguments.rig, plan.rig, all_drivers(), Deadline::in(kOpening_s, run.stop), run);
  run.stage("scan");
  try {
    print(arguments, capture_scan(plan, devices, options, run), terminal);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Cancelled) throw;
    throw Error(ErrorKind::Cancelled,
                fmt::format("{}; continue with: {}", error.what(), terminal.command_line));
  }
}

}  // namespace

void add_scan_verb(CLI::App& program, Terminal& terminal) {
  auto* verb = program.add_subcommand("scan", "capture a scan, or continue an interrupted one");
  verb->footer(
      "Example:\n"
      "  frangia scan examples/simulated-digital.toml -o my-scan\n"
      "  frangia reconstruct my-scan -o part.ply\n"
      "Repeat the same command to continue a scan that was interrupted.");
  auto arguments = std::make_shared<ScanArguments>();
  add_plan_options(*verb, *arguments);
  add_light_options(*verb, *arguments);
  add_reliability_options(*verb, *arguments);
  verb->callback([arguments, &terminal] { scan(*arguments, terminal); });
}

}  // namespace frangia
