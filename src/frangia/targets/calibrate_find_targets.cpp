#include "frangia/targets/calibrate_find_targets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "frangia/calibrate/board/find_board.h"
#include "frangia/calibrate/board/find_ellipses.h"
#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/rig/aruco_dictionary.h"
#include "frangia/targets/internal/refine_target.h"
#include "frangia/targets/internal/target_plane.h"

namespace frangia {
namespace {

/// A place in the image where a target may be.
struct Candidate {
  int code = -1;
  Eigen::Vector2d center_px;
  Eigen::Matrix2d axes_px;                  ///< half axes as columns
  std::vector<Eigen::Vector2d> outline_px;  ///< points of a disc's edge, or the corners of a marker
};

std::vector<Candidate> candidates_in(const Image<float>& counts, const TargetSet& targets) {
  std::vector<Candidate> all;
  if (!targets.dictionary.empty()) {
    for (const FoundMarker& marker : find_markers(counts, targets.dictionary)) {
      Candidate one{marker.code, Eigen::Vector2d::Zero(), {}, {}};
      for (const Eigen::Vector2d& corner : marker.corners_px) {
        one.outline_px.push_back(corner);
        one.center_px += 0.25 * corner;
      }
      const auto& at = marker.corners_px;
      // Of the ellipse through the corners.
      const double circumscribed = std::numbers::sqrt2 / 4.0;
      one.axes_px << circumscribed * (at[1] - at[0] + at[2] - at[3]),
          circumscribed * (at[3] - at[0] + at[2] - at[1]);
      all.push_back(std::move(one));
    }
  }
  if (targets.diameter_mm <= 0.0) return all;
  for (const FoundEllipse& ellipse : find_ellipses(counts, targets.tone)) {
    Candidate one{-1, ellipse.center_px, ellipse.axes_px, {}};
    constexpr int kPoints = 16;
    for (int i = 0; i < kPoints; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kPoints;
      one.outline_px.emplace_back(
          ellipse.center_px + ellipse.axes_px * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    all.push_back(std::move(one));
  }
  return all;
}

/// The outline that is compared, with the even tones on both of its sides.
TargetOutline outline_of(const TargetSet& targets, bool coded) {
  constexpr double kGround = 0.15;  // of the diameter: a sticker on a face that is little wider
  if (!coded) {
    const double half = 0.5 * targets.diameter_mm;
    return {false, targets.diameter_mm, kGround * targets.diameter_mm, half};
  }
  // The border of a marker is one cell wide, and so is the white around it at least.
  const int cells = find_aruco_dictionary(targets.dictionary).value().cells + 2;
  constexpr double kCell = 0.7;  // of a cell: the next one is of another tone
  const double cell_mm = targets.marker_mm / cells;
  return {true, targets.marker_mm, kCell * cell_mm, kCell * cell_mm};
}

struct Start {
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();
  double turn_rad = 0.0;
};

/// Where a candidate is on a plane; none if what is printed would have another size or shape there.
std::optional<Start> start_on(const TargetPlane& plane,
                              const Candidate& candidate,
                              const TargetOutline& outline,
                              const CameraModel& camera) {
  std::vector<Eigen::Vector3d> points;
  Start start;
  for (const Eigen::Vector2d& pixel : candidate.outline_px) {
    points.push_back(plane.meet(camera.ray(pixel)));
    if (!points.back().allFinite() || !(points.back().z() > 0.0)) return std::nullopt;
    start.center_mm += points.back() / static_cast<double>(candidate.outline_px.size());
  }
  double mean = 0.0;
  double least = 1e300;
  double most = 0.0;
  for (const Eigen::Vector3d& point : points) {
    const double radius = (point - start.center_mm).norm();
    mean += radius / static_cast<double>(points.size());
    least = std::min(least, radius);
    most = std::max(most, radius);
  }
  const double stated = 0.5 * outline.size_mm * (outline.square ? std::numbers::sqrt2 : 1.0);
  constexpr double kSize = 0.35;   // outlines of whole pixels, on a plane that is not yet refined
  constexpr double kRound = 0.45;  // of the mean, between the longest and the shortest
  if (std::abs(mean / stated - 1.0) > kSize || most - least > kRound * mean) return std::nullopt;
  if (outline.square) {
    const Eigen::Vector3d edge = points[1] - points[0] + points[2] - points[3];
    const Eigen::Vector2d along = plane.sides.transpose() * edge;
    start.turn_rad = std::atan2(along.y(), along.x());
  }
  return start;
}

/// A sighting with how badly it fits, of which less is better.
struct Scored {
  TargetSighting sighting;
  double misfit = 0.0;
};

bool is_target(const OutlineFit& fit, bool dark) {
  constexpr double kSize = 0.12;    // of the stated one; printers keep 2 %
  constexpr double kMisfit = 0.12;  // of the contrast
  constexpr double kBlur_px = 2.5;
  return std::abs(fit.size_ratio - 1.0) < kSize && fit.misfit < kMisfit && fit.blur_px < kBlur_px &&
         (fit.contrast < 0.0) == dark;
}

TargetSighting sighting_of(const OutlineFit& fit,
                           const TargetPlane& plane,
                           const CameraModel& camera,
                           int code) {
  // Pixels are no squares of even sensitivity, nor is a print exact. No test needs more; cameras
  // do.
  constexpr double kLeast_px = 0.01;
  const Eigen::Vector3d ray = fit.center_mm / fit.center_mm.z();
  const double floor_mm = kLeast_px * fit.center_mm.z() / camera.focal_px.x();
  TargetSighting out;
  out.code = code;
  out.center_mm = fit.center_mm;
  out.center_px = camera.project(fit.center_mm);
  out.normal = plane.normal;
  out.size_ratio = fit.size_ratio;
  out.blur_px = fit.blur_px;
  const Eigen::Matrix2d across =
      fit.covariance_mm2 + floor_mm * floor_mm * Eigen::Matrix2d::Identity();
  const double along = 1.0 / plane.normal.dot(ray);  // of the ray, for a shift of the plane
  out.covariance_mm2 = plane.sides * across * plane.sides.transpose() +
                       ray * ray.transpose() * (along * along * plane.variance_mm2(fit.center_mm));
  return out;
}

std::optional<Scored> measure(const Candidate& candidate,
                              const Image<float>& counts,
                              const RangeGrid& range,
                              const Image<Eigen::Vector2f>& rays,
                              const CameraModel& camera,
                              const TargetSet& targets) {
  const bool coded = candidate.code >= 0;
  const TargetOutline outline = outline_of(targets, coded);
  const bool dark = coded || targets.tone == TargetTone::Dark;
  std::optional<Scored> best;
  for (const TargetPlane& plane :
       find_target_planes(range, rays, candidate.center_px, candidate.axes_px)) {
    const auto start = start_on(plane, candidate, outline, camera);
    if (!start) continue;
    const auto fit = refine_target(counts, rays, plane, outline, start->center_mm, start->turn_rad);
    if (!fit || !is_target(*fit, dark) || (best && best->misfit <= fit->misfit)) continue;
    best = Scored{sighting_of(*fit, plane, camera, candidate.code), fit->misfit};
  }
  return best;
}

/// Whether a spot is the same target as another one, or a cell of its marker.
bool is_same(const TargetSighting& one, const TargetSighting& other, const TargetSet& targets) {
  const double away = (one.center_mm - other.center_mm).norm();
  if (one.code >= 0 && other.code >= 0)
    return one.code == other.code && away < 0.5 * targets.marker_mm;
  return away < 0.5 * sticker_diameter_mm(targets, one.code >= 0 || other.code >= 0);
}

}  // namespace

std::vector<TargetSighting> find_targets(const Image<float>& counts,
                                         const RangeGrid& range,
                                         const CameraModel& camera,
                                         const TargetSet& targets) {
  check_targets(targets);
  require(same_size(counts, range.depth_mm) && counts.width() == camera.width_px &&
              counts.height() == camera.height_px,
          "find_targets: image, range grid and camera differ in size");
  const Image<Eigen::Vector2f> rays = rays_of(camera);
  const std::vector<Candidate> candidates = candidates_in(counts, targets);
  std::vector<std::optional<Scored>> measured(candidates.size());
  parallel_chunks(candidates.size(), 1, [&](std::size_t begin, std::size_t /*end*/) {
    measured[begin] = measure(candidates[begin], counts, range, rays, camera, targets);
  });
  // Markers come first, and of several fits of one target the best.
  std::vector<Scored> found;
  for (const std::optional<Scored>& one : measured) {
    if (!one) continue;
    const auto same = std::find_if(found.begin(), found.end(), [&](const Scored& other) {
      return is_same(one->sighting, other.sighting, targets);
    });
    if (same == found.end()) {
      found.push_back(*one);
    } else if (one->sighting.code == same->sighting.code && one->misfit < same->misfit) {
      *same = *one;
    }
  }
  std::vector<TargetSighting> sightings;
  sightings.reserve(found.size());
  for (const Scored& one : found)
    sightings.push_back(one.sighting);
  return sightings;
}

}  // namespace frangia
