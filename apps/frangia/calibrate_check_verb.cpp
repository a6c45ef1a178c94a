#include "calibrate_check_verb.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/calibrate/check/calibrate_check.h"
#include "frangia/calibrate/check/drift_log.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/text.h"
#include "frangia/dataset/capture_times.h"
#include "frangia/rig/read_rig.h"

#include "check_can_write.h"
#include "counted.h"
#include "exit_codes.h"
#include "option_values.h"
#include "print_text.h"

namespace frangia {
namespace {

struct CheckArguments {
  std::filesystem::path rig;
  std::filesystem::path scan;
  std::filesystem::path plot;
  bool no_log = false;
  CheckRigOptions options;
};

/// When a scan was captured: by its manifest, else when its scan.toml was written.
double capture_time_s(const Scan& scan) {
  const double began_s = read_capture_begin(scan);
  if (!std::isnan(began_s)) return began_s;
  const auto written = std::filesystem::last_write_time(scan.folder / "scan.toml");
  const auto on_system = std::chrono::file_clock::to_sys(written);
  return std::chrono::duration<double>(on_system.time_since_epoch()).count();
}

/// Adds a check to the log beside the rig; a folder that cannot be written is no reason to fail.
std::vector<DriftEntry> logged(const CheckArguments& arguments,
                               const Scan& scan,
                               const RigCheck& check,
                               const Run& run) {
  const std::filesystem::path log = drift_log_path(arguments.rig);
  const std::filesystem::path folder = std::filesystem::weakly_canonical(scan.folder);
  if (!arguments.no_log) {
    try {
      append_drift(log, {capture_time_s(scan), folder.string(), check.kind, check.items});
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::File) throw;
      run.warn(fmt::format("the check is not in the log of the rig: {}", error.what()));
    }
  }
  return read_drift_log(log, run);
}

/// Draws the log as the user asked for.
void plot_log(const std::filesystem::path& path, const std::vector<DriftEntry>& entries) {
  if (path.empty()) return;
  write_text_file(path, drift_plot(entries));
}

nlohmann::ordered_json json_of_check(const RigCheck& check) {
  nlohmann::ordered_json json{{"kind", check.kind},
                              {"views", check.views},
                              {"views_left_out", check.left_out},
                              {"distance_mm", check.distance_mm},
                              {"calibration_sigma_mm", check.calibration_sigma_mm},
                              {"passed", check.passed()}};
  for (const RigCheckItem& item : check.items) {
    json["items"].push_back({{"name", item.name},
                             {"deviation_mm", item.deviation_mm},
                             {"sigma_mm", item.sigma_mm},
                             {"limit_mm", item.limit_mm},
                             {"passed", item.passed()}});
  }
  return json;
}

void print_check(const RigCheck& check) {
  print_text(
      "{} in {} at {:.0f} mm\n", check.kind, counted(check.views, "view"), check.distance_mm);
  for (const RigCheckItem& item : check.items) {
    print_text("  {:<26} {}: deviation {:+.4f} ± {:.4f} mm, limit {:.4f} mm: {}\n",
               item.name,
               item.measured,
               item.deviation_mm,
               item.sigma_mm,
               item.limit_mm,
               item.passed() ? "passed" : "FAILED");
  }
  write_output(check.passed() ? "the rig measures as it was calibrated\n"
                              : "the rig is no longer what it was: calibrate it again\n");
}

void calibrate_check_verb(const CheckArguments& arguments, Terminal& terminal) {
  const Run run = terminal.run();
  if (!arguments.plot.empty()) {
    require(lowercase_extension(arguments.plot) == ".svg",
            "the log of a rig is drawn as .svg; give a file name that ends with .svg");
    check_can_write(arguments.plot);
  }
  const Rig rig = read_rig(arguments.rig, run);
  Scan scan = read_scan(arguments.scan, run, RigContent::StartValues);
  const CameraModel& own = scan.rig.reference().model;
  const CameraModel& given = rig.reference().model;
  if (own.width_px != given.width_px || own.height_px != given.height_px ||
      scan.rig.projector.is_angular() != rig.projector.is_angular()) {
    throw Error(ErrorKind::Input,
                fmt::format("{} describes another rig than that of {}: the cameras' sizes or the "
                            "projectors' models differ",
                            arguments.rig.string(),
                            arguments.scan.string()));
  }
  scan.rig = rig;
  const RigCheck check = calibrate_check(scan, rig, arguments.options, run);
  if (!check.left_out.empty()) {
    run.warn(fmt::format(
        "the {} is not found in {}", check.kind, counted(check.left_out.size(), "view")));
  }
  if (check.calibration_sigma_mm == 0.0) {
    run.warn(
        "the covariance of the rig is not known, so the limits hold the noise and a share of the "
        "distance only; set `tolerance` to allow more");
  }
  const std::vector<DriftEntry> entries = logged(arguments, scan, check, run);
  if (!arguments.plot.empty() && entries.empty())
    throw Error(ErrorKind::Input, "the rig has no log to plot; leave out `no_log`");
  plot_log(arguments.plot, entries);
  terminal.finish();
  if (!check.passed()) terminal.exit_code = OutOfTolerance;
  if (terminal.json) {
    nlohmann::ordered_json json = json_of_check(check);
    json["log"] = drift_log_path(arguments.rig).string();
    json["logged"] = entries.size();
    if (!arguments.plot.empty()) json["plot"] = arguments.plot.string();
    json["warnings"] = terminal.warnings();
    print_json(json);
  } else {
    print_check(check);
    if (entries.size() > 1)
      print_text(
          "{} in {}\n", counted(entries.size(), "check"), drift_log_path(arguments.rig).string());
    if (!arguments.plot.empty()) terminal.print_written(arguments.plot.string());
  }
}

}  // namespace

void add_calibrate_check_verb(CLI::App& calibrate, Terminal& terminal) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* verb = calibrate.add_subcommand(
      "check", "say whether a rig is still what it was, from a ball bar, a plate or any part");
  verb->footer(
      "Example:\n  frangia calibrate check rig.toml ball-bar --plot drift.svg\n"
      "The scan states kind = \"ball-bar\", \"ball\" or \"plate\" in [board]; without [board] the "
      "views "
      "of\n"
      "the part are compared with each other. Exit code 1: the rig is no longer what it was.");
  verb->add_option("RIG", arguments->rig, "the calibrated rig.toml")->required();
  verb->add_option("SCAN", arguments->scan, "the scan folder")->required();
  verb->add_option("--plot",
                   arguments->plot,
                   "draw the log of the rig, RIG.drift.txt beside it, over time to this .svg");
  verb->add_flag("--no-log", arguments->no_log, "do not add the check to the log of the rig");
  verb->add_option("--tolerance",
                   arguments->options.tolerance_mm,
                   "deviation that is allowed; by default three standard deviations and 1/20 000 "
                   "of the distance")
      ->transform(length_above_zero());
  verb->callback([arguments, &terminal] { calibrate_check_verb(*arguments, terminal); });
}

}  // namespace frangia
