#include "frangia/acceptance/measure_balls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/statistics.h"
#include "frangia/features/find_features.h"
#include "frangia/features/fit_shape.h"
#include "frangia/features/shape.h"

namespace frangia {
namespace {

/// Vertices of a mesh near a sphere, and where its surface ends.
struct BallRegion {
  std::vector<std::size_t> vertices;     ///< on the sphere
  std::vector<Eigen::Vector3d> borders;  ///< unit directions from its center
};

bool is_measured(const Mesh& mesh, std::size_t triangle) {
  if (!mesh.triangle_marks.empty() && mesh.triangle_marks[triangle] != Mark::Measured) return false;
  return mesh.vertex_marks.empty() ||
         std::all_of(mesh.triangles[triangle].begin(), mesh.triangles[triangle].end(), [&](auto v) {
           return mesh.vertex_marks[v] == Mark::Measured;
         });
}

/// Collects the measured vertices within `gate_mm` of a sphere. A vertex is on the border where a
/// triangle reaches from it beyond the sphere, or where the triangles around it do not close: its
/// edges then do not come in pairs.
BallRegion ball_region(const Mesh& mesh, const Shape& sphere, double gate_mm) {
  const auto residual = [&](std::size_t v) {
    return (mesh.vertices_mm[v].cast<double>() - sphere.center_mm).norm() - sphere.radius_mm;
  };
  std::vector<char> on(mesh.vertices_mm.size(), 0);
  for (std::size_t v = 0; v < on.size(); ++v)
    on[v] = std::abs(residual(v)) < gate_mm ? 1 : 0;
  std::vector<char> used(on.size(), 0);
  std::vector<char> border(on.size(), 0);
  std::vector<std::uint64_t> turn(on.size(), 0);  // sums of next - previous around a vertex
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Mesh::Triangle& corners = mesh.triangles[t];
    const bool whole =
        is_measured(mesh, t) &&
        std::all_of(corners.begin(), corners.end(), [&](auto v) { return on[v] != 0; });
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = corners[k];
      if (on[v] == 0) continue;
      if (!whole) {
        border[v] = 1;
      } else {
        used[v] = 1;
        turn[v] += corners[(k + 1) % 3];
        turn[v] -= corners[(k + 2) % 3];
      }
    }
  }
  BallRegion region;
  for (std::size_t v = 0; v < on.size(); ++v) {
    if (used[v] == 0) continue;
    if (border[v] != 0 || turn[v] != 0) {
      region.borders.push_back(
          (mesh.vertices_mm[v].cast<double>() - sphere.center_mm).normalized());
    } else {
      region.vertices.push_back(v);
    }
  }
  return region;
}

/// Buckets of unit directions, so that the ones near a direction are found without trying all.
class DirectionSet {
 public:
  /// `radius_rad` is at most 6 degrees.
  DirectionSet(const std::vector<Eigen::Vector3d>& directions, double radius_rad)
      : cells_(count(kAcross)), least_cosine_(std::cos(radius_rad)) {
    for (const Eigen::Vector3d& direction : directions)
      cells_[index(cell(direction))].push_back(direction);
  }
  /// Whether the set has a direction within the radius of this one.
  [[nodiscard]] bool has_near(const Eigen::Vector3d& direction) const {
    const Eigen::Vector3i middle = cell(direction);
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          const Eigen::Vector3i at = middle + Eigen::Vector3i(x, y, z);
          if (at.minCoeff() < 0 || at.maxCoeff() >= kAcross) continue;
          for (const Eigen::Vector3d& other : cells_[index(at)])
            if (other.dot(direction) > least_cosine_) return true;
        }
      }
    }
    return false;
  }

 private:
  static constexpr int kAcross = 18;  ///< cells of 0.11, above the chord of 6 degrees
  static std::size_t count(int across) {
    const auto n = static_cast<std::size_t>(across);
    return n * n * n;
  }
  static Eigen::Vector3i cell(const Eigen::Vector3d& direction) {
    return ((direction.array() + 1.0) * (0.5 * kAcross))
        .floor()
        .cast<int>()
        .max(0)
        .min(kAcross - 1)
        .matrix();
  }
  static std::size_t index(const Eigen::Vector3i& at) {
    const int cell = (at.z() * kAcross + at.y()) * kAcross + at.x();
    return static_cast<std::size_t>(cell);
  }
  std::vector<std::vector<Eigen::Vector3d>> cells_;
  double least_cosine_;
};

constexpr double kDiameterTolerance = 0.1;  ///< share by which a ball that is found may differ
constexpr double kLeavesSphere = 0.01;      ///< of the diameter, see measure_balls
constexpr double kAroundBorder = rad_from_deg(6.0);
constexpr double kCap = rad_from_deg(15.0);
constexpr double kLeastSeen = 0.2;
constexpr std::size_t kLeastCap = 10;  ///< points of a cap

/// Least width of an interval that contains a share of the values, which are sorted.
double width_of_share(const std::vector<double>& sorted, double share) {
  const auto inside =
      static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size()) - 1e-9));
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t first = 0; first + inside <= sorted.size(); ++first)
    least = std::min(least, sorted[first + inside - 1] - sorted[first]);
  return least;
}

/// Share of the sphere within 6 degrees of a direction, of directions that cover it evenly.
double seen_share(const std::vector<Eigen::Vector3d>& directions) {
  const DirectionSet near(directions, kAroundBorder);
  constexpr int kSamples = 2000;  // of a spiral
  const double golden = kPi * (3.0 - std::sqrt(5.0));
  int seen = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / kSamples;
    const double radius = std::sqrt(1.0 - z * z);
    if (near.has_near({radius * std::cos(golden * i), radius * std::sin(golden * i), z})) ++seen;
  }
  return static_cast<double>(seen) / kSamples;
}

