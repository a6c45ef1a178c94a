#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "frangia/acquisition/capture_scan.h"
#include "frangia/acquisition/plan_setup.h"
#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/folder_lock.h"
#include "frangia/rig/read_rig.h"
#include "frangia/simulate/default_patterns.h"

#include "capture_result.h"
#include "direction_option.h"
#include "drivers.h"
#include "option_values.h"
#include "print_text.h"
#include "scan_until_verb.h"
#include "usage.h"
#include "verbs.h"

namespace frangia {
namespace {

struct ScanArguments {
  std::filesystem::path rig;
  std::filesystem::path output;
  std::filesystem::path until;
  int views = 8;
  int setup = 0;
  std::string exposure = "10";
  bool no_step_control = false;
  std::optional<double> table_at_deg;
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
  verb.add_option(
          "--setup",
          arguments.setup,
          "add a setup to the scan: 1 after the part was turned over, 2 after the next time; "
          "the captured setups stay")
      ->check(from_to(0, 999))
      ->capture_default_str();
  verb.add_option(
      "--until",
      arguments.until,
      "inspection.toml: add stations between the others until it is decided, or say why "
      "it cannot be");
  verb.add_option("--shifts", patterns.shifts, "frames per fringe pattern")
      ->check(from_to(3, 360))
      ->capture_default_str();
  add_direction_option(verb, patterns);
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
      "instead of these: doubling, negative-exponential, heterodyne, gray or gray-alone (no "
      "fringes), with --fringes");
  verb.add_flag("--white", patterns.white, "add a frame of full light for the colors");
  verb.add_flag("--dark", patterns.dark, "add a frame of the ambient light, which is subtracted");
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
  add("--patience",
      options.timeout_s,
      "timeout of each call to a device, s; of a table move, in addition to its expected duration");
  add("--frame-attempts", options.frame_attempts, "attempts for a frame that arrives incomplete");
  add("--set-attempts", options.set_attempts, "attempts for a set of frames that shows motion");
  add("--view-attempts", options.view_attempts, "attempts for a view in which a device fails");
  verb.add_option("--table-at",
                  arguments.table_at_deg,
                  "present angle of a turntable without a home switch, degrees; needed to continue "
                  "a scan")
      ->check(from_to(-1e6, 1e6))
      ->group("Reliability");
  verb.add_option("--wait-for-drift",
                  options.drift_limit_mm,
                  "begin when the fringes on the part move by less than this from one look to the "
                  "next, mm, such as 0.005mm")
      ->transform(length_above_zero())
      ->group("Reliability");
  add("--drift-interval", options.drift_interval_s, "time from one look to the next, s");
  add("--drift-patience", options.drift_patience_s, "give up after this time, s");
  verb.add_flag("--no-step-control",
                arguments.no_step_control,
                "do not correct the phase shifter by the steps measured in the frames")
      ->group("Reliability");
}

/// The name of a folder, which "scan/" and "." do not end with.
std::string name_of(const std::filesystem::path& folder) {
  const auto path = std::filesystem::weakly_canonical(std::filesystem::absolute(folder));
  return (path.filename().empty() ? path.parent_path() : path).filename().string();
}

Scan plan_of(const ScanArguments& arguments, const Run& run) {
  Scan plan;
  plan.folder = arguments.output;
  plan.name = name_of(arguments.output);
  plan.rig = read_rig(arguments.rig, run);
  plan.patterns = default_patterns(plan.rig, arguments.patterns);
  for (int i = 0; i < arguments.views; ++i)
    plan.views.push_back({kTwoPi * i / arguments.views, fmt::format("views/{:03}", i)});
  return plan_setup(plan, arguments.setup);
}

/// The command to continue with. The turntable has moved since its angle was stated.
std::string command_to_continue(std::string command_line) {
  constexpr std::string_view kOption = " --table-at";
  const std::size_t begin = command_line.find(kOption);
  if (begin == std::string::npos) return command_line;
  const std::size_t end = command_line.find(' ', begin + kOption.size() + 1);
  return command_line.erase(begin, end == std::string::npos ? end : end - begin);
}

void scan(const ScanArguments& arguments, Terminal& terminal) {
  require_usage(arguments.until.empty() || arguments.setup == 0,
                "--until begins with the first setup; leave out --setup");
  const Run run = terminal.run();
  run.stage("devices");
  const Scan plan = plan_of(arguments, run);
  CaptureOptions options = arguments.options;
  options.setup = arguments.setup;
  options.control_steps = !arguments.no_step_control;
  if (arguments.table_at_deg) options.table_at_rad = rad_from_deg(*arguments.table_at_deg);
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
  const FolderLock lock(plan.folder);  // before opening the devices, which may be in use
  OpenRig rig(arguments.rig, plan.rig, run);
  run.stage("scan");
  try {
    if (!arguments.until.empty()) {
      scan_until_decided(plan, arguments.until, rig.devices(), lock, options, terminal);
      return;
    }
    CapturedViews views;
    views.watch(plan, options, run);
    const CaptureReport report = capture_scan(plan, rig.devices(), lock, options, run);
    print_capture(arguments.output, report, terminal, views);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Cancelled) throw;
    throw Error(
        ErrorKind::Cancelled,
        fmt::format(
            "{}; continue with: {}", error.what(), command_to_continue(terminal.command_line)));
  }
}

}  // namespace

void add_scan_verb(CLI::App& program, Terminal& terminal) {
  auto* verb = program.add_subcommand("scan", "capture a scan, or continue an interrupted one");
  verb->footer(
      "Example:\n"
      "  frangia scan examples/simulated-digital.toml -o my-scan\n"
      "  frangia reconstruct my-scan -o part.ply\n"
      "Repeat the same command to continue a scan that was interrupted. Turn the part over and "
      "add\n"
      "--setup 1 to scan its other side into the same folder; reconstruct joins the setups by "
      "their\n"
      "shape.");
  auto arguments = std::make_shared<ScanArguments>();
  add_plan_options(*verb, *arguments);
  add_light_options(*verb, *arguments);
  add_reliability_options(*verb, *arguments);
  verb->callback([arguments, &terminal] { scan(*arguments, terminal); });
}

}  // namespace frangia
