#include "frangia/registration/internal/known_length.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/core/random.h"

namespace frangia {

KnownLength measure_known_length(const DriftBundle& bundle, const RefineRigOptions& options) {
  constexpr std::size_t kPoints = 40'000;  // of all views
  std::size_t surfels = 0;
  for (const DriftView& view : bundle.views)
    surfels += view.map.surfels.pixels().size();
  const std::size_t every = surfels / kPoints + 1;
  std::vector<OrientedPoint> points;
  std::vector<Eigen::Matrix3Xd> derivatives;  // of the points, object frame
  for (const DriftView& view : bundle.views) {
    const Eigen::Isometry3d object_from_rig =
        bundle.state.table.table.rig_from_object(bundle.state.table.angles_rad[view.station])
            .inverse();
    const auto own = view.map.surfels.pixels();
    for (std::size_t i = 0; i < own.size(); i += every) {
      if (!(own[i].sigma_mm > 0.0F)) continue;
      points.push_back({object_from_rig * own[i].point_mm.cast<double>(),
                        object_from_rig.linear() * own[i].normal.cast<double>()});
      derivatives.emplace_back(object_from_rig.linear() *
                               view.field.of(own[i].point_mm.cast<double>()).cast<double>());
    }
  }
  const auto pair = find_ball_pair(points);
  if (!pair) {
    throw Error(ErrorKind::Input,
                "the scan holds no two balls of one size, of which `length` could be the distance; "
                "scan a ball bar, or leave the length out");
  }
  KnownLength found;
  found.scale = *options.ball_distance_mm / pair->distance_mm();
  if (std::abs(found.scale - 1.0) > options.max_scale_error) {
    throw Error(
        ErrorKind::Input,
        fmt::format("the centers of the two balls are {:.3f} mm apart, but `length` is {:g} "
                    "mm; give the distance of their centers",
                    pair->distance_mm(),
                    *options.ball_distance_mm));
  }
  const auto mean_of = [&](const BarBall& ball) {
    Eigen::Matrix3Xd mean = Eigen::Matrix3Xd::Zero(3, bundle.state.w.size());
    for (const std::size_t i : ball.points)
      mean += derivatives[i] / static_cast<double>(ball.points.size());
    return mean;
  };
  const Eigen::Vector3d along =
      (pair->second.sphere.center_mm - pair->first.sphere.center_mm).normalized();
  const Eigen::VectorXd by_w = (mean_of(pair->second) - mean_of(pair->first)).transpose() * along;
  const double sigma_mm = options.relative_length_sigma * *options.ball_distance_mm;
  found.information = by_w * by_w.transpose() / (sigma_mm * sigma_mm);
  return found;
}

void scale_rig(Rig& rig, double factor) {
  rig.projector.position_mm *= factor;
  for (PosedCamera& camera : rig.cameras)
    camera.position_mm *= factor;
  if (rig.turntable) rig.turntable->point_mm *= factor;
  if (rig.laser_sheet) rig.laser_sheet->offset_mm *= factor;
}

namespace {

constexpr std::size_t kPointsPerBallPoint = 20;  // a ball holds at least one point in this many

/// Half of the size of all points, from their mean.
double extent_of(std::span<const OrientedPoint> points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const OrientedPoint& p : points)
    mean += p.point_mm / static_cast<double>(points.size());
  double largest = 0.0;
  for (const OrientedPoint& p : points)
    largest = std::max(largest, (p.point_mm - mean).norm());
  return largest;
}

/// The sphere that two oriented points lie on; a radius of 0 when there is none.
Sphere sphere_through(const OrientedPoint& a, const OrientedPoint& b, double extent_mm) {
  constexpr double kLeastTurn = 0.15;   // of the normals; smaller turns magnify their noise
  constexpr double kLargest = 0.5;      // radius, as a share of the extent
  constexpr double kConsistent = 0.02;  // distance of the two centers, as a share of the radius
  const Eigen::Vector3d turn = a.normal - b.normal;
  if (turn.squaredNorm() < kLeastTurn * kLeastTurn) return {};
  const double radius = (a.point_mm - b.point_mm).dot(turn) / turn.squaredNorm();
  if (!(radius > 0.0) || radius > kLargest * extent_mm) return {};
  const Eigen::Vector3d one = a.point_mm - radius * a.normal;
  const Eigen::Vector3d other = b.point_mm - radius * b.normal;
  if ((one - other).norm() > kConsistent * radius) return {};
  return {0.5 * (one + other), radius, 0.0};
}

bool lies_on(const OrientedPoint& p, const Sphere& sphere, double tolerance) {
  constexpr double kAligned = 0.96;  // cosine of 16 degrees
  const Eigen::Vector3d away = p.point_mm - sphere.center_mm;
  const double distance = away.norm();
  return std::abs(distance - sphere.radius_mm) < tolerance * sphere.radius_mm &&
         away.dot(p.normal) > kAligned * distance;
}

std::vector<std::size_t> points_on(std::span<const OrientedPoint> points,
                                   const std::vector<std::size_t>& of,
                                   const Sphere& sphere,
                                   double tolerance) {
  std::vector<std::size_t> on;
  for (const std::size_t i : of)
    if (lies_on(points[i], sphere, tolerance)) on.push_back(i);
  return on;
}

/// The ball that holds most of the points `of`.
std::optional<BarBall> find_ball(std::span<const OrientedPoint> points,
                                 const std::vector<std::size_t>& of,
                                 double extent_mm) {
  constexpr std::size_t kPairs = 4000;
  constexpr std::size_t kChunk = 100;
  constexpr std::size_t kProbes = 1000;  // points that score a hypothesis
  constexpr double kRough = 0.02;        // of the radius
  constexpr double kFine = 0.005;
  if (of.size() < 2) return std::nullopt;
  const std::size_t stride = of.size() / kProbes + 1;
  struct Best {
    std::size_t score = 0;
    Sphere sphere;
  };
  std::vector<Best> best(kPairs / kChunk);
  parallel_chunks(best.size(), 1, [&](std::size_t chunk, std::size_t /*end*/) {
    for (std::size_t pair = chunk * kChunk; pair < (chunk + 1) * kChunk; ++pair) {
      const auto pick = [&](std::uint64_t which) { return of[hash(pair, which) % of.size()]; };
      const Sphere sphere = sphere_through(points[pick(1)], points[pick(2)], extent_mm);
      if (!(sphere.radius_mm > 0.0)) continue;
      std::size_t score = 0;
      for (std::size_t i = 0; i < of.size(); i += stride)
        score += lies_on(points[of[i]], sphere, kRough) ? 1U : 0U;
      if (score > best[chunk].score) best[chunk] = {score, sphere};
    }
  });
  const auto most = std::max_element(
      best.begin(), best.end(), [](const Best& a, const Best& b) { return a.score < b.score; });
  Sphere sphere = most->sphere;
  std::vector<std::size_t> on;
  for (const double tolerance : {kRough, kRough, kFine, kFine}) {
    on = points_on(points, of, sphere, tolerance);
    if (on.size() < points.size() / kPointsPerBallPoint || on.size() < 4) return std::nullopt;
    std::vector<Eigen::Vector3d> places;
    for (const std::size_t i : on)
      places.push_back(points[i].point_mm);
    sphere = fit_sphere(places);
  }
  return BarBall{sphere, std::move(on)};
}

}  // namespace

std::optional<BallPair> find_ball_pair(std::span<const OrientedPoint> points) {
  const double extent_mm = extent_of(points);
  std::vector<std::size_t> left(points.size());
  for (std::size_t i = 0; i < left.size(); ++i)
    left[i] = i;
  std::optional<BarBall> first = find_ball(points, left, extent_mm);
  if (!first) return std::nullopt;
  constexpr double kNear = 0.1;  // of the radius: what is left of a ball is no second one
  std::erase_if(left, [&](std::size_t i) { return lies_on(points[i], first->sphere, kNear); });
  std::optional<BarBall> second = find_ball(points, left, extent_mm);
  if (!second) return std::nullopt;
  const double ratio = second->sphere.radius_mm / first->sphere.radius_mm;
  constexpr double kAlike = 0.1;  // the balls of a bar have one diameter
  if (std::abs(ratio - 1.0) > kAlike) return std::nullopt;
  return BallPair{std::move(*first), std::move(*second)};
}

}  // namespace frangia
