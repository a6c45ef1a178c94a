#include "frangia/editor/internal/select_by_vertex_data.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

template <typename Predicate>
Selection select_if_any(const Mesh& mesh, const Predicate& predicate) {
  Selection selection(mesh.triangles.size());
  for (std::size_t i = 0; i < selection.size(); ++i) {
    const Mesh::Triangle& t = mesh.triangles[i];
    selection[i] = std::any_of(t.begin(), t.end(), predicate) ? 1 : 0;
  }
  return selection;
}

/// Sums over the triangles around a vertex.
struct CurvatureSum {
  Vector3d normal = Vector3d::Zero();   ///< twice the mean curvature normal times `area`
  Vector3d outward = Vector3d::Zero();  ///< area-weighted normal
  double area = 0.0;                    ///< a third of the area of the triangles
};

double cotangent(const Vector3d& u, const Vector3d& v) {
  return u.dot(v) / std::max(u.cross(v).norm(), 1e-300);
}

void add_triangle(CurvatureSum& sum,
                  const Vector3d& here,
                  const Vector3d& next,
                  const Vector3d& last) {
  const Vector3d a = next - here;
  const Vector3d b = last - here;
  const Vector3d cross = a.cross(b);
  if (!(cross.norm() > 0.0)) return;
  sum.normal +=
      0.5 * (cotangent(here - last, next - last) * a + cotangent(here - next, last - next) * b);
  sum.outward += cross;
  sum.area += cross.norm() / 6.0;
}

float curvature_of(const CurvatureSum& sum) {
  if (!(sum.area > 0.0)) return kMissing;
  const double size = sum.normal.norm() / (2.0 * sum.area);
  return static_cast<float>(sum.normal.dot(sum.outward) < 0.0 ? size : -size);
}

}  // namespace

Selection select_by_sigma(const Mesh& mesh, double above_mm) {
  require(!mesh.sigma_mm.empty(), "the mesh has no sigma_mm; read a .ply that frangia wrote");
  return select_if_any(
      mesh, [&](std::uint32_t v) { return !(static_cast<double>(mesh.sigma_mm[v]) <= above_mm); });
}

Selection select_by_views(const Mesh& mesh, int fewer_than) {
  require(!mesh.views.empty(), "the mesh has no view counts; read a .ply that frangia wrote");
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
      CurvatureSum sum;
      bool inside = true;
      for (const std::uint32_t edge : edges.outgoing(vertex)) {
        inside = inside && edges.has_twin(edge) && edges.has_twin(HalfEdges::previous(edge));
        add_triangle(sum,
                     mesh.vertices_mm[vertex].cast<double>(),
                     mesh.vertices_mm[target_vertex(mesh, edge)].cast<double>(),
                     mesh.vertices_mm[opposite_vertex(mesh, edge)].cast<double>());
      }
      if (inside) curvature[i] = curvature_of(sum);
    }
  });
  return curvature;
}

}  // namespace frangia
