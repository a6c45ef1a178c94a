#include "frangia/scan/reconstruct.h"

#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/missing.h"
#include "frangia/core/spare_pixels.h"
#include "frangia/scan/join_rounds.h"
#include "frangia/scan/measure_views.h"
#include "frangia/views/clip_views.h"

namespace frangia {
namespace {

/// What one view cannot tell of its fringes the others can. Adds the points that are numbered.
void number_by_views(MeasuredViews& all,
                     const Rig& rig,
                     const Image<Eigen::Vector2f>& rays,
                     const ReconstructOptions& options,
                     const Run& run) {
  const FringeOptics optics{all.coarsest, rig, rays};
  const auto anchored = anchor_by_views(all.views, all.loose, optics, options.anchor_by_views, run);
  if (anchored.dropped_points > 0) {
    run.warn(
        fmt::format("{} points lie in regions whose fringe neither the plane of light nor "
                    "another view tells, and are dropped",
                    anchored.dropped_points));
  }
  all.points += anchored.anchored_points;
  if (!all.unwrapped_in_space) return;
  const std::size_t moved = reconcile_views(all.views, optics, options.reconcile, run);
  if (moved > 0) {
    run.note(fmt::format("{} points moved by whole fringes to where the other views agree", moved));
  }
}

/// Leaves out what the user says is not the part.
void clip(ViewStore& views, const Lens& camera, const ReconstructOptions& options, const Run& run) {
  if (std::isinf(options.clip_below_mm) && std::isinf(options.clip_radius_mm)) return;
  Clip clip{.max_radius_mm = options.clip_radius_mm};
  clip.floor.offset() = -options.clip_below_mm;
  clip_views(views, camera, clip, run);
}

/// Leaves the platter out, and what is less than a little above it. Returns its height; NaN when
/// there is none.
double clear_platter(ViewStore& views,
                     const Lens& camera,
                     const PlatterOptions& options,
                     const Run& run) {
  const auto platter = find_platter(views, camera, options, run);
  if (!platter) return kMissing;
  constexpr double kAbove_mm = 0.5;  // what is nearer is the platter, or mixed with it
  Clip clip;
  clip.floor = {platter->normal(), platter->offset() - kAbove_mm};
  const std::size_t dropped = clip_views(views, camera, clip, run);
  const double height_mm = -platter->offset() / platter->normal().z();
  run.note(fmt::format(
      "the platter, at a height of {:.2f} mm, is left out with {} points; --keep-platter "
      "keeps it",
      height_mm,
      dropped));
  return height_mm;
}

/// Refines the turntable by what the views saw.
void bring_together(Round& round, const Rig& rig, const RegisterOptions& options, const Run& run) {
  MeasuredViews& all = round.measured;
  round.registration =
      register_views(all.views, rig.camera.lens, {*rig.turntable, all.stops}, options, run);
}

/// Leaves out what is not the part from the views of one round, and brings them together.
void prepare(Round& round,
             const Rig& rig,
             const ReconstructOptions& options,
             double& platter_height_mm,
             const Run& run) {
  MeasuredViews& all = round.measured;
  if (all.points == 0) return;
  clip(all.views, rig.camera.lens, options, run);
  if (!options.keep_platter && rig.turntable)
    platter_height_mm = clear_platter(all.views, rig.camera.lens, options.platter, run);
  if (options.register_views && rig.turntable)
    bring_together(round, rig, options.registration, run);
}

/// Clips again, on the refined table: each view as it stands on it, whatever its round.
void clip_on_table(Round& round,
                   const Rig& rig,
                   const ReconstructOptions& options,
                   const Run& run) {
  ViewStore& views = round.measured.views;
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i < views.size(); ++i) {
    poses.push_back(views.rig_from_object(i));
    if (!round.registration) continue;
    views.set_rig_from_object(
        i, round.registration->table.rig_from_object(round.registration->angles_rad[i]));
  }
  clip(views, rig.camera.lens, options, run);
  for (std::size_t i = 0; i < views.size(); ++i)
    views.set_rig_from_object(i, poses[i]);
}

}  // namespace

Reconstruction reconstruct(const Scan& scan, const ReconstructOptions& options, const Run& run) {
  if (!has_absolute_phase(scan.patterns, scan.rig.projector)) {
    run.warn(
        "the scan holds neither an absolute pattern nor the plane of light: distances are relative "
        "to the fringe through the projection axis");
  }
  const Lens& camera = scan.rig.camera.lens;
  const auto rays = rays_of(camera);
  MeasuredViews all = measure_views(scan, rays, options.decode, options.edges, run);
  release_spare_pixels();

  run.stage("views");
  Reconstruction out;
  out.views = all.views.size();
  const std::vector<int> numbers = all.rounds;
  std::vector<Round> rounds = split_rounds(std::move(all), numbers);
  for (Round& round : rounds) {
    number_by_views(round.measured, scan.rig, rays, options, run);
    prepare(round, scan.rig, options, out.platter_height_mm, run);
    out.points += round.measured.points;
  }
  if (out.points == 0) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: no view has a lit pixel; check light, exposure and white_level",
                            scan.folder.string()));
  }
  Round whole = rounds.size() == 1
                    ? std::move(rounds.front())
                    : join_rounds(std::move(rounds),
                                  scan.rig,
                                  {scan.placings, options.register_views, options.registration},
                                  run);
  if (whole.registration && whole.registration->iterations > 0)
    run.note(whole.registration->text());
  clip_on_table(whole, scan.rig, options, run);
  out.registration = whole.registration;

  release_spare_pixels();
  run.stage("surface");
  const ViewStore& views = whole.measured.views;
  if (options.keep_raw) out.raw = collect_points(views, camera, run);
  out.mesh = finish_mesh(paste_views(views, camera, options.paste, run), options.finish, run);
  return out;
}

}  // namespace frangia
