#include "frangia/registration/internal/find_turntable_rim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "frangia/core/median.h"

namespace frangia {
namespace {

double quantile(std::vector<double> values, double share) {
  const auto index = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(index);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Whether a surface faces away from the axis, horizontally.
bool faces_outward(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  constexpr double kMinCosine = 0.94;  // 20 degrees, the noise of normals near the silhouette
  const double radius = point.head<2>().norm();
  return radius > 0.0 && normal.head<2>().dot(point.head<2>()) > kMinCosine * radius;
}

/// Share of the directions from the axis in which there are points.
double visible_directions(const std::vector<Eigen::Vector3d>& points) {
  constexpr std::size_t kSectors = 36;
  std::array<bool, kSectors> seen{};
  for (const Eigen::Vector3d& point : points) {
    const double turn = std::atan2(point.y(), point.x()) / kTwoPi + 0.5;
    seen[std::min(kSectors - 1, static_cast<std::size_t>(turn * kSectors))] = true;
  }
  return static_cast<double>(std::count(seen.begin(), seen.end(), true)) / kSectors;
}

/// The widest points that face outward.
std::vector<Eigen::Vector3d> widest_ring(const TableCloud& cloud,
                                         const TurntableTopOptions& options) {
  std::vector<Eigen::Vector3d> outward;
  std::vector<double> radii;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!faces_outward(cloud.points[i], cloud.normals[i])) continue;
    outward.push_back(cloud.points[i]);
    radii.push_back(cloud.points[i].head<2>().norm());
  }
  if (outward.empty()) return {};
  // A rim holds at least `min_share` of the points: half of that from the widest lies on it.
  const double widest_mm = quantile(radii, 1.0 - 0.5 * options.min_share);
  std::vector<Eigen::Vector3d> ring;
  std::copy_if(
      outward.begin(), outward.end(), std::back_inserter(ring), [&](const Eigen::Vector3d& point) {
        return std::abs(point.head<2>().norm() - widest_mm) <
               options.max_edge_variation * widest_mm;
      });
  return ring;
}

}  // namespace

std::optional<TurntableRim> find_turntable_rim(const TableCloud& cloud,
                                               const TurntableTopOptions& options) {
  constexpr std::size_t kFewest = 50;  // points
  const std::vector<Eigen::Vector3d> ring = widest_ring(cloud, options);
  const double enough = options.min_share * static_cast<double>(cloud.points.size());
  if (ring.size() < kFewest || static_cast<double>(ring.size()) < enough) return std::nullopt;
  std::vector<double> radii;
  std::vector<double> heights;
  for (const Eigen::Vector3d& point : ring) {
    radii.push_back(point.head<2>().norm());
    heights.push_back(point.z());
  }
  const TurntableRim rim{median(std::move(radii)), quantile(std::move(heights), 0.99)};
  const double margin_mm =
      std::max(options.relative_clearance * cloud.working_distance_mm, 6.0 * cloud.sigma_mm);
  std::size_t above = 0;
  std::size_t beside = 0;  // below the upper edge, or nearer to the rim than the gap
  for (const Eigen::Vector3d& point : cloud.points) {
    const double radius_mm = point.head<2>().norm();
    const bool low = point.z() < rim.top_mm + margin_mm;
    const bool at_rim =
        std::abs(radius_mm - rim.radius_mm) < options.max_edge_variation * rim.radius_mm;
    if (low && at_rim) continue;
    const bool near = radius_mm > (1.0 - options.min_gap) * rim.radius_mm &&
                      point.z() < rim.top_mm + options.min_gap * rim.radius_mm;
    // A part that stands on the top begins at the height of the upper edge.
    beside += near || point.z() < rim.top_mm - margin_mm ? 1U : 0U;
    above += low ? 0U : 1U;
  }
  const double max_beside = options.max_below * static_cast<double>(ring.size());
  const double max_height_mm = options.relative_max_height * cloud.working_distance_mm;
  const bool apart = static_cast<double>(beside) <= max_beside;
  const bool below_part = above >= kFewest;
  const bool round = visible_directions(ring) >= options.min_visible_edge;
  const bool expected =
      std::abs(rim.top_mm) < max_height_mm ||
      (rim.top_mm < 0.0 &&
       rim.radius_mm > options.min_width_ratio * reach_above(cloud.points, rim.top_mm + margin_mm));
  return apart && below_part && round && expected ? std::optional(rim) : std::nullopt;
}

}  // namespace frangia
