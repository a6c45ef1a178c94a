#include "frangia/inspect/picture_positions.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "frangia/inspect/internal/viewpoint.h"

namespace frangia {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The position in halves of the shorter side from the centre: the inverse of `Viewpoint::ray`.
Vector2d projected(const Viewpoint& viewpoint, const Vector3d& point) {
  const Vector3d seen = viewpoint.axes * (point - viewpoint.target);
  const double nearer =
      viewpoint.perspective ? viewpoint.distance / (viewpoint.distance - seen.z()) : 1.0;
  return seen.head<2>() * nearer / viewpoint.scale;
}

}  // namespace

std::vector<std::optional<Vector2d>> picture_positions(const RayScene& mesh,
                                                       const RenderOptions& options,
                                                       const std::vector<PicturedPlace>& places) {
  constexpr double kLeastCosine = 0.1;
  constexpr double kNear = 0.01;  // of the size: a place need not lie on the measured surface
  const Viewpoint viewpoint = fit_viewpoint(mesh.mesh(), options);
  Eigen::AlignedBox3d box;
  for (const auto& vertex : mesh.mesh().vertices_mm)
    box.extend(vertex.cast<double>());
  const double near_mm = kNear * box.diagonal().norm();
  const double half = 0.5 * std::min(options.width_px, options.height_px);
  std::vector<std::optional<Vector2d>> positions;
  for (const PicturedPlace& place : places) {
    positions.emplace_back();
    const Vector2d at = projected(viewpoint, place.point_mm);
    const Vector2d pixel(0.5 * options.width_px + half * at.x(),
                         0.5 * options.height_px - half * at.y());
    if (!(pixel.minCoeff() >= 0.0) || pixel.x() > options.width_px || pixel.y() > options.height_px)
      continue;
    const Viewpoint::Ray ray = viewpoint.ray(at.x(), at.y());
    if (place.normal.dot(ray.direction) > -kLeastCosine) continue;
    const double along = (place.point_mm - ray.origin).dot(ray.direction);
    if (mesh.first_hit(ray.origin, ray.direction, along - near_mm)) continue;
    positions.back() = pixel;
  }
  return positions;
}

}  // namespace frangia
