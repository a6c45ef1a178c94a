#include "frangia/mesh/select_by_vertices.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/mesh/half_edges.h"
#include "frangia/mesh/vertex_data.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

template <typename Holds>
Selection select_if_any(const Mesh& mesh, const Holds& holds) {
  Selection selection(mesh.triangles.size());
  for (std::size_t i = 0; i < selection.size(); ++i) {
    const Mesh::Triangle& t = mesh.triangles[i];
    selection[i] = std::any_of(t.begin(), t.end(), holds) ? 1 : 0;
  }
  return selection;
}

/// Twice the mean curvature normal times the area that belongs to a vertex, and that area.
struct Bend {
  Vector3d normal = Vector3d::Zero();
  Vector3d outward = Vector3d::Zero();
  double area = 0.0;
};

double cotangent(const Vector3d& u, const Vector3d& v) {
  return u.dot(v) / std::max(u.cross(v).norm(), 1e-300);
}

void add_triangle(Bend& bend, const Vector3d& here, const Vector3d& next, const Vector3d& last) {
  const Vector3d a = next - here;
  const Vector3d b = last - here;
  const Vector3d cross = a.cross(b);
  if (!(cross.norm() > 0.0)) return;
  bend.normal +=
      0.5 * (cotangent(here - last, next - last) * a + cotangent(here - next, last - next) * b);
  bend.outward += cross;
  bend.area += cross.norm() / 6.0;
}

float curvature_of(const Bend& bend) {
  if (!(bend.area > 0.0)) return kMissing;
  const double size = bend.normal.norm() / (2.0 * bend.area);
  return static_cast<float>(bend.normal.dot(bend.outward) < 0.0 ? size : -size);
}

}  // namespace

Selection select_by_sigma(const Mesh& mesh, double above_mm) {
  require(!mesh.sigma_mm.empty(),
          "select by sigma: the mesh has no sigma_mm; a .ply of this program has");
  return select_if_any(
      mesh, [&](std::uint32_t v) { return !(static_cast<double>(mesh.sigma_mm[v]) <= above_mm); });
}

Selection select_by_views(const Mesh& mesh, int fewer_than) {
  require(!mesh.views.empty(),
          "select by views: the mesh has no counts of views; a .ply of this program has");
  return select_if_any(mesh, [&](std::uint32_t v) { return mesh.views[v] < fewer_than; });
}

Selection select_by_mark(const Mesh& mesh, Mark mark) {
  Selection selection(mesh.triangles.size());
  for (std::size_t i = 0; i < selection.size(); ++i)
    selection[i] = mark_of(mesh, i) == mark ? 1 : 0;
  return selection;
}

Selection select_by_curvature(const Mesh& mesh, double above_per_mm) {
  const std::vector<float> curvature = mean_curvature_per_mm(mesh);
  return select_if_any(mesh, [&](std::uint32_t v) {
    return static_cast<double>(std::abs(curvature[v])) > above_per_mm;
  });
}

std::vector<float> mean_curvature_per_mm(const Mesh& mesh) {
  constexpr std::size_t kChunk = 4096;
  const HalfEdges edges(mesh);
  std::vector<float> curvature(mesh.vertices_mm.size(), kMissing);
  parallel_chunks(curvature.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto vertex = static_cast<std::uint32_t>(i);
      Bend bend;
      bool inside = true;
      for (const std::uint32_t edge : edges.leaving(vertex)) {
        inside = inside && edges.has_twin(edge) && edges.has_twin(HalfEdges::before(edge));
        add_triangle(bend,
                     mesh.vertices_mm[vertex].cast<double>(),
                     mesh.vertices_mm[to_of(mesh, edge)].cast<double>(),
                     mesh.vertices_mm[across_of(mesh, edge)].cast<double>());
      }
      if (inside) curvature[i] = curvature_of(bend);
    }
  });
  return curvature;
}

}  // namespace frangia
