#include "frangia/calibrate/artifact/find_balls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/LU>

#include "frangia/core/random.h"

namespace frangia {
namespace {

/// Limits of `find_balls`.
struct FindBallsLimits {
  double tolerance = 0.02;      ///< distance from the sphere, as a share of its radius
  std::size_t min_points = 60;  ///< on one ball
  int tries = 4000;             ///< random sets of four points
};
constexpr FindBallsLimits kFindBallsLimits;

/// Largest relative error of a radius; a rig of unknown scale measures another one.
constexpr double kRadiusError = 0.25;

/// The sphere through four points; none where they lie in a plane.
std::optional<Sphere> sphere_through(const std::array<Eigen::Vector3d, 4>& points) {
  Eigen::Matrix3d across;
  Eigen::Vector3d right;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d side = points.at(static_cast<std::size_t>(i) + 1) - points[0];
    across.row(i) = side.transpose();
    right[i] = 0.5 * side.squaredNorm();
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(across);
  if (!solver.isInvertible()) return std::nullopt;
  const Eigen::Vector3d center = solver.solve(right);
  return Sphere{points[0] + center, center.norm(), 0.0};
}

std::vector<std::size_t> on_sphere(std::span<const Eigen::Vector3d> points,
                                   const std::vector<std::size_t>& open,
                                   const Sphere& sphere,
                                   double gate_mm) {
  std::vector<std::size_t> found;
  for (const std::size_t i : open)
    if (std::abs((points[i] - sphere.center_mm).norm() - sphere.radius_mm) < gate_mm)
      found.push_back(i);
  return found;
}

/// The ball with most points among those that are open.
std::optional<FoundBall> best_ball(std::span<const Eigen::Vector3d> points,
                                   const std::vector<std::size_t>& open,
                                   double radius_mm,
                                   std::uint64_t seed) {
  if (open.size() < kFindBallsLimits.min_points) return std::nullopt;
  const auto pick = [&](std::uint64_t stream, std::size_t count) {
    return static_cast<std::size_t>(uniform_from(stream) * static_cast<double>(count));
  };
  FoundBall best;
  for (int attempt = 0; attempt < kFindBallsLimits.tries; ++attempt) {
    const std::uint64_t stream = hash(seed, static_cast<std::uint64_t>(attempt));
    const Eigen::Vector3d& first = points[open[pick(hash(stream, 0), open.size())]];
    std::array<Eigen::Vector3d, 4> set{first};
    std::size_t chosen = 1;
    constexpr std::uint64_t kDraws = 60;
    for (std::uint64_t draw = 1; draw < kDraws && chosen < set.size(); ++draw) {
      const Eigen::Vector3d& other = points[open[pick(hash(stream, draw), open.size())]];
      const double distance = (other - first).norm();
      if (distance > 0.2 * radius_mm && distance < 1.5 * radius_mm) set.at(chosen++) = other;
    }
    if (chosen < set.size()) continue;
    const auto sphere = sphere_through(set);
    // The far side of a ball is not seen: its center is behind the points.
    if (!sphere || std::abs(sphere->radius_mm / radius_mm - 1.0) > kRadiusError ||
        sphere->center_mm.norm() < first.norm())
      continue;
    std::vector<std::size_t> found =
        on_sphere(points, open, *sphere, kFindBallsLimits.tolerance * sphere->radius_mm);
    if (found.size() > best.points.size()) best = {*sphere, std::move(found)};
  }
  constexpr int kRefinements = 4;
  for (int i = 0; i < kRefinements && best.points.size() >= kFindBallsLimits.min_points; ++i) {
    std::vector<Eigen::Vector3d> chosen;
    for (const std::size_t index : best.points)
      chosen.push_back(points[index]);
    best.sphere = fit_sphere(chosen);
    best.points =
        on_sphere(points, open, best.sphere, kFindBallsLimits.tolerance * best.sphere.radius_mm);
  }
  if (best.points.size() < kFindBallsLimits.min_points ||
      std::abs(best.sphere.radius_mm / radius_mm - 1.0) > kRadiusError)
    return std::nullopt;
  return best;
}

}  // namespace

std::vector<FoundBall> find_balls(std::span<const Eigen::Vector3d> points,
                                  double radius_mm,
                                  std::size_t count) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite()) open.push_back(i);
  std::vector<FoundBall> balls;
  while (balls.size() < count) {
    auto ball = best_ball(points, open, radius_mm, balls.size());
    if (!ball) break;
    constexpr double kBeside = 1.2;  // radii, within which nothing else is a ball
    std::erase_if(open, [&](std::size_t i) {
      return (points[i] - ball->sphere.center_mm).norm() < kBeside * ball->sphere.radius_mm;
    });
    balls.push_back(std::move(*ball));
  }
  return balls;
}

}  // namespace frangia
