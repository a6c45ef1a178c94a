#include "frangia/inspect/blade_section.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kStations = 800;  ///< points of the resampled profile

/// A closed curve at equal steps.
struct Profile {
  std::vector<Vector2d> points_mm;
  std::vector<Vector2d> inward;  ///< unit normals
  double step_mm = 0.0;

  [[nodiscard]] std::size_t count() const { return points_mm.size(); }
};

Profile resampled(const SectionCurve& curve) {
  Profile profile;
  const auto& from = curve.points_mm;
  const double length = length_mm(curve);
  profile.step_mm = length / static_cast<double>(kStations);
  double walked = 0.0;
  for (std::size_t i = 0; i < from.size() && profile.count() < kStations; ++i) {
    const Vector2d& a = from[i];
    const Vector2d& b = from[(i + 1) % from.size()];
    const double edge = (b - a).norm();
    while (profile.count() < kStations) {
      const double at = profile.step_mm * static_cast<double>(profile.count());
      if (at > walked + edge || !(edge > 0.0)) break;
      profile.points_mm.push_back(a + (at - walked) / edge * (b - a));
    }
    walked += edge;
  }
  double area = 0.0;
  for (std::size_t i = 0; i < profile.count(); ++i) {
    const Vector2d& a = profile.points_mm[i];
    const Vector2d& b = profile.points_mm[(i + 1) % profile.count()];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  if (area < 0.0) std::reverse(profile.points_mm.begin(), profile.points_mm.end());
  constexpr std::size_t kHalf = 3;  // stations of the tangent to each side
  for (std::size_t i = 0; i < profile.count(); ++i) {
    const Vector2d& before = profile.points_mm[(i + profile.count() - kHalf) % profile.count()];
    const Vector2d& after = profile.points_mm[(i + kHalf) % profile.count()];
    const Vector2d tangent = (after - before).normalized();
    profile.inward.emplace_back(-tangent.y(), tangent.x());
  }
  return profile;
}

/// A circle within a profile, and the point that it touches apart from its own.
struct InscribedCircle {
  Vector2d center_mm = Vector2d::Zero();
  double radius_mm = std::numeric_limits<double>::infinity();
  std::size_t touched = 0;
};

/// The largest circle within the profile that is tangent at a point.
InscribedCircle circle_at(const Profile& profile, std::size_t i) {
  InscribedCircle circle;
  constexpr std::size_t kBeside = 4;  // neighbours say nothing about the other side
  const Vector2d& p = profile.points_mm[i];
  for (std::size_t k = 0; k < profile.count(); ++k) {
    const std::size_t apart = i > k ? i - k : k - i;
    if (std::min(apart, profile.count() - apart) <= kBeside) continue;
    const Vector2d way = profile.points_mm[k] - p;
    const double height = way.dot(profile.inward[i]);
    if (height <= 0.0) continue;
    const double radius = way.squaredNorm() / (2.0 * height);
    if (radius >= circle.radius_mm) continue;
    circle.radius_mm = radius;
    circle.touched = k;
  }
  circle.center_mm = p + circle.radius_mm * profile.inward[i];
  return circle;
}

/// The radius of a circle of least squares; infinite for points on a line.
double fitted_radius(const std::vector<Vector2d>& points) {
  Vector2d mean = Vector2d::Zero();
  for (const Vector2d& p : points)
    mean += p / static_cast<double>(points.size());
  Eigen::Matrix3d sums = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Vector2d& p : points) {
    const Vector2d q = p - mean;
    const Eigen::Vector3d row(q.x(), q.y(), 1.0);
    sums += row * row.transpose();
    right += q.squaredNorm() * row;
  }
  const Eigen::Vector3d solved = sums.inverse() * right;
  Vector2d center = 0.5 * solved.head<2>();
  double radius = std::sqrt(std::max(0.0, solved[2] + center.squaredNorm()));
  for (int iteration = 0; iteration < 10; ++iteration) {
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (const Vector2d& p : points) {
      const Vector2d way = p - mean - center;
      const double distance = std::max(way.norm(), 1e-12);
      const Eigen::Vector3d row(-way.x() / distance, -way.y() / distance, -1.0);
      hessian += row * row.transpose();
      gradient += (distance - radius) * row;
    }
    const Eigen::Vector3d step = hessian.inverse() * gradient;
    if (!step.allFinite()) break;
    center -= step.head<2>();
    radius -= step[2];
  }
  return std::isfinite(radius) ? std::abs(radius) : std::numeric_limits<double>::infinity();
}

