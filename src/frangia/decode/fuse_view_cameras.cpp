#include "frangia/decode/fuse_view_cameras.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "frangia/core/missing.h"
#include "frangia/decode/triangulate_view.h"
#include "frangia/range/calibration_uncertainty.h"
#include "frangia/range/match_by_phase.h"
#include "frangia/range/remove_mixed_pixels.h"

namespace frangia {
namespace {

RangeGrid empty_grid(const Image<Eigen::Vector2f>& rays) {
  const Image<float> nothing(rays.width(), rays.height(), kMissing);
  return {nothing, nothing, nothing};
}

/// The phases of a camera that are triangulated.
std::vector<const AbsolutePhase*> used_phases(const DecodedCamera& camera) {
  std::vector<const AbsolutePhase*> phases;
  for (const std::size_t i : camera.fit.used)
    phases.push_back(&camera.decoded.directions[i].phase);
  return phases;
}

/// The cameras that measured at least one direction that all of them measured.
struct CommonPhases {
  std::vector<std::size_t> indices;
  std::vector<CameraPhases> cameras;
};

CommonPhases common_phases(const Rig& rig, std::span<const DecodedCamera> all) {
  CommonPhases out;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto phases = used_phases(all[i]);
    if (phases.empty()) continue;
    out.indices.push_back(i);
    out.cameras.push_back({all[i].rig, all[i].rays, rig.cameras[i].camera_from_rig(), phases});
  }
  for (CameraPhases& camera : out.cameras) {
    std::erase_if(camera.phases, [&](const AbsolutePhase* phase) {
      return !std::all_of(out.cameras.begin(), out.cameras.end(), [&](const CameraPhases& other) {
        return &other == &camera ||
               std::any_of(other.phases.begin(), other.phases.end(), [&](const auto* theirs) {
                 return theirs->pattern.direction == phase->pattern.direction;
               });
      });
    });
  }
  const bool compares = out.cameras.size() > 1 && !out.cameras.front().phases.empty();
  return compares ? out : CommonPhases{};
}

/// Removes the mixed pixels of a camera and finds what they see of an edge.
MeasuredCamera without_mixed_pixels(DecodedCamera& camera,
                                    RangeGrid range,
                                    MixedPixelOptions options) {
  options.blur_px = std::max(options.blur_px, blur_px_of(camera.decoded));
  const auto removed = remove_mixed_pixels(range, camera.rays, camera.status(), options);
  auto edge_pixels = recover_edge_pixels(
      range, camera.rays, removed, {.max_incidence_deg = options.max_incidence_deg});
  return {std::move(range), std::move(edge_pixels)};
}

/// Removes the phases of pixels without a point, so that other cameras do not use them.
void remove_unused_phases(const RangeGrid& range, DecodedView& decoded) {
  for (std::size_t i = 0; i < range.depth_mm.pixels().size(); ++i) {
    if (!std::isnan(range.depth_mm.pixels()[i])) continue;
    for (DecodedDirection& direction : decoded.directions)
      direction.phase.phase_rad.pixels()[i] = kMissing;
  }
}

/// Start values of a camera's points from the first other camera that has a match.
RangeGrid match_camera(std::span<const CameraPhases> cameras, std::size_t own, const Run& run) {
  RangeGrid out = empty_grid(cameras[own].rays);
  for (std::size_t other = 0; other < cameras.size(); ++other) {
    if (other == own) continue;
    const Image<float> matched = match_by_phase(cameras[own], cameras[other], run);
    for (std::size_t i = 0; i < matched.pixels().size(); ++i) {
      float& depth = out.depth_mm.pixels()[i];
      if (std::isnan(depth)) depth = matched.pixels()[i];
    }
  }
  return out;
}

/// Replaces the grids of the cameras that are compared by the fused ones.
MeasuredView fuse_grids(const Rig& rig,
                        const CommonPhases& common,
                        MeasuredView view,
                        const Run& run) {
  std::vector<RangeGrid> ranges;
  for (const std::size_t i : common.indices)
    ranges.push_back(std::move(view.cameras[i].range));
  const FuseCamerasOptions options{.calibration = [&](std::size_t own, std::size_t other) {
    return between_cameras(rig,
                           common.cameras.front().phases.front()->pattern,
                           common.indices[own],
                           common.indices[other]);
  }};
  view.between_cameras = fuse_cameras(common.cameras, ranges, options, run);
  for (std::size_t k = 0; k < ranges.size(); ++k)
    view.cameras[common.indices[k]].range = std::move(ranges[k]);
  return view;
}

MeasuredView match_cameras(const Rig& rig,
                           std::span<DecodedCamera> cameras,
                           const MixedPixelOptions& mixed_pixels,
                           const Run& run) {
  MeasuredView out;
  for (const DecodedCamera& camera : cameras)
    out.cameras.push_back({empty_grid(camera.rays), {}});
  const CommonPhases common = common_phases(rig, cameras);
  if (common.cameras.empty()) return out;
  for (std::size_t k = 0; k < common.cameras.size(); ++k)
    out.cameras[common.indices[k]].range = match_camera(common.cameras, k, run);
  out = fuse_grids(rig, common, std::move(out), run);
  for (const std::size_t i : common.indices) {
    RangeGrid& range = out.cameras[i].range;
    Image<PixelStatus>& status = cameras[i].status();
    for (std::size_t pixel = 0; pixel < status.pixels().size(); ++pixel) {
      const bool measured = status.pixels()[pixel] == PixelStatus::Measured ||
                            status.pixels()[pixel] == PixelStatus::Filled;
      if (measured && std::isnan(range.depth_mm.pixels()[pixel]))
        status.pixels()[pixel] = PixelStatus::OutOfField;
    }
    out.cameras[i] = without_mixed_pixels(cameras[i], std::move(range), mixed_pixels);
  }
  return out;
}

}  // namespace

MeasuredView fuse_view_cameras(const Rig& rig,
                               std::span<DecodedCamera> cameras,
                               DirectionChoice directions,
                               const MixedPixelOptions& mixed_pixels,
                               const Run& run) {
  if (rig.projector.is_label) return match_cameras(rig, cameras, mixed_pixels, run);
  MeasuredView out;
  std::vector<Image<float>> unexplained;  // between the directions of each camera
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    out.cameras.push_back({empty_grid(cameras[i].rays), {}});
    DecodedCamera& camera = cameras[i];
    if (!camera.fit.fits()) {
      unexplained.emplace_back();
      continue;
    }
    TriangulatedView triangulated =
        triangulate_view(camera.decoded, camera.fit, camera.rig, camera.rays, directions);
    out.cameras[i] = without_mixed_pixels(camera, std::move(triangulated.range), mixed_pixels);
    unexplained.push_back(triangulated.disagreement.unexplained_mm);
    if (i == 0) out.directions = std::move(triangulated.disagreement);
  }
  if (cameras.size() == 1) return out;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    remove_unused_phases(out.cameras[i].range, cameras[i].decoded);
  const CommonPhases common = common_phases(rig, cameras);
  if (common.cameras.empty()) return out;
  out = fuse_grids(rig, common, std::move(out), run);
  // The phases that all cameras share say nothing of what the two directions left unexplained.
  for (const std::size_t i : common.indices)
    add_unexplained(unexplained[i], out.cameras[i].range);
  return out;
}

}  // namespace frangia
