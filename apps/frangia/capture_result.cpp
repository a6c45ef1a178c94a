#include "capture_result.h"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

#include "counted.h"
#include "exit_codes.h"
#include "print_text.h"

namespace frangia {
namespace {

nlohmann::ordered_json json_of(const std::vector<SkippedView>& skipped) {
  auto views = nlohmann::ordered_json::array();
  for (const SkippedView& view : skipped) {
    views.push_back({{"view", view.view + 1},
                     {"angle_deg", deg_from_rad(view.angle_rad)},
                     {"reason", view.reason}});
  }
  return views;
}

void print_skipped(const std::vector<SkippedView>& skipped, const Run& run) {
  if (skipped.empty()) return;
  run.note(fmt::format("{} not captured; repeat the command to capture what is missing:",
                       counted(skipped.size(), "view")));
  run.note("  view  angle, deg  reason");
  for (const SkippedView& view : skipped)
    run.note(fmt::format(
        "  {:>4}  {:>10.6g}  {}", view.view + 1, deg_from_rad(view.angle_rad), view.reason));
}

}  // namespace

void CapturedViews::watch(const Scan& plan, CaptureOptions& options, const Run& run) {
  watch_.emplace(plan.rig);
  options.check_view = [this, &plan, &run](const ViewAssessment& found) {
    const ScanView& view = plan.views.at(found.view);
    WatchedView& watched = views_[found.view].watched;
    try {
      watched = watch_->compare(found.view, view.angle_rad, view.setup, *found.decoded, run);
    } catch (const Error&) {  // the decoding reports faults of the frames
      watched = {};
    }
    return watched.finding;
  };
  options.on_view = [this, &plan](const ViewAssessment& found) {
    View& view = views_[found.view];
    view.found = found;
    view.found.decoded = nullptr;
    view.angle_rad = plan.views.at(found.view).angle_rad;
  };
}

nlohmann::ordered_json CapturedViews::json() const {
  auto all = nlohmann::ordered_json::array();
  for (const auto& [number, view] : views_) {
    all.push_back({{"view", number + 1},
                   {"angle_deg", deg_from_rad(view.angle_rad)},
                   {"good", view.found.good},
                   {"verdict", view.found.verdict},
                   {"contrast", view.found.contrast},
                   {"saturated", view.found.saturated_fraction},
                   {"points", view.found.points}});
    if (!std::isnan(view.watched.moved_mm)) {
      all.back()["moved_mm"] = view.watched.moved_mm;
      all.back()["moved_sigma_mm"] = view.watched.moved_sigma_mm;
    }
  }
  return all;
}

void print_capture(const std::filesystem::path& output,
                   const CaptureReport& report,
                   Terminal& terminal,
                   const CapturedViews& views) {
  terminal.finish();
  if (!report.skipped.empty()) terminal.exit_code = DeviceFault;
  if (terminal.json) {
    nlohmann::ordered_json result{{"scan", output.string()},
                                  {"captured", report.captured},
                                  {"resumed", report.resumed},
                                  {"frame_retries", report.frame_retries},
                                  {"set_retakes", report.set_retakes},
                                  {"skipped", json_of(report.skipped)},
                                  {"views", views.json()},
                                  {"exposures_ms", report.exposures_ms},
                                  {"device_s", report.device_s},
                                  {"disk_s", report.disk_s},
                                  {"overhead_ms_per_frame", report.overhead_ms()},
                                  {"warnings", terminal.warnings()}};
    if (report.drift_mm) result["drift_mm"] = *report.drift_mm;
    print_json(result);
    return;
  }
  terminal.run().note(
      fmt::format("{}: {} captured, {} already there, {} repeated, {} retaken, {} skipped",
                  output.string(),
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
  print_skipped(report.skipped, terminal.run());
}

}  // namespace frangia