/// The radius of the edge around a station: that of the points within 0.9 radii along the curve.
double edge_radius(const SectionCurve& curve, const Profile& profile, std::size_t end) {
  double radius = circle_at(profile, end).radius_mm;
  const Vector2d& tip = profile.points_mm[end];
  for (int iteration = 0; iteration < 12; ++iteration) {
    // On a circle an arc of 0.9 radii has a chord of 0.87 radii.
    const double reach = std::max(0.87 * radius, 3.0 * profile.step_mm);
    std::vector<Vector2d> points;
    for (const Vector2d& p : curve.points_mm)
      if ((p - tip).norm() < reach) points.push_back(p);
    for (const Vector2d& p : profile.points_mm)
      if (points.size() < 8 && (p - tip).norm() < 2.0 * reach) points.push_back(p);
    if (points.size() < 5) break;
    const double fitted = fitted_radius(points);
    if (!std::isfinite(fitted)) break;
    const bool settled = std::abs(fitted - radius) < 1e-6 * radius;
    radius = 0.5 * (radius + fitted);
    if (settled) break;
  }
  return radius;
}

/// The two stations that are farthest from each other.
std::pair<std::size_t, std::size_t> chord_ends(const Profile& profile) {
  std::pair<std::size_t, std::size_t> ends{0, 0};
  double farthest = 0.0;
  for (std::size_t i = 0; i < profile.count(); ++i) {
    for (std::size_t k = i + 1; k < profile.count(); ++k) {
      const double distance = (profile.points_mm[i] - profile.points_mm[k]).squaredNorm();
      if (distance <= farthest) continue;
      farthest = distance;
      ends = {i, k};
    }
  }
  return ends;
}

}  // namespace

BladeSection measure_blade_section(const SectionCurve& curve) {
  require(curve.closed,
          "the section of a blade is not closed; cut where the profile was measured all around");
  require(curve.points_mm.size() >= 32,
          "the section of a blade has fewer than 32 points; use a finer mesh");
  const Profile profile = resampled(curve);
  const auto [first, second] = chord_ends(profile);
  double leading = edge_radius(curve, profile, first);
  double trailing = edge_radius(curve, profile, second);
  const bool swapped = leading < trailing;
  if (swapped) std::swap(leading, trailing);
  const std::size_t nose = swapped ? second : first;
  const std::size_t tail = swapped ? first : second;

  BladeSection blade;
  blade.leading_mm = profile.points_mm[nose];
  blade.trailing_mm = profile.points_mm[tail];
  blade.leading_radius_mm = leading;
  blade.trailing_radius_mm = trailing;
  const Vector2d chord = blade.trailing_mm - blade.leading_mm;
  blade.chord_mm = chord.norm();
  double angle = std::atan2(chord.y(), chord.x());
  if (angle > 0.5 * kPi) angle -= kPi;
  if (angle <= -0.5 * kPi) angle += kPi;
  blade.stagger_rad = angle;
  // From the nose to the tail along one side; the touched points must be on the other.
  const std::size_t side = (tail + profile.count() - nose) % profile.count();
  const Vector2d along = chord / blade.chord_mm;
  const Vector2d across(-along.y(), along.x());
  for (std::size_t k = 1; k < side; ++k) {
    const InscribedCircle circle = circle_at(profile, (nose + k) % profile.count());
    const std::size_t touched = (circle.touched + profile.count() - nose) % profile.count();
    if (touched <= side || !std::isfinite(circle.radius_mm)) continue;
    blade.max_thickness_mm = std::max(blade.max_thickness_mm, 2.0 * circle.radius_mm);
    blade.camber_mm.push_back(circle.center_mm);
    const double off = (circle.center_mm - blade.leading_mm).dot(across);
    blade.max_camber_mm = std::max(blade.max_camber_mm, std::abs(off));
  }
  require(blade.max_thickness_mm > 0.0 && blade.max_thickness_mm < 0.7 * blade.chord_mm,
          "the section is not a slender profile with two edges; choose another plane");
  return blade;
}

}  // namespace frangia
