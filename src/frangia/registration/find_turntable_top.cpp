#include "frangia/registration/find_turntable_top.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/fit_primitives.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/registration/internal/view_pairs.h"
#include "frangia/views/view_store.h"

namespace frangia {
namespace {

/// Criteria of a turntable top. Relative lengths are shares of the working distance, the median
/// distance of the measured points from the camera.
struct TurntableTopLimits {
  double max_tilt_rad = rad_from_deg(3.0);  ///< of the top against the axis
  double min_share = 0.03;                  ///< of all points that lie on the top, or on its rim
  double max_below = 0.02;        ///< points below the top and within its edge, as a share of those
                                  ///< on it
  double min_visible_edge = 0.6;  ///< share of the directions from the axis in which the edge is
                                  ///< measured
  double max_edge_variation = 0.05;    ///< of the edge's radius, as a share of it
  double relative_max_height = 0.006;  ///< of a top near the origin, above or below it: 3 mm at
                                       ///< 500 mm
  double min_width_ratio = 1.5;  ///< a top that is not near the origin must be this many times as
                                 ///< wide as everything above it; a narrower disc is a base
  double relative_band = 0.004;  ///< thickness of the layer that is searched for a plane: a tilt of
                                 ///< the axis of 1 degree over 60 mm at 500 mm, twice
  double relative_clearance = 0.001;  ///< points nearer to the top than this are mixed with it
  double min_gap = 0.2;  ///< between a rim and everything else, as a share of the rim's radius
};
constexpr TurntableTopLimits kTopLimits;

/// Points of all views.
///
/// @units    mm, object frame
struct TableCloud {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;  ///< unit, one a point
  double sigma_mm = 0.0;                 ///< median, along the normal
  double working_distance_mm = 0.0;      ///< median distance of the points from the camera
};

/// About 20000 points of each view, or fewer of more than 24 views.
TableCloud gather_table_cloud(const ViewStore& views, const CameraModel& camera, const Run& run) {
  const std::size_t surfels = surfels_per_view(20000, views.size());
  const std::size_t map_pixels = 16 * surfels;  // denser than the surfels that are picked
  const CameraRays rays(views, camera);
  const LocalPlanesOptions options{
      .every = surfel_stride(camera.width_px, camera.height_px, map_pixels)};
  TableCloud cloud;
  std::vector<float> sigmas_mm;
  std::vector<float> distances_mm;
  LocalPlanes planes;
  load_each_view(views, [&](std::size_t i, const View& view) {
    run.report(static_cast<double>(i) / static_cast<double>(views.size()));
    planes = local_planes(view, rays, options, std::move(planes));
    const Eigen::Isometry3d object_from_rig = views.rig_from_object(i).inverse();
    for (const auto& surfel : pick_surfels(make_surfel_map(planes, rays, map_pixels), surfels)) {
      cloud.points.emplace_back(object_from_rig * surfel.point_mm.cast<double>());
      cloud.normals.emplace_back(object_from_rig.linear() * surfel.normal.cast<double>());
      sigmas_mm.push_back(surfel.sigma_mm);
      distances_mm.push_back(surfel.point_mm.norm());
    }
  });
  cloud.sigma_mm = static_cast<double>(median(std::move(sigmas_mm)));
  cloud.working_distance_mm = static_cast<double>(median(std::move(distances_mm)));
  return cloud;
}

/// How far from the axis the points above a height reach, except for the farthest hundredth. 0 when
/// there are none.
double reach_above(const std::vector<Eigen::Vector3d>& points, double height_mm) {
  std::vector<double> reach;
  for (const auto& point : points) {
    if (point.z() > height_mm) reach.push_back(point.head<2>().norm());
  }
  if (reach.empty()) return 0.0;
  const auto most = reach.begin() + static_cast<std::ptrdiff_t>(reach.size() * 99 / 100);
  std::nth_element(reach.begin(), most, reach.end());
  return *most;
}

/// The edge of a turntable top that is seen edge-on.
struct TurntableRim {
  double radius_mm = 0.0;
  double top_mm = 0.0;  ///< height of its upper edge, object frame
};

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
std::vector<Eigen::Vector3d> widest_ring(const TableCloud& cloud) {
  std::vector<Eigen::Vector3d> outward;
  std::vector<double> radii;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!faces_outward(cloud.points[i], cloud.normals[i])) continue;
    outward.push_back(cloud.points[i]);
    radii.push_back(cloud.points[i].head<2>().norm());
  }
  if (outward.empty()) return {};
  // A rim holds at least `min_share` of the points: half of that from the widest lies on it.
  const double widest_mm = quantile(radii, 1.0 - 0.5 * kTopLimits.min_share);
  std::vector<Eigen::Vector3d> ring;
  std::copy_if(
      outward.begin(), outward.end(), std::back_inserter(ring), [&](const Eigen::Vector3d& point) {
        return std::abs(point.head<2>().norm() - widest_mm) <
               kTopLimits.max_edge_variation * widest_mm;
      });
  return ring;
}

