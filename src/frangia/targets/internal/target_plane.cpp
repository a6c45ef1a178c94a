#include "frangia/targets/internal/target_plane.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "frangia/core/linear_algebra.h"
#include "frangia/core/random.h"

namespace frangia {
namespace {

struct RangePoint {
  Eigen::Vector3d point_mm;
  double sigma_mm = 0.0;  ///< along the viewing ray
};

/// The points around a spot, up to two of its half axes from the centre, but for its edge.
std::vector<RangePoint> points_around(const RangeGrid& range,
                                      const Image<Eigen::Vector2f>& rays,
                                      const Eigen::Vector2d& center_px,
                                      const Eigen::Matrix2d& axes_px) {
  constexpr double kReach = 2.2;    // half axes: 0.6 of a diameter around it
  constexpr double kEdge_px = 1.8;  // to both sides of the edge
  const Eigen::Matrix2d to_circle = axes_px.inverse();
  const double edge = kEdge_px / axes_px.col(1).norm();
  const Eigen::Vector2d half = kReach * (axes_px.array().square().rowwise().sum()).sqrt().matrix();
  const auto from = [](double value) { return std::max(0, static_cast<int>(std::floor(value))); };
  const int right =
      std::min(range.depth_mm.width() - 1, static_cast<int>(std::ceil(center_px.x() + half.x())));
  const int low =
      std::min(range.depth_mm.height() - 1, static_cast<int>(std::ceil(center_px.y() + half.y())));
  std::vector<RangePoint> points;
  for (int y = from(center_px.y() - half.y()); y <= low; ++y) {
    for (int x = from(center_px.x() - half.x()); x <= right; ++x) {
      const double depth = static_cast<double>(range.depth_mm(x, y));
      if (std::isnan(depth)) continue;
      const double radius = (to_circle * (Eigen::Vector2d(x, y) - center_px)).norm();
      if (radius > kReach || std::abs(radius - 1.0) < edge) continue;
      const Eigen::Vector2d ray = rays(x, y).cast<double>();
      points.push_back({depth * Eigen::Vector3d(ray.x(), ray.y(), 1.0),
                        static_cast<double>(range.sigma_mm(x, y))});
    }
  }
  return points;
}

/// Standard deviation of the distance of a point from a plane.
double sigma_across(const RangePoint& point, const Eigen::Vector3d& normal) {
  return point.sigma_mm * std::abs(normal.dot(point.point_mm)) / point.point_mm.norm();
}

/// The plane by least squares, with what the scatter of its points says of it.
TargetPlane fit(const std::vector<RangePoint>& points, const Eigen::Vector3d& near_normal) {
  TargetPlane plane;
  plane.points = points.size();
  Eigen::Vector3d normal = near_normal;
  double sum = 0.0;
  for (const RangePoint& point : points) {
    const double weight = 1.0 / std::pow(sigma_across(point, normal), 2);
    sum += weight;
    plane.center_mm += weight * point.point_mm;
  }
  plane.center_mm /= sum;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const RangePoint& point : points) {
    const Eigen::Vector3d away = point.point_mm - plane.center_mm;
    scatter += away * away.transpose() / std::pow(sigma_across(point, normal), 2);
  }
  const SymmetricEigen<3> eigen = symmetric_eigen(scatter);  // values ascend
  normal = eigen.vectors.col(0);
  if (normal.dot(plane.center_mm) > 0.0) normal = -normal;
  plane.normal = normal;
  plane.sides << eigen.vectors.col(1), eigen.vectors.col(2);
  // The scatter over the noise; where it is larger, neighbouring points share their errors.
  const double freedom = std::max(1.0, static_cast<double>(points.size()) - 3.0);
  constexpr double kAlike = 4.0;  // points whose errors are alike: a window of decoding
  const double excess = std::max(1.0, eigen.values[0] / freedom) * kAlike;
  plane.covariance.diagonal() << excess / sum, excess / eigen.values[1], excess / eigen.values[2];
  return plane;
}

/// The largest set of points on one plane, by random triplets.
std::vector<std::size_t> largest_plane(const std::vector<RangePoint>& points, double limit_mm) {
  constexpr std::uint64_t kTriplets = 80;  // half of the points on one plane: all but 1e-4 of them
  std::vector<std::size_t> best;
  for (std::uint64_t i = 0; i < kTriplets; ++i) {
    const auto pick = [&](std::uint64_t k) -> const RangePoint& {
      const double share = uniform_from(hash(hash(i), k));
      return points[static_cast<std::size_t>(share * static_cast<double>(points.size()))];
    };
    const Eigen::Vector3d origin = pick(0).point_mm;
    const Eigen::Vector3d normal = (pick(1).point_mm - origin).cross(pick(2).point_mm - origin);
    if (!(normal.norm() > 0.0)) continue;
    const Eigen::Vector3d unit = normal.normalized();
    std::vector<std::size_t> members;
    for (std::size_t k = 0; k < points.size(); ++k) {
      constexpr double kSigmas = 4.0;
      const double limit = std::max(limit_mm, kSigmas * sigma_across(points[k], unit));
      if (std::abs(unit.dot(points[k].point_mm - origin)) < limit) members.push_back(k);
    }
    if (members.size() > best.size()) best = std::move(members);
  }
  return best;
}

}  // namespace

double TargetPlane::variance_mm2(const Eigen::Vector3d& point_mm) const {
  const Eigen::Vector2d along = sides.transpose() * (point_mm - center_mm);
  const Eigen::Vector3d by(1.0, along.x(), along.y());
  return by.dot(covariance * by);
}

std::vector<TargetPlane> find_target_planes(const RangeGrid& range,
                                            const Image<Eigen::Vector2f>& rays,
                                            const Eigen::Vector2d& center_px,
                                            const Eigen::Matrix2d& axes_px) {
  constexpr std::size_t kFewest = 20;  // points of a plane
  constexpr std::size_t kPlanes = 3;   // that meet near a target
  constexpr double kFlat = 3e-5;       // of the distance: 15 um at 500 mm
  std::vector<RangePoint> left = points_around(range, rays, center_px, axes_px);
  std::vector<TargetPlane> planes;
  while (planes.size() < kPlanes && left.size() >= kFewest) {
    const double limit_mm = kFlat * left.front().point_mm.norm();
    const std::vector<std::size_t> members = largest_plane(left, limit_mm);
    if (members.size() < kFewest) break;
    std::vector<RangePoint> on;
    std::vector<RangePoint> off;
    std::size_t next = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const bool is_member = next < members.size() && members[next] == i;
      if (is_member) ++next;
      (is_member ? on : off).push_back(left[i]);
    }
    planes.push_back(fit(on, Eigen::Vector3d(0.0, 0.0, -1.0)));
    left = std::move(off);
  }
  return planes;
}

}  // namespace frangia
