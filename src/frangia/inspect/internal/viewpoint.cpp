#include "frangia/inspect/internal/viewpoint.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace frangia {
namespace {

using Eigen::Vector3d;

constexpr double kHalfField = 0.21;  ///< tangent of half the field of view along the shorter side
constexpr double kFill = 0.86;       ///< share of the picture that the part fills

}  // namespace

Viewpoint::Ray Viewpoint::ray(double x, double y) const {
  const Vector3d offset = axes.transpose() * Vector3d(x * scale, y * scale, 0.0);
  const Vector3d eye = target + distance * axes.row(2).transpose();
  if (!perspective) return {eye + offset, -axes.row(2).transpose()};
  return {eye, (target + offset - eye).normalized()};
}

Viewpoint fit_viewpoint(const Mesh& mesh, const RenderOptions& options) {
  Viewpoint viewpoint;
  viewpoint.perspective = options.perspective;
  const double ca = std::cos(options.azimuth_rad);
  const double sa = std::sin(options.azimuth_rad);
  const double ce = std::cos(options.elevation_rad);
  const double se = std::sin(options.elevation_rad);
  viewpoint.axes << -sa, ca, 0.0, -se * ca, -se * sa, ce, ce * ca, ce * sa, se;
  const auto& shown = options.fit_to_mm.empty() ? mesh.vertices_mm : options.fit_to_mm;
  Eigen::AlignedBox3d box;
  for (const auto& vertex : shown)
    box.extend(viewpoint.axes * vertex.cast<double>());
  viewpoint.target = viewpoint.axes.transpose() * box.center();

  const double shorter = std::min(options.width_px, options.height_px);
  const Eigen::Vector2d half(options.width_px / shorter * kFill,
                             options.height_px / shorter * kFill);
  const Vector3d size = 0.5 * box.sizes();
  if (!options.perspective) {
    viewpoint.scale = std::max(size.x() / half.x(), size.y() / half.y());
    viewpoint.distance = 2.0 * box.sizes().norm() + 1.0;
    return viewpoint;
  }
  for (const auto& vertex : shown) {
    const Vector3d p = viewpoint.axes * vertex.cast<double>() - box.center();
    const double needed =
        std::max(std::abs(p.x()) / half.x(), std::abs(p.y()) / half.y()) / kHalfField + p.z();
    viewpoint.distance = std::max(viewpoint.distance, needed);
  }
  viewpoint.scale = kHalfField * viewpoint.distance;
  return viewpoint;
}

}  // namespace frangia