/// Finds a cylinder about the axis that lies below everything else, apart from it, and not above
/// the origin of the object frame.
///
/// @missing  none when no cylinder meets all criteria
std::optional<TurntableRim> find_turntable_rim(const TableCloud& cloud) {
  constexpr std::size_t kFewest = 50;  // points
  const std::vector<Eigen::Vector3d> ring = widest_ring(cloud);
  const double enough = kTopLimits.min_share * static_cast<double>(cloud.points.size());
  if (ring.size() < kFewest || static_cast<double>(ring.size()) < enough) return std::nullopt;
  std::vector<double> radii;
  std::vector<double> heights;
  for (const Eigen::Vector3d& point : ring) {
    radii.push_back(point.head<2>().norm());
    heights.push_back(point.z());
  }
  const TurntableRim rim{median(std::move(radii)), quantile(std::move(heights), 0.99)};
  const double margin_mm =
      std::max(kTopLimits.relative_clearance * cloud.working_distance_mm, 6.0 * cloud.sigma_mm);
  std::size_t above = 0;
  std::size_t beside = 0;  // below the upper edge, or nearer to the rim than the gap
  for (const Eigen::Vector3d& point : cloud.points) {
    const double radius_mm = point.head<2>().norm();
    const bool low = point.z() < rim.top_mm + margin_mm;
    const bool at_rim =
        std::abs(radius_mm - rim.radius_mm) < kTopLimits.max_edge_variation * rim.radius_mm;
    if (low && at_rim) continue;
    const bool near = radius_mm > (1.0 - kTopLimits.min_gap) * rim.radius_mm &&
                      point.z() < rim.top_mm + kTopLimits.min_gap * rim.radius_mm;
    // A part that stands on the top begins at the height of the upper edge.
    beside += near || point.z() < rim.top_mm - margin_mm ? 1U : 0U;
    above += low ? 0U : 1U;
  }
  const double max_beside = kTopLimits.max_below * static_cast<double>(ring.size());
  const double max_height_mm = kTopLimits.relative_max_height * cloud.working_distance_mm;
  const bool apart = static_cast<double>(beside) <= max_beside;
  const bool below_part = above >= kFewest;
  const bool round = visible_directions(ring) >= kTopLimits.min_visible_edge;
  const bool expected =
      std::abs(rim.top_mm) < max_height_mm ||
      (rim.top_mm < 0.0 && rim.radius_mm > kTopLimits.min_width_ratio *
                                               reach_above(cloud.points, rim.top_mm + margin_mm));
  return apart && below_part && round && expected ? std::optional(rim) : std::nullopt;
}

using Plane = Eigen::Hyperplane<double, 3>;

std::vector<Eigen::Vector3d> near(const std::vector<Eigen::Vector3d>& points,
                                  const Plane& plane,
                                  double within_mm) {
  std::vector<Eigen::Vector3d> found;
  std::copy_if(
      points.begin(), points.end(), std::back_inserter(found), [&](const Eigen::Vector3d& p) {
        return plane.absDistance(p) < within_mm;
      });
  return found;
}

/// The least-squares plane of points; its normal points up.
Plane fit(const std::vector<Eigen::Vector3d>& points) {
  Plane plane = fit_plane(points);
  if (plane.normal().z() < 0.0) plane.coeffs() *= -1.0;
  return plane;
}

/// The lowest layer of `band_mm` that holds `enough` points: its median height.
std::optional<double> lowest_layer(const std::vector<Eigen::Vector3d>& points,
                                   std::size_t enough,
                                   double band_mm) {
  std::vector<double> heights;
  for (const auto& point : points)
    heights.push_back(point.z());
  std::sort(heights.begin(), heights.end());
  for (std::size_t i = 0; i + enough < heights.size(); ++i) {
    if (heights[i + enough] - heights[i] < band_mm) return heights[i + enough / 2];
  }
  return std::nullopt;
}

/// Points as a disc about the axis.
struct Disc {
  double radius_mm = 0.0;
  double visible_edge = 0.0;    ///< share of the directions from the axis in which it has an edge
  double edge_variation = 1.0;  ///< of the radius, as a share of it, except for the widest tenth
};

Disc disc_of(const std::vector<Eigen::Vector3d>& points) {
  constexpr std::size_t kSectors = 36;
  std::array<double, kSectors> reach{};
  for (const auto& point : points) {
    const double turn = std::atan2(point.y(), point.x()) / kTwoPi + 0.5;
    double& sector = reach[std::min(kSectors - 1, static_cast<std::size_t>(turn * kSectors))];
    sector = std::max(sector, point.head<2>().norm());
  }
  std::sort(reach.begin(), reach.end());
  Disc disc;
  disc.radius_mm = reach[kSectors / 2];
  const auto at_edge =
      std::count_if(reach.begin(), reach.end(), [&](double r) { return r > 0.9 * disc.radius_mm; });
  disc.visible_edge = static_cast<double>(at_edge) / kSectors;
  const std::size_t tenth = kSectors / 10;
  disc.edge_variation = (reach[kSectors - 1 - tenth] - disc.radius_mm) / disc.radius_mm;
  return disc;
}