/// A ball, and the points that it is measured with.
struct BallPoints {
  MeasuredBall ball;
  std::vector<Eigen::Vector3d> points_mm;
};

BallPoints measure_ball(const Mesh& mesh, const Shape& found, const Run& run) {
  const BallRegion region = ball_region(mesh, found, 2.0 * kLeavesSphere * found.radius_mm);
  const DirectionSet borders(region.borders, kAroundBorder);
  FeaturePoints points;
  std::vector<Eigen::Vector3d> directions;
  for (const std::size_t v : region.vertices) {
    const Eigen::Vector3d point = mesh.vertices_mm[v].cast<double>();
    const Eigen::Vector3d direction = (point - found.center_mm).normalized();
    if (borders.has_near(direction)) continue;
    points.points_mm.push_back(point);
    directions.push_back(direction);
  }
  points.normals = directions;
  BallPoints out;
  out.ball.points = points.size();
  out.ball.seen = directions.empty() ? 0.0 : seen_share(directions);
  if (out.ball.seen < kLeastSeen) {
    throw Error(ErrorKind::Input,
                fmt::format("only {:.0f} % of a ball of {:.1f} mm is measured; at least {:.0f} % "
                            "are needed, from more views or a better place",
                            100.0 * out.ball.seen,
                            2.0 * found.radius_mm,
                            100.0 * kLeastSeen));
  }
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0U);
  const ShapeFit fit = fit_shape(
      points, all, found, {.gate_mm = 4.0 * kLeavesSphere * found.radius_mm, .robust = false}, run);
  out.ball.center_mm = fit.shape.center_mm;
  out.ball.diameter_mm = 2.0 * fit.shape.radius_mm;
  std::vector<double> residuals;
  residuals.reserve(points.size());
  for (const Eigen::Vector3d& point : points.points_mm)
    residuals.push_back((point - fit.shape.center_mm).norm() - fit.shape.radius_mm);
  std::sort(residuals.begin(), residuals.end());
  out.ball.form_95_mm = width_of_share(residuals, 0.95);
  out.ball.form_all_mm = width_of_share(residuals, 0.997);
  out.points_mm = std::move(points.points_mm);
  return out;
}

/// Median distance from the center of the points around a direction: where the cap's pole is. NaN
/// where it is not seen.
double pole_of(const BallPoints& ball, const Eigen::Vector3d& direction) {
  std::vector<double> radii;
  const double least = std::cos(kCap);
  for (const Eigen::Vector3d& point : ball.points_mm) {
    const Eigen::Vector3d from = point - ball.ball.center_mm;
    if (from.dot(direction) > least * from.norm()) radii.push_back(from.norm());
  }
  if (radii.size() < kLeastCap) return kMissing;
  return median(radii);
}

/// The spheres of the mesh that may be ball `i` of the artifact, the largest first.
std::vector<Shape> candidates(const std::vector<Feature>& features, double diameter_mm) {
  std::vector<Shape> shapes;
  for (const Feature& feature : features) {
    const Shape& shape = feature.fit.shape;
    if (shape.kind == ShapeKind::Sphere && !feature.hole &&
        std::abs(2.0 * shape.radius_mm - diameter_mm) < kDiameterTolerance * diameter_mm)
      shapes.push_back(shape);
  }
  return shapes;
}

[[noreturn]] void fail_without(const ReferenceArtifact& artifact, std::size_t ball) {
  throw Error(ErrorKind::Input,
              fmt::format("no ball of {:g} mm is found; check diameters_mm and whether the ball "
                          "is in view",
                          artifact.diameters_mm[ball]));
}

}  // namespace

MeasuredArtifact measure_balls(const Mesh& mesh,
                               const ReferenceArtifact& artifact,
                               const Run& run) {
  const std::vector<Feature> features = find_features(mesh, {.edges = false}, run);
  const std::vector<Shape> first = candidates(features, artifact.diameters_mm[0]);
  if (first.empty()) fail_without(artifact, 0);
  MeasuredArtifact out;
  if (artifact.diameters_mm.size() == 1) {
    out.balls.push_back(measure_ball(mesh, first[0], run).ball);
    return out;
  }
  const std::vector<Shape> second = candidates(features, artifact.diameters_mm[1]);
  if (second.empty()) fail_without(artifact, 1);
  // The pair whose spacing comes nearest.
  std::array<const Shape*, 2> ends = {nullptr, nullptr};
  double least = kDiameterTolerance * artifact.spacing_mm;
  for (const Shape& a : first) {
    for (const Shape& b : second) {
      const double off = std::abs((a.center_mm - b.center_mm).norm() - artifact.spacing_mm);
      if (off >= least) continue;
      least = off;
      ends[0] = &a;
      ends[1] = &b;
    }
  }
  if (ends[0] == nullptr) {
    throw Error(ErrorKind::Input,
                fmt::format("no two balls {:g} mm from each other are found; check spacing_mm "
                            "and whether both balls are in view",
                            artifact.spacing_mm));
  }
  const BallPoints a = measure_ball(mesh, *ends[0], run);
  const BallPoints b = measure_ball(mesh, *ends[1], run);
  out.balls = {a.ball, b.ball};
  const Eigen::Vector3d between = b.ball.center_mm - a.ball.center_mm;
  out.spacing_mm = between.norm();
  const Eigen::Vector3d direction = between.normalized();
  out.length_mm = pole_of(a, -direction) + out.spacing_mm + pole_of(b, direction);
  return out;
}

}  // namespace frangia
