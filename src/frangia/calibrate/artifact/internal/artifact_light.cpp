#include "frangia/calibrate/artifact/internal/artifact_light.h"

#include <array>
#include <cmath>
#include <variant>

#include "frangia/calibrate/internal/rig_model.h"

namespace frangia {
namespace {

LinearRay ray_at(const CameraModel& model, const Eigen::Vector2d& pixel) {
  const std::array<double, 9> values = intrinsics_block(model);
  LinearRay out;
  out.ray = model.ray(pixel);
  out.intrinsics = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(values.data());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double step = i == 0 || i == 2 || i == 3 ? 1e-2 : 1e-5;
    std::array<double, 9> up = values;
    std::array<double, 9> down = values;
    up.at(i) += step;
    down.at(i) -= step;
    out.by_intrinsics.col(static_cast<Eigen::Index>(i)) =
        (with_intrinsics(model, up).ray(pixel) - with_intrinsics(model, down).ray(pixel)) /
        (2.0 * step);
  }
  return out;
}

}  // namespace

TurnedSurface turned_surface(const ArtifactProblem& problem,
                             std::size_t capture,
                             const ArtifactView& view,
                             int surface,
                             const Eigen::Vector2d& pixel) {
  const ArtifactCapture& seen = problem.captures[capture];
  const auto* balls = std::get_if<Balls>(&seen.artifact);
  return {ray_at(problem.start.reference().model, pixel),
          {problem.start.turntable->point_mm, problem.start.turntable->axis},
          view.angle_rad,
          seen.surfaces[static_cast<std::size_t>(surface)],
          balls != nullptr,
          balls != nullptr ? 0.5 * balls->diameter_mm : 0.0};
}

Eigen::Vector2d light_weight(const LightSite& site, double noise) {
  Eigen::Vector2d weight = Eigen::Vector2d::Zero();
  for (int i = 0; i < 2; ++i)
    if (std::isfinite(site.light[i]) && site.sigma[i] > 0.0)
      weight[i] = 1.0 / (noise * site.sigma[i]);
  return weight;
}

ArtifactResiduals artifact_residuals(const ArtifactProblem& problem,
                                     const ArtifactParameters& parameters) {
  ArtifactResiduals out;
  const auto* angular = std::get_if<AngularModel>(&problem.start.projector.model);
  for (std::size_t c = 0; c < problem.captures.size(); ++c) {
    for (std::size_t v = 0; v < problem.captures[c].views.size(); ++v) {
      const ArtifactView& view = problem.captures[c].views[v];
      for (std::size_t i = 0; i < view.sites.size(); ++i) {
        const LightSite& site = view.sites[i];
        const Eigen::Vector2d weight = light_weight(site, 1.0);
        Eigen::Vector2d sigmas = Eigen::Vector2d::Zero();
        const LightResidual residual{
            turned_surface(problem, c, view, view.surface[i], site.camera_px),
            angular,
            site.light,
            weight};
        const bool hit =
            residual(parameters.camera.data(),
                     parameters.projector.data(),
                     parameters.pose.data(),
                     &parameters.pitch_scale,
                     parameters.wavefront.data(),
                     parameters.table.data(),
                     &parameters.angle_errors[c][v],
                     parameters.surfaces[c][static_cast<std::size_t>(view.surface[i])].data(),
                     sigmas.data());
        if (!hit) ++out.missed;
        for (int k = 0; hit && k < 2; ++k) {
          if (!(weight[k] > 0.0)) continue;
          out.light_sigmas.push_back(sigmas[k]);
          out.light.push_back(sigmas[k] / weight[k]);
        }
      }
    }
  }
  return out;
}

std::vector<Eigen::Vector3d> artifact_line_points(const ArtifactProblem& problem,
                                                  const ArtifactParameters& parameters) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t c = 0; c < problem.captures.size(); ++c) {
    for (std::size_t v = 0; v < problem.captures[c].views.size(); ++v) {
      const ArtifactView& view = problem.captures[c].views[v];
      for (const LinePixel& pixel : view.line) {
        Eigen::Vector3d point;
        const bool hit = turned_surface(problem, c, view, 0, pixel.camera_px)
                             .intersect(parameters.camera.data(),
                                        parameters.table.data(),
                                        &parameters.angle_errors[c][v],
                                        parameters.surfaces[c][0].data(),
                                        point);
        if (hit) points.push_back(point);
      }
    }
  }
  return points;
}

}  // namespace frangia
