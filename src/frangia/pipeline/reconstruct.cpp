#include "frangia/pipeline/reconstruct.h"

#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/missing.h"
#include "frangia/core/release_cached_pixels.h"
#include "frangia/pipeline/internal/explain_no_points.h"
#include "frangia/pipeline/internal/measure_views.h"
#include "frangia/pipeline/internal/register_setups.h"
#include "frangia/views/clip_views.h"

namespace frangia {
namespace {

/// What one view cannot tell of its fringes the others can. Adds the points that are numbered.
void resolve_fringe_orders(MeasuredViews& all,
                           const Rig& rig,
                           const Image<Eigen::Vector2f>& rays,
                           const ReconstructOptions& options,
                           const Run& run) {
  const FringeOptics optics{all.coarsest, rig, rays};
  const auto resolved =
      resolve_by_views(all.views, all.unresolved, optics, options.resolve_by_views, run);
  if (resolved.removed_points > 0) {
    run.warn(
        fmt::format("{} points lie in regions whose fringe neither the laser sheet nor "
                    "another view tells, and are dropped",
                    resolved.removed_points));
  }
  all.points += resolved.resolved_points;
  if (!all.unwrapped_spatially) return;
  const std::size_t moved =
      correct_fringe_orders(all.views, optics, options.fringe_order_correction, run);
  if (moved > 0) {
    run.note(fmt::format("{} points moved by whole fringes to where the other views agree", moved));
  }
}

/// Leaves out what the user says is not the part.
void clip(ViewStore& views,
          const CameraModel& camera,
          const ReconstructOptions& options,
          const Run& run) {
  if (std::isinf(options.clip_below_mm) && std::isinf(options.clip_radius_mm)) return;
  Clip clip{.max_radius_mm = options.clip_radius_mm};
  clip.floor.offset() = -options.clip_below_mm;
  clip_views(views, camera, clip, run);
}

/// Leaves the turntable top out, and what is less than a little above it. Returns its height; NaN
/// when there is none.
double remove_turntable_top(ViewStore& views,
                            const CameraModel& camera,
                            const TurntableTopOptions& options,
                            const Run& run) {
  const auto turntable_top = find_turntable_top(views, camera, options, run);
  if (!turntable_top) return kMissing;
  constexpr double kAbove_mm = 0.5;  // what is nearer is the turntable top, or mixed with it
  Clip clip;
  clip.floor = {turntable_top->normal(), turntable_top->offset() - kAbove_mm};
  const std::size_t dropped = clip_views(views, camera, clip, run);
  const double height_mm = -turntable_top->offset() / turntable_top->normal().z();
  run.note(
      fmt::format("the turntable top, at a height of {:.2f} mm, is left out with {} points; "
                  "set `keep_turntable_top` to keep it",
                  height_mm,
                  dropped));
  return height_mm;
}

/// Refines the turntable by what the views saw.
void register_setup(MeasuredSetup& setup,
                    const Rig& rig,
                    const RegisterOptions& options,
                    const Run& run) {
  MeasuredViews& all = setup.measured;
  setup.registration =
      register_views(all.views, rig.camera.model, {*rig.turntable, all.stations}, options, run);
}

/// Leaves out what is not the part from the views of one setup, and brings them together.
void prepare(MeasuredSetup& setup,
             const Rig& rig,
             const ReconstructOptions& options,
             double& turntable_top_height_mm,
             const Run& run) {
  MeasuredViews& all = setup.measured;
  if (all.points == 0) return;
  clip(all.views, rig.camera.model, options, run);
  if (!options.keep_turntable_top && rig.turntable)
    turntable_top_height_mm =
        remove_turntable_top(all.views, rig.camera.model, options.turntable_top, run);
  if (options.register_views && rig.turntable)
    register_setup(setup, rig, options.registration, run);
}

/// Clips again, on the refined table: each view as it stands on it, whatever its setup.
void clip_on_table(MeasuredSetup& setup,
                   const Rig& rig,
                   const ReconstructOptions& options,
                   const Run& run) {
  ViewStore& views = setup.measured.views;
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i < views.size(); ++i) {
    poses.push_back(views.rig_from_object(i));
    if (!setup.registration) continue;
    views.set_rig_from_object(
        i, setup.registration->table.rig_from_object(setup.registration->angles_rad[i]));
  }
  clip(views, rig.camera.model, options, run);
  for (std::size_t i = 0; i < views.size(); ++i)
    views.set_rig_from_object(i, poses[i]);
}

}  // namespace

Reconstruction reconstruct(const Scan& scan, const ReconstructOptions& options, const Run& run) {
  if (!has_absolute_phase(scan.patterns, scan.rig.projector)) {
    run.warn(
        "the scan holds neither an absolute pattern nor the laser sheet: distances are relative "
        "to the fringe through the projection axis");
  }
  const CameraModel& camera = scan.rig.camera.model;
  const auto rays = rays_of(camera);
  MeasuredViews all = measure_views(scan, rays, options.decode, options.mixed_pixels, run);
  release_cached_pixels();

  run.stage("views");
  Reconstruction out;
  out.views = all.views.size();
  const std::vector<int> numbers = all.setups;
  std::vector<MeasuredSetup> setups = split_setups(std::move(all), numbers);
  for (MeasuredSetup& setup : setups) {
    resolve_fringe_orders(setup.measured, scan.rig, rays, options, run);
    prepare(setup, scan.rig, options, out.turntable_top_height_mm, run);
    out.points += setup.measured.points;
  }
  if (out.points == 0) {
    throw Error(ErrorKind::Input, explain_no_points(scan, rays, options.decode, run));
  }
  MeasuredSetup joined =
      setups.size() == 1
          ? std::move(setups.front())
          : register_setups(std::move(setups),
                            scan.rig,
                            {scan.part_poses, options.register_views, options.registration},
                            run);
  if (joined.registration && joined.registration->iterations > 0)
    run.note(joined.registration->text());
  clip_on_table(joined, scan.rig, options, run);
  out.registration = joined.registration;

  release_cached_pixels();
  run.stage("surface");
  const ViewStore& views = joined.measured.views;
  if (options.keep_raw) out.raw = collect_points(views, camera, run);
  out.mesh = finish_mesh(fuse_views(views, camera, options.fusion, run), options.finish, run);
  return out;
}

}  // namespace frangia
