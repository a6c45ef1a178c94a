#include <algorithm>
#include <cmath>
#include <variant>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/calibrate/check/check_kinds.h"
#include "frangia/calibrate/check/internal/check_limits.h"
#include "frangia/calibrate/internal/artifact_sites.h"

namespace frangia {
namespace {

/// Mean and standard deviation of the mean.
struct MeanOf {
  double mean = 0.0;
  double sigma = 0.0;
};

MeanOf mean_of(const std::vector<double>& values) {
  MeanOf out;
  const auto count = static_cast<double>(values.size());
  for (const double value : values)
    out.mean += value / count;
  double square = 0.0;
  for (const double value : values)
    square += (value - out.mean) * (value - out.mean);
  if (values.size() > 1) out.sigma = std::sqrt(square / (count - 1.0) / count);
  return out;
}

/// std::vector<Eigen::Vector3d> of a view that lie on one surface of the artifact, in the rig
/// frame.
std::vector<Eigen::Vector3d> points_on(const ArtifactView& view, int surface, const Rig& rig) {
  const std::vector<Eigen::Vector3d> all = site_points(view.sites, rig);
  std::vector<Eigen::Vector3d> out;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (view.surface[i] == surface && all[i].allFinite()) out.push_back(all[i]);
  return out;
}

/// Center of a ball of known radius, which a cap determines far better than one whose radius is
/// free.
Eigen::Vector3d center_of(const std::vector<Eigen::Vector3d>& points,
                          Eigen::Vector3d center,
                          double radius_mm) {
  constexpr int kIterations = 10;
  for (int i = 0; i < kIterations; ++i) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d outwards = (point - center).normalized();
      normal += outwards * outwards.transpose();
      right += outwards * ((point - center).norm() - radius_mm);
    }
    center += normal.ldlt().solve(right);
  }
  return center;
}

}  // namespace

RigCheck check_balls_of(const Scan& scan,
                        const CheckRigOptions& options,
                        const CheckedCamera& camera,
                        const Run& run) {
  const Rig& rig = scan.rig;
  const auto& balls = std::get<Balls>(*scan.artifact);
  const ArtifactCapture capture = measure_balls(scan, rig, options.measure, run);
  const std::size_t count = capture.surfaces.size();
  std::vector<double> spacings;
  std::vector<std::vector<double>> diameters(count);
  std::vector<std::vector<Eigen::Vector3d>> centers(count);
  std::vector<Eigen::Vector3d> all;
  for (const ArtifactView& view : capture.views) {
    const Eigen::Isometry3d to_zero =
        rig.turntable ? table_turn(rig, -view.angle_rad) : Eigen::Isometry3d::Identity();
    std::vector<Eigen::Vector3d> here;
    for (std::size_t b = 0; b < count; ++b) {
      const std::vector<Eigen::Vector3d> points = points_on(view, static_cast<int>(b), rig);
      const Sphere sphere = fit_sphere(points);
      diameters[b].push_back(2.0 * sphere.radius_mm);
      const Eigen::Vector3d center = center_of(points, sphere.center_mm, 0.5 * balls.diameter_mm);
      centers[b].push_back(to_zero * center);
      here.push_back(center);
      all.insert(all.end(), points.begin(), points.end());
    }
    if (count == 2) spacings.push_back((here[1] - here[0]).norm());
  }
  CheckLimits limits(
      camera, all, options, {.views = capture.views.size(), .left_out = capture.left_out});
  if (count == 2) {
    const MeanOf spacing = mean_of(spacings);
    limits.add("spacing",
               spacing.mean - *balls.spacing_mm,
               spacing.sigma,
               2.0,
               fmt::format("{:.4f} mm, {:g} mm are known", spacing.mean, *balls.spacing_mm));
  }
  for (std::size_t b = 0; b < count; ++b) {
    const MeanOf diameter = mean_of(diameters[b]);
    limits.add(count == 2 ? fmt::format("diameter {}", b + 1) : "diameter",
               diameter.mean - balls.diameter_mm,
               // A cap determines the diameter less well than a whole ball.
               diameter.sigma,
               4.0,
               fmt::format("{:.4f} mm, {:g} mm are known", diameter.mean, balls.diameter_mm));
  }
  if (!rig.turntable || capture.views.size() < 2) return limits.result();
  double square = 0.0;
  for (const std::vector<Eigen::Vector3d>& places : centers) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& place : places)
      mean += place / static_cast<double>(places.size());
    for (const Eigen::Vector3d& place : places)
      square += (place - mean).squaredNorm() / static_cast<double>(places.size() * count);
  }
  limits.add("place of the balls",
             std::sqrt(square),
             0.0,
             1.0,
             fmt::format("differs by {:.4f} mm rms between the views", std::sqrt(square)));
  return limits.result();
}

}  // namespace frangia