/// Whether what bears a disc ends at the origin, where the top is stated: then the disc is the
/// upper face of a wheel or a flange that stands there.
bool stands_at_origin(const TableCloud& cloud, double disc_mm, double margin_mm) {
  constexpr double kLowest = 0.02;  // of the points below the disc, where a foot begins
  std::vector<double> below_mm;
  for (const Eigen::Vector3d& point : cloud.points) {
    if (point.z() < disc_mm - margin_mm) below_mm.push_back(point.z());
  }
  if (static_cast<double>(below_mm.size()) <
      kTopLimits.min_share * static_cast<double>(cloud.points.size()))
    return false;
  return std::abs(quantile(std::move(below_mm), kLowest)) <
         kTopLimits.relative_max_height * cloud.working_distance_mm;
}

/// The turntable top as a disc of horizontal points.
std::optional<TurntableTop> find_disc(const TableCloud& cloud) {
  constexpr std::size_t kFewest = 50;  // points
  // A normal is less certain than the plane of many points: its limit is wider.
  constexpr double kNormalNoise_rad = rad_from_deg(7.0);
  const double min_cosine = std::cos(kTopLimits.max_tilt_rad + kNormalNoise_rad);
  std::vector<Eigen::Vector3d> horizontal;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.normals[i].z() > min_cosine) horizontal.push_back(cloud.points[i]);
  }
  const auto enough = std::max<std::size_t>(
      kFewest,
      static_cast<std::size_t>(kTopLimits.min_share * static_cast<double>(cloud.points.size())));
  const double band_mm = kTopLimits.relative_band * cloud.working_distance_mm;
  const auto height = lowest_layer(horizontal, enough, band_mm);
  if (!height) return std::nullopt;
  Plane plane(Eigen::Vector3d::UnitZ(), -*height);
  std::vector<Eigen::Vector3d> on_it;
  for (const double share : {1.0, 0.5, 0.25, 0.25}) {  // of the band: closes on the plane
    on_it = near(horizontal, plane, std::max(share * band_mm, 5.0 * cloud.sigma_mm));
    if (on_it.size() < enough) return std::nullopt;
    plane = fit(on_it);
  }
  const Disc disc = disc_of(on_it);
  const double clearance_mm = kTopLimits.relative_clearance * cloud.working_distance_mm;
  const double margin_mm = std::max(2.0 * clearance_mm, 6.0 * cloud.sigma_mm);
  const auto below =
      std::count_if(cloud.points.begin(), cloud.points.end(), [&](const Eigen::Vector3d& p) {
        return plane.signedDistance(p) < -margin_mm && p.head<2>().norm() < 0.9 * disc.radius_mm;
      });
  const TurntableTop top{plane, clearance_mm, false};
  const bool nothing_below =
      static_cast<double>(below) <= kTopLimits.max_below * static_cast<double>(on_it.size());
  const bool level = plane.normal().z() > std::cos(kTopLimits.max_tilt_rad);
  const bool round = disc.visible_edge >= kTopLimits.min_visible_edge &&
                     disc.edge_variation < kTopLimits.max_edge_variation;
  const double above_mm = reach_above(cloud.points, top.height_mm() + margin_mm);
  const bool carries_part = above_mm > 0.0;  // else it is the top of a rod
  const bool expected =
      carries_part &&
      (std::abs(top.height_mm()) < kTopLimits.relative_max_height * cloud.working_distance_mm ||
       (disc.radius_mm > kTopLimits.min_width_ratio * above_mm &&
        !stands_at_origin(cloud, top.height_mm(), margin_mm)));
  return nothing_below && level && round && expected ? std::optional(top) : std::nullopt;
}

}  // namespace

std::optional<TurntableTop> find_turntable_top(const ViewStore& views,
                                               const CameraModel& camera,
                                               const Run& run) {
  const TableCloud cloud = gather_table_cloud(views, camera, run);
  if (cloud.points.empty()) return std::nullopt;
  if (const auto disc = find_disc(cloud)) return disc;
  const auto rim = find_turntable_rim(cloud);
  if (!rim) return std::nullopt;
  return TurntableTop{Plane(Eigen::Vector3d::UnitZ(), -rim->top_mm),
                      kTopLimits.relative_clearance * cloud.working_distance_mm,
                      true};
}

std::size_t clip_turntable_top(ViewStore& views, const CameraModel& camera, const Run& run) {
  const auto top = find_turntable_top(views, camera, run);
  return top ? clip_views_to_nothing(views, camera, top->clip(), run) : 0;
}

}  // namespace frangia
