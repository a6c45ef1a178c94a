#include "frangia/reconstruct/refine_scan_rig.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/calibrate/check/check_kinds.h"
#include "frangia/core/error.h"
#include "frangia/core/pixel_buffer.h"
#include "frangia/reconstruct/capabilities.h"
#include "frangia/reconstruct/internal/measure_views.h"
#include "frangia/reconstruct/internal/remove_background.h"
#include "frangia/reconstruct/internal/resolve_fringe_orders.h"
#include "frangia/reconstruct/internal/split_setups.h"

namespace frangia {
namespace {

/// The directions whose surfaces are compared.
std::vector<DirectionChoice> directions_of(const std::vector<Pattern>& patterns,
                                           DirectionChoice wanted) {
  if (wanted == DirectionChoice::Vertical || wanted == DirectionChoice::Horizontal) return {wanted};
  const auto shown = [&](FringeDirection direction) {
    return std::any_of(patterns.begin(), patterns.end(), [&](const Pattern& pattern) {
      return pattern.kind == PatternKind::Fringe && pattern.direction == direction;
    });
  };
  std::vector<DirectionChoice> directions;
  if (shown(FringeDirection::Vertical)) directions.push_back(DirectionChoice::Vertical);
  if (shown(FringeDirection::Horizontal)) directions.push_back(DirectionChoice::Horizontal);
  return directions;
}

/// The views of one setup, measured with fringes of one direction.
struct MeasuredSurface {
  ViewStore views;
  Pattern pattern;
  std::vector<std::size_t> stations;
};

/// The views of each setup, and their stations in the order of the scan.
std::vector<MeasuredSurface> measure_direction(const Scan& scan,
                                               const Image<Eigen::Vector2f>& rays,
                                               const ReconstructOptions& options,
                                               const Run& run) {
  std::vector<MeasuredSurface> surfaces;
  MeasuredViews measured = measure_views(scan, rays, options.decode, options.mixed_pixels, run);
  if (removes_background(scan.rig, options))
    static_cast<void>(leave_out_background(measured, scan.rig, run));
  FringeOrderCorrectionOptions correction = options.fringe_order_correction;
  correction.mixed_pixels = options.mixed_pixels;
  for (MeasuredSetup& setup : split_setups(std::move(measured))) {
    MeasuredViews& own = setup.measured;
    resolve_fringe_orders(own, scan.rig, rays, correction, run);
    if (own.points == 0) continue;
    clip_to_volume(own, scan.rig, options, run);
    if (scan.rig.turntable && !options.keep_turntable_top) {
      static_cast<void>(remove_turntable_top(own, scan.rig, run));
    }
    MeasuredSurface& surface = surfaces.emplace_back();
    surface.pattern = own.coarsest;
    for (const Station& station : own.stations) {
      const auto same = [&](const ScanView& view) { return view.folder.string() == station.name; };
      surface.stations.push_back(static_cast<std::size_t>(
          std::find_if(scan.views.begin(), scan.views.end(), same) - scan.views.begin()));
    }
    surface.views = std::move(own.reference());
  }
  return surfaces;
}

/// Warns when a further camera does not measure what the refined rig measures.
void compare_cameras(const Scan& scan, const Rig& refined, const Run& run) {
  if (refined.cameras.size() == 1) return;
#ifdef FRANGIA_WITH_CALIBRATION
  Scan own = scan;
  own.rig = refined;
  const RigCheck check = check_cameras_of(own, {}, run);
  for (const RigCheckItem& item : check.items) {
    if (item.passed()) continue;
    run.warn(fmt::format(
        "{}: its surfaces differ by {:.3g} mm from those of the refined rig, and {:.3g} "
        "mm are expected at most; refining concerns the projector and the reference "
        "camera, so that a further camera that moved needs `frangia calibrate rig`",
        item.name,
        item.deviation_mm,
        item.limit_mm));
  }
#else
  static_cast<void>(scan);
  run.warn(
      "the further cameras are not compared with the refined rig, because this build of frangia is "
      "without calibration (FRANGIA_CALIBRATION)");
#endif
}

}  // namespace

RigRefinement refine_scan_rig(const Scan& scan, const ReconstructOptions& options, const Run& run) {
  if (scan.rig.projector.is_label) {
    throw Error(ErrorKind::Input,
                scan.folder.string() +
                    ": its projector is a label, so that a drift of the projector has no effect; "
                    "reconstruct without refining the rig");
  }
  Scan reference = scan;  // the drift is found from the reference camera alone
  reference.rig.cameras.resize(1);
  const auto rays = rays_of(scan.rig.reference().model);
  std::vector<MeasuredSurface> measured;
  for (const DirectionChoice direction : directions_of(scan.patterns, options.decode.directions)) {
    ReconstructOptions one = options;
    one.decode.directions = direction;
    for (MeasuredSurface& surface : measure_direction(reference, rays, one, run))
      measured.push_back(std::move(surface));
    release_cached_pixels();
  }
  std::vector<Station> stations;
  for (const ScanView& view : scan.views) {
    stations.push_back(
        {view.angle_rad, view.folder.string(), static_cast<std::size_t>(view.setup)});
  }
  std::vector<RigSurfaces> surfaces;
  for (const MeasuredSurface& surface : measured)
    surfaces.push_back({surface.views, surface.pattern, surface.stations});
  if (surfaces.empty()) {
    throw Error(ErrorKind::Input,
                scan.folder.string() +
                    ": no view has a measured point, so that nothing determines "
                    "the rig; `frangia reconstruct` says why");
  }
  run.stage("rig");
  RefineRigOptions how = options.refinement;
  how.table = options.registration;
  RigRefinement refined = refine_rig(scan.rig, surfaces, stations, how, run);
  compare_cameras(scan, refined.rig, run);
  return refined;
}

}  // namespace frangia
