#include "frangia/editor/edit_preview.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kTrianglesPerChunk = 4096;
// Rounding of coordinates in single precision, relative to the size of the mesh: 25 ulp.
constexpr double kRounding = 3e-6;

double size_of(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& vertex : mesh.vertices_mm)
    if (vertex.allFinite()) box.extend(vertex.cast<double>());
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

class Surface {
 public:
  explicit Surface(const Mesh& mesh) : scene_(mesh), rounding_mm_(kRounding * size_of(mesh)) {}

  /// Whether a triangle of another mesh lies on this surface and faces the same way.
  [[nodiscard]] bool contains(const Mesh& mesh, const Mesh::Triangle& triangle) const {
    double reach = rounding_mm_;
    Vector3d middle = Vector3d::Zero();
    for (const std::uint32_t vertex : triangle) {
      const double sigma = mesh.sigma_mm.empty() ? 0.0 : noise_mm_of(mesh)[vertex];
      if (std::isfinite(sigma)) reach = std::max(reach, sigma);
      middle += mesh.vertices_mm[vertex].cast<double>() / 3.0;
    }
    if (!middle.allFinite()) return true;
    const auto nearest = scene_.nearest(middle, reach);
    if (!nearest || normal_of(mesh, triangle).dot(normal_at(*nearest)) < 0.0) return false;
    return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t vertex) {
      return scene_.nearest(mesh.vertices_mm[vertex].cast<double>(), reach).has_value();
    });
  }

 private:
  static Vector3d normal_of(const Mesh& mesh, const Mesh::Triangle& triangle) {
    const Vector3d a = mesh.vertices_mm[triangle[0]].cast<double>();
    const Vector3d b = mesh.vertices_mm[triangle[1]].cast<double>();
    const Vector3d c = mesh.vertices_mm[triangle[2]].cast<double>();
    return (b - a).cross(c - a);
  }
  [[nodiscard]] Vector3d normal_at(const NearestPoint& nearest) const {
    return normal_of(scene_.mesh(), scene_.mesh().triangles[nearest.triangle]);
  }

  RayScene scene_;
  double rounding_mm_;
};

Selection differing_triangles(const Mesh& mesh, const Surface& surface, const Run& run) {
  Selection differs(mesh.triangles.size());
  parallel_chunks(differs.size(), kTrianglesPerChunk, [&](std::size_t begin, std::size_t end) {
    if (run.stop.stop_requested()) return;  // run.check() below throws
    for (std::size_t t = begin; t < end; ++t)
      differs[t] = surface.contains(mesh, mesh.triangles[t]) ? 0 : 1;
  });
  run.check();
  return differs;
}

}  // namespace

EditPreview edit_preview(const Mesh& before, const Mesh& after, const Run& run) {
  const Surface old_surface(before);
  run.check();
  const Surface new_surface(after);
  run.check();
  return {differing_triangles(before, new_surface, run),
          differing_triangles(after, old_surface, run)};
}

}  // namespace frangia
