#include "frangia/editor/internal/select_by_geometry.h"

#include <cmath>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

template <typename IsInside>
Selection select_if(const Mesh& mesh, const IsInside& is_inside) {
  constexpr std::size_t kChunk = 16'384;
  Selection selection(mesh.triangles.size());
  parallel_chunks(selection.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [a, b, c] = mesh.triangles[i];
      selection[i] = is_inside(mesh.vertices_mm[a].cast<double>(),
                               mesh.vertices_mm[b].cast<double>(),
                               mesh.vertices_mm[c].cast<double>())
                         ? 1
                         : 0;
    }
  });
  return selection;
}

}  // namespace

Selection select_by_plane(const Mesh& mesh, const Eigen::Hyperplane<double, 3>& plane) {
  return select_if(mesh, [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return plane.signedDistance((a + b + c) / 3.0) > 0.0;
  });
}

Selection select_by_box(const Mesh& mesh, const Eigen::AlignedBox3d& box_mm) {
  return select_if(mesh, [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return box_mm.contains(Vector3d((a + b + c) / 3.0));
  });
}

Selection select_by_ball(const Mesh& mesh, const Vector3d& center_mm, double radius_mm) {
  return select_if(mesh, [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return ((a + b + c) / 3.0 - center_mm).norm() <= radius_mm;
  });
}

Selection select_by_normal(const Mesh& mesh, const Vector3d& direction, double within_rad) {
  require(direction.norm() > 0.0, "the direction has no length; write one such as 0,0,1");
  const Vector3d unit = direction.normalized();
  const double min_cosine = std::cos(within_rad);
  return select_if(mesh, [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Vector3d cross = (b - a).cross(c - a);
    const double length = cross.norm();
    return length > 0.0 && cross.dot(unit) >= min_cosine * length;
  });
}

}  // namespace frangia
