#include "frangia/registration/find_turntable_top.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/symmetric_eigen.h"
#include "frangia/local_fit/surfel_map.h"

namespace frangia {
namespace {

struct Cloud {
  std::vector<Eigen::Vector3d> level;  ///< points whose normal is up
  std::vector<Eigen::Vector3d> all;
  double sigma_mm = 0.0;
};

Cloud gather(const ViewStore& views,
             const CameraModel& camera,
             double max_tilt_rad,
             const Run& run) {
  constexpr std::size_t kSurfels = 20000;
  const CameraRays rays(camera);
  // A normal is less certain than the plane of many points: allow it some degrees more.
  const double upright = std::cos(max_tilt_rad + rad_from_deg(7.0));
  Cloud cloud;
  std::vector<float> sigmas;
  LocalPlanes planes;
  for (std::size_t i = 0; i < views.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(views.size()));
    planes = local_planes(views.load_points(i), rays, {}, std::move(planes));
    const Eigen::Isometry3d object_from_rig = views.rig_from_object(i).inverse();
    for (const auto& surfel :
         pick_surfels(make_surfel_map(planes, rays, 16 * kSurfels), kSurfels)) {
      const Eigen::Vector3d point = object_from_rig * surfel.point_mm.cast<double>();
      const Eigen::Vector3d normal = object_from_rig.linear() * surfel.normal.cast<double>();
      cloud.all.push_back(point);
      if (normal.z() > upright) cloud.level.push_back(point);
      sigmas.push_back(surfel.sigma_mm);
    }
  }
  if (!sigmas.empty()) {
    const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
    std::nth_element(sigmas.begin(), middle, sigmas.end());
    cloud.sigma_mm = static_cast<double>(*middle);
  }
  return cloud;
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

/// The plane that fits points best, upwards.
Plane fit(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& point : points)
    middle += point;
  middle /= static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto& point : points)
    spread += (point - middle) * (point - middle).transpose();
  Eigen::Vector3d normal = symmetric_eigen(spread).vectors.col(0);
  if (normal.z() < 0.0) normal = -normal;
  return {normal, middle};
}

/// The lowest height at which many level points lie.
std::optional<double> lowest_level(const Cloud& cloud, std::size_t enough) {
  std::vector<double> heights;
  for (const auto& point : cloud.level)
    heights.push_back(point.z());
  std::sort(heights.begin(), heights.end());
  // Wide enough for a turntable top that is tilted against the axis as it is given.
  constexpr double kBand_mm = 2.0;
  for (std::size_t i = 0; i + enough < heights.size(); ++i) {
    if (heights[i + enough] - heights[i] < kBand_mm) return heights[i + enough / 2];
  }
  return std::nullopt;
}

/// A disc about the axis: how far it reaches, and how much of a disc it is.
struct Disc {
  double radius_mm = 0.0;
  double visible_edge = 0.0;    ///< share of the directions about the axis in which it has a rim
  double edge_variation = 1.0;  ///< by how much of the radius the rim varies, but for a tenth of it
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

/// How far from the axis what stands above the plane reaches, but for a hundredth of it.
double reach_above(const std::vector<Eigen::Vector3d>& points,
                   const Plane& plane,
                   double margin_mm) {
  std::vector<double> reach;
  for (const auto& point : points) {
    if (plane.signedDistance(point) > margin_mm) reach.push_back(point.head<2>().norm());
  }
  if (reach.empty()) return 0.0;
  const auto most = reach.begin() + static_cast<std::ptrdiff_t>(reach.size() * 99 / 100);
  std::nth_element(reach.begin(), most, reach.end());
  return *most;
}

}  // namespace

std::optional<Plane> find_turntable_top(const ViewStore& views,
                                        const CameraModel& camera,
                                        const TurntableTopOptions& options,
                                        const Run& run) {
  const Cloud cloud = gather(views, camera, options.max_tilt_rad, run);
  const auto enough =
      static_cast<std::size_t>(options.min_share * static_cast<double>(cloud.all.size()));
  const auto height = lowest_level(cloud, std::max<std::size_t>(enough, 50));
  if (!height) return std::nullopt;
  Plane plane(Eigen::Vector3d::UnitZ(), -*height);
  std::vector<Eigen::Vector3d> on_it;
  for (const double within_mm : {2.0, 1.0, 0.5, 0.5}) {
    on_it = near(cloud.level, plane, std::max(within_mm, 5.0 * cloud.sigma_mm));
    if (on_it.size() < std::max<std::size_t>(enough, 50)) return std::nullopt;
    plane = fit(on_it);
  }
  const Disc disc = disc_of(on_it);
  const double margin_mm = std::max(1.0, 6.0 * cloud.sigma_mm);
  const auto below =
      std::count_if(cloud.all.begin(), cloud.all.end(), [&](const Eigen::Vector3d& p) {
        return plane.signedDistance(p) < -margin_mm && p.head<2>().norm() < 0.9 * disc.radius_mm;
      });
  const bool nothing_below =
      static_cast<double>(below) <= options.max_below * static_cast<double>(on_it.size());
  const bool level = plane.normal().z() > std::cos(options.max_tilt_rad);
  const bool round = disc.visible_edge >= options.min_visible_edge &&
                     disc.edge_variation < options.max_edge_variation;
  const bool expected =
      std::abs(plane.offset() / plane.normal().z()) < options.max_height_mm ||
      disc.radius_mm > options.min_width_ratio * reach_above(cloud.all, plane, margin_mm);
  return nothing_below && level && round && expected ? std::optional(plane) : std::nullopt;
}

}  // namespace frangia
