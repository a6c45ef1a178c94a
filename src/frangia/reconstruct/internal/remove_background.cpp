#include "frangia/reconstruct/internal/remove_background.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/missing.h"
#include "frangia/reconstruct/internal/tie_cameras.h"
#include "frangia/views/clip_views.h"

namespace frangia {
namespace {

/// Clips the views of all cameras; something of the reference camera must be left.
std::size_t clip_cameras(MeasuredViews& measured,
                         const Rig& rig,
                         const Clip& clip,
                         const Run& run) {
  std::size_t removed = clip_views(measured.reference(), rig.reference().model, clip, run);
  tie_cameras(measured, rig);
  for (std::size_t i = 1; i < measured.cameras.size(); ++i)
    removed += clip_views_to_nothing(measured.cameras[i], rig.cameras[i].camera.model, clip, run);
  return removed;
}

}  // namespace

std::string with_undecided(std::string untrusted_reason,
                           const BackgroundReport& background,
                           const Run& run) {
  constexpr double kFew = 0.1;  // of the points: they do not decide where a view is
  if (background.undecided < kFew) return untrusted_reason;
  const std::string advice = fmt::format(
      "{:.0f} % of the points stand still in all views, which do not show whether they turn with "
      "the table: if they are background, set `clip_radius` to the radius of the part",
      100.0 * background.undecided);
  if (!untrusted_reason.empty()) return untrusted_reason + "; " + advice;
  run.warn(advice);
  return untrusted_reason;
}

BackgroundReport leave_out_background(MeasuredViews& measured, const Rig& rig, const Run& run) {
  BackgroundReport report;
  for (std::size_t i = 0; i < measured.cameras.size(); ++i) {
    const CameraModel& camera = rig.cameras[i].camera.model;
    const Background found = find_background(measured.cameras[i], camera, measured.setups, run);
    if (i == 0) report.undecided = found.undecided;
    if (!found.found()) continue;
    report.points += remove_background(measured.cameras[i], camera, found, run);
    report.from_axis_mm = std::fmin(report.from_axis_mm, found.from_axis_mm);
  }
  if (report.points == 0) return report;
  measured.points -= std::min(measured.points, report.points);
  run.note(
      fmt::format("what stands still in front of the camera while the part turns (background, "
                  "{:.0f} mm from the axis and farther) is left out with {} points; set "
                  "`keep_background` to keep it",
                  report.from_axis_mm,
                  report.points));
  return report;
}

void clip_to_volume(MeasuredViews& measured,
                    const Rig& rig,
                    const ReconstructOptions& options,
                    const Run& run) {
  if (std::isinf(options.clip_below_mm) && std::isinf(options.clip_radius_mm)) return;
  Clip clip{.max_radius_mm = options.clip_radius_mm};
  clip.floor.offset() = -options.clip_below_mm;
  clip_cameras(measured, rig, clip, run);
}

void clip_on_registered_turntable(MeasuredSetup& setup,
                                  const Rig& rig,
                                  const ReconstructOptions& options,
                                  const Run& run) {
  ViewStore& views = setup.measured.reference();
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i < views.size(); ++i) {
    poses.push_back(views.rig_from_object(i));
    if (!setup.registration) continue;
    views.set_rig_from_object(
        i, setup.registration->table.rig_from_object(setup.registration->angles_rad[i]));
  }
  clip_to_volume(setup.measured, rig, options, run);
  for (std::size_t i = 0; i < views.size(); ++i)
    views.set_rig_from_object(i, poses[i]);
  tie_cameras(setup.measured, rig);
}

double remove_turntable_top(MeasuredViews& measured, const Rig& rig, const Run& run) {
  const auto top = find_turntable_top(measured.reference(), rig.reference().model, run);
  if (!top) return kMissing;
  const std::size_t removed = clip_cameras(measured, rig, top->clip(), run);
  const double height_mm = top->height_mm();
  run.note(fmt::format(
      "{} at a height of {:.2f} mm is removed with {} points; set `keep_turntable_top` to keep it",
      top->rim_only ? "the rim of the turntable top, which is seen edge-on," : "the turntable top",
      std::abs(height_mm) < 0.005 ? 0.0 : height_mm,
      removed));
  return height_mm;
}

}  // namespace frangia
