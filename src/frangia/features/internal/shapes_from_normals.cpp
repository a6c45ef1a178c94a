#include "frangia/features/internal/shapes_from_normals.h"

#include <cmath>
#include <optional>

#include <Eigen/Geometry>

#include "frangia/core/linear_algebra.h"

namespace frangia {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Sums over the points of a patch, about their mean.
struct PatchMoments {
  Vector3d mean = Vector3d::Zero();
  Vector3d mean_normal = Vector3d::Zero();
  Matrix3d normals = Matrix3d::Zero();  ///< mean of n n^T
  Matrix3d moments = Matrix3d::Zero();  ///< mean of m m^T, m = p x n
  Matrix3d mixed = Matrix3d::Zero();    ///< mean of n m^T
  Vector3d heights = Vector3d::Zero();  ///< mean of n (n . p)
};

using Span3 = std::span<const Vector3d>;

PatchMoments moments_of(Span3 points, Span3 normals) {
  PatchMoments sums;
  const double share = 1.0 / static_cast<double>(points.size());
  for (const Vector3d& point : points)
    sums.mean += share * point;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d p = points[i] - sums.mean;
    const Vector3d& n = normals[i];
    const Vector3d m = p.cross(n);
    sums.mean_normal += share * n;
    sums.normals += share * n * n.transpose();
    sums.moments += share * m * m.transpose();
    sums.mixed += share * n * m.transpose();
    sums.heights += share * n * n.dot(p);
  }
  return sums;
}

std::optional<Shape> sphere_of(const PatchMoments& sums, Span3 points) {
  // Nearest point to all normal lines.
  const Matrix3d across = Matrix3d::Identity() - sums.normals;
  const Vector3d right = -sums.heights;
  const Vector3d center = solve_symmetric(across, right);
  if (!center.allFinite()) return std::nullopt;
  Shape shape{ShapeKind::Sphere};
  shape.center_mm = sums.mean + center;
  for (const Vector3d& point : points)
    shape.radius_mm += (point - shape.center_mm).norm() / static_cast<double>(points.size());
  return shape;
}

/// The radius of each point about an axis and its height along it.
struct Profile {
  std::vector<double> radii, heights;
};

Profile profile_of(const Shape& shape, Span3 points) {
  Profile profile;
  for (const Vector3d& point : points) {
    const Vector3d from = point - shape.center_mm;
    const double height = from.dot(shape.axis);
    profile.heights.push_back(height);
    profile.radii.push_back((from - height * shape.axis).norm());
  }
  return profile;
}

std::optional<Shape> cylinder_of(const PatchMoments& sums, Span3 points, Span3 normals) {
  Shape shape{ShapeKind::Cylinder};
  shape.axis = symmetric_eigen(sums.normals).vectors.col(0);
  // Nearest point of the plane across the axis to all normal lines.
  Matrix3d left = Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d n = (normals[i] - normals[i].dot(shape.axis) * shape.axis).normalized();
    const Vector3d from = points[i] - sums.mean;
    const Vector3d p = from - from.dot(shape.axis) * shape.axis;
    const Matrix3d across =
        Matrix3d::Identity() - shape.axis * shape.axis.transpose() - n * n.transpose();
    left += across;
    right += across * p;
  }
  left += left.trace() * shape.axis * shape.axis.transpose();
  const Vector3d center = solve_symmetric(left, right);
  if (!center.allFinite()) return std::nullopt;
  shape.center_mm = sums.mean + center;
  const Profile profile = profile_of(shape, points);
  for (const double radius : profile.radii)
    shape.radius_mm += radius / static_cast<double>(points.size());
  return shape;
}

std::optional<Shape> cone_of(const PatchMoments& sums, Span3 points) {
  const Matrix3d spread = sums.normals - sums.mean_normal * sums.mean_normal.transpose();
  Shape shape{ShapeKind::Cone};
  shape.axis = symmetric_eigen(spread).vectors.col(0);
  // All tangent planes contain the apex.
  const Vector3d apex = solve_symmetric(sums.normals, sums.heights);
  if (!apex.allFinite()) return std::nullopt;
  if (shape.axis.dot(apex) > 0.0) shape.axis = -shape.axis;  // grows along the axis
  shape.center_mm = sums.mean + apex - apex.dot(shape.axis) * shape.axis;
  const double sine = std::abs(sums.mean_normal.dot(shape.axis));
  constexpr double kMost = 0.98;  // flatter cones are planes
  if (!(sine < kMost)) return std::nullopt;
  shape.half_angle_rad = std::asin(sine);
  const Profile profile = profile_of(shape, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    shape.radius_mm += (profile.radii[i] - profile.heights[i] * std::tan(shape.half_angle_rad)) /
                       static_cast<double>(points.size());
  }
  return shape;
}

std::optional<Shape> torus_of(const PatchMoments& sums, Span3 points) {
  // The normals of a surface of revolution intersect its axis: n . b + m . a = 0 for the axis'
  // direction a and moment b. Eliminating b leaves a quadratic form in a.
  const Matrix3d by_direction = solve_symmetric_columns(sums.normals, sums.mixed);
  const Matrix3d form = sums.moments - sums.mixed.transpose() * by_direction;
  Shape shape{ShapeKind::Torus};
  shape.axis = symmetric_eigen(form).vectors.col(0);
  const Vector3d moment = -by_direction * shape.axis;
  if (!moment.allFinite()) return std::nullopt;
  shape.center_mm = sums.mean + shape.axis.cross(moment);
  // A circle through the profile, by algebraic least squares.
  const Profile profile = profile_of(shape, points);
  Matrix3d left = Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d row(profile.radii[i], profile.heights[i], 1.0);
    left += row * row.transpose();
    right += row * (row.x() * row.x() + row.y() * row.y());
  }
  const Vector3d circle = solve_symmetric(left, right);
  const double squared = circle.z() + 0.25 * circle.head<2>().squaredNorm();
  if (!circle.allFinite() || !(squared > 0.0) || !(circle.x() > 0.0)) return std::nullopt;
  shape.radius_mm = 0.5 * circle.x();
  shape.center_mm += 0.5 * circle.y() * shape.axis;
  shape.tube_radius_mm = std::sqrt(squared);
  return shape;
}

}  // namespace

std::vector<Shape> shapes_from_normals(Span3 points_mm, Span3 normals) {
  std::vector<Shape> shapes;
  if (points_mm.size() < 4) return shapes;
  const PatchMoments sums = moments_of(points_mm, normals);
  Shape plane{ShapeKind::Plane, sums.mean, sums.mean_normal.normalized()};
  if (plane.axis.allFinite()) shapes.push_back(plane);
  for (const auto& shape : {sphere_of(sums, points_mm),
                            cylinder_of(sums, points_mm, normals),
                            cone_of(sums, points_mm),
                            torus_of(sums, points_mm)})
    if (shape) shapes.push_back(*shape);
  return shapes;
}

}  // namespace frangia
