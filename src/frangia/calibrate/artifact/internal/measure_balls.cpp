#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/calibrate/artifact/internal/measure_sites.h"
#include "frangia/calibrate/internal/artifact_sites.h"

namespace frangia {
namespace {

/// Sites on balls, along the longer side of the image.
constexpr int kBallSites = 128;

/// Centers in the order of those of an earlier view.
void order_balls(const std::vector<Eigen::Vector3d>& before,
                 const Eigen::Isometry3d& to_zero,
                 std::vector<FoundBall>& balls) {
  if (balls.size() < 2 || before.empty()) return;
  const auto distance = [&](std::size_t a, std::size_t b) {
    return (to_zero * balls[a].sphere.center_mm - before[0]).squaredNorm() +
           (to_zero * balls[b].sphere.center_mm - before[1]).squaredNorm();
  };
  if (distance(1, 0) < distance(0, 1)) std::swap(balls[0], balls[1]);
}

/// Whether a site is seen from the front, where the phase of a ball is well measured.
bool is_frontal(const Eigen::Vector3d& point, const Eigen::Vector3d& center, const Rig& rig) {
  constexpr double kLeastCosine = 0.55;
  const Eigen::Vector3d normal = (point - center).normalized();
  return -normal.dot(point.normalized()) > kLeastCosine &&
         normal.dot((rig.projector.position_mm - point).normalized()) > kLeastCosine;
}

}  // namespace

ArtifactCapture measure_balls(const Scan& scan,
                              const Rig& rig,
                              const CalibrateArtifactsOptions& options,
                              const Run& run) {
  const auto& balls = std::get<Balls>(*scan.artifact);
  constexpr double kFarOff = 12.0;  // diameters, where the rig has no turntable
  const std::size_t count = balls.spacing_mm ? 2 : 1;
  // Within a tenth of the radius the surface of a ball is quadratic to 1e-5 of it.
  const double apparent_px =
      0.5 * balls.diameter_mm * rig.reference().model.focal_px.x() /
      (rig.turntable ? rig.turntable->point_mm.z() : kFarOff * balls.diameter_mm);
  const int step = std::max(2,
                            std::min(static_cast<int>(std::lround(0.1 * apparent_px)),
                                     site_step(rig.reference().model, kBallSites)));
  const auto measured = measure_sites(scan, rig, site_options(step), run);
  ArtifactCapture capture{balls, {}, {}};
  std::vector<Eigen::Vector3d> before;
  std::vector<Eigen::Vector3d> sums(count, Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const std::vector<Eigen::Vector3d> points = site_points(measured[i], rig);
    std::vector<FoundBall> found =
        find_balls(points, 0.5 * balls.diameter_mm, count, options.balls);
    ArtifactView view{scan.views[i].folder.generic_string(), scan.views[i].angle_rad, {}, {}, {}};
    if (found.size() < count) {
      capture.left_out.push_back(view.name);
      continue;
    }
    const Eigen::Isometry3d to_zero = table_turn(rig, -view.angle_rad);
    order_balls(before, to_zero, found);
    for (std::size_t b = 0; b < count; ++b) {
      const Eigen::Vector3d& center = found[b].sphere.center_mm;
      sums[b] += to_zero * center;
      for (const std::size_t k : found[b].points) {
        if (!is_frontal(points[k], center, rig)) continue;
        view.sites.push_back(measured[i][k]);
        view.surface.push_back(static_cast<int>(b));
      }
    }
    capture.views.push_back(std::move(view));
    before.clear();
    for (const Eigen::Vector3d& sum : sums)
      before.emplace_back(sum / static_cast<double>(capture.views.size()));
  }
  if (capture.views.empty()) {
    fail_artifact(scan,
                  fmt::format("no view shows {} of {:g} mm; check diameter_mm, and that camera and "
                              "projector see them whole",
                              count == 2 ? "both balls" : "a ball",
                              balls.diameter_mm));
  }
  for (const Eigen::Vector3d& center : before)
    capture.surfaces.emplace_back(center.x(), center.y(), center.z(), 0.0);
  return capture;
}

}  // namespace frangia
