#include "frangia/decode/fuse_view_cameras.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "frangia/core/missing.h"
#include "frangia/decode/triangulate_view.h"
#include "frangia/range/difference_uncertainty.h"
#include "frangia/range/match_by_phase.h"
#include "frangia/range/recover_edge_pixels.h"
#include "frangia/rig/rig_of_camera.h"

namespace frangia {
namespace {

RangeGrid empty_grid(const Image<Eigen::Vector2f>& rays) {
  const Image<float> nothing(rays.width(), rays.height(), kMissing);
  return {nothing, nothing, nothing};
}

/// The phases of a camera that are triangulated.
std::vector<const AbsolutePhase*> used_phases(const DecodedCamera& camera) {
  if (!camera.used) return {};
  const DecodedView& decoded = camera.decoded;
  if (!camera.fit.uses_first && decoded.second_phase) return {&*decoded.second_phase};
  std::vector<const AbsolutePhase*> phases{&decoded.phase};
  if (decoded.second_phase && camera.fit.uses_second) phases.push_back(&*decoded.second_phase);
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
    out.cameras.push_back({all[i].rig, all[i].rays, camera_from_rig(rig, i), phases});
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

/// Triangulates a camera's own phases and removes its mixed pixels, from the phases too.
void triangulate_camera(DecodedCamera& camera,
                        DirectionChoice directions,
                        const MixedPixelOptions& mixed_pixels,
                        MeasuredCamera& out,
                        DirectionDisagreement& disagreement) {
  TriangulatedView triangulated =
      triangulate_view(camera.decoded, camera.fit, camera.rig, camera.rays, directions);
  // triangulate_view has moved the second phase to the place of the first, if only it is used.
  camera.fit.uses_first = true;
  out.range = std::move(triangulated.range);
  disagreement = triangulated.disagreement;
  const auto removed =
      remove_mixed_pixels(out.range, camera.rays, camera.decoded.phase.status, mixed_pixels);
  out.edge_pixels = recover_edge_pixels(
      out.range, camera.rays, removed, {.max_incidence_deg = mixed_pixels.max_incidence_deg});
}

/// Removes the phases of pixels without a point, so that other cameras do not use them.
void remove_unused_phases(const RangeGrid& range, DecodedView& decoded) {
  for (std::size_t i = 0; i < range.depth_mm.pixels().size(); ++i) {
    if (!std::isnan(range.depth_mm.pixels()[i])) continue;
    decoded.phase.phase_rad.pixels()[i] = kMissing;
    if (decoded.second_phase) decoded.second_phase->phase_rad.pixels()[i] = kMissing;
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
CameraDisagreement fuse_grids(const Rig& rig,
                              const CommonPhases& common,
                              std::vector<MeasuredCamera>& cameras,
                              const Run& run) {
  std::vector<RangeGrid> ranges;
  for (const std::size_t i : common.indices)
    ranges.push_back(std::move(cameras[i].range));
  const FuseCamerasOptions options{
      .calibration = between_cameras(rig,
                                     common.cameras.front().phases.front()->pattern,
                                     common.indices[0],
                                     common.indices[1])};
  const CameraDisagreement disagreement = fuse_cameras(common.cameras, ranges, options, run);
  for (std::size_t k = 0; k < ranges.size(); ++k)
    cameras[common.indices[k]].range = std::move(ranges[k]);
  return disagreement;
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
  out.between_cameras = fuse_grids(rig, common, out.cameras, run);
  for (const std::size_t i : common.indices) {
    RangeGrid& range = out.cameras[i].range;
    Image<PixelStatus>& status = cameras[i].decoded.phase.status;
    for (std::size_t pixel = 0; pixel < status.pixels().size(); ++pixel) {
      const bool measured = status.pixels()[pixel] == PixelStatus::Measured ||
                            status.pixels()[pixel] == PixelStatus::Filled;
      if (measured && std::isnan(range.depth_mm.pixels()[pixel]))
        status.pixels()[pixel] = PixelStatus::OutOfField;
    }
    const auto removed = remove_mixed_pixels(range, cameras[i].rays, status, mixed_pixels);
    out.cameras[i].edge_pixels = recover_edge_pixels(
        range, cameras[i].rays, removed, {.max_incidence_deg = mixed_pixels.max_incidence_deg});
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
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    out.cameras.push_back({empty_grid(cameras[i].rays), {}});
    if (!cameras[i].used) continue;
    DirectionDisagreement disagreement;
    triangulate_camera(cameras[i], directions, mixed_pixels, out.cameras[i], disagreement);
    if (i == 0) out.directions = disagreement;
  }
  if (cameras.size() == 1) return out;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    remove_unused_phases(out.cameras[i].range, cameras[i].decoded);
  const CommonPhases common = common_phases(rig, cameras);
  if (!common.cameras.empty()) out.between_cameras = fuse_grids(rig, common, out.cameras, run);
  return out;
}

}  // namespace frangia
