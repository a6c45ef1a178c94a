#include "frangia/mesh/internal/transfer_vertex_data.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kElementsPerChunk = 1024;

/// The barycentric coordinates of a point in a triangle.
Eigen::Vector3f barycentric_of(const Mesh& mesh, const Mesh::Triangle& t, const Vector3d& point) {
  const Vector3d a = mesh.vertices_mm[t[0]].cast<double>() - point;
  const Vector3d b = mesh.vertices_mm[t[1]].cast<double>() - point;
  const Vector3d c = mesh.vertices_mm[t[2]].cast<double>() - point;
  const Vector3d areas(b.cross(c).norm(), c.cross(a).norm(), a.cross(b).norm());
  return (areas / std::max(areas.sum(), 1e-300)).cast<float>();
}

void transfer_at(Mesh& mesh, std::size_t vertex, const Mesh& from, const NearestPoint& near) {
  const Mesh::Triangle& t = from.triangles[near.triangle];
  if (!from.sigma_mm.empty()) {
    const Eigen::Vector3f barycentric = barycentric_of(from, t, near.point_mm);
    const auto mean = [&](const std::vector<float>& values) {
      return barycentric.dot(Eigen::Vector3f(values[t[0]], values[t[1]], values[t[2]]));
    };
    if (from.sigma_systematic_mm.empty()) {
      mesh.sigma_mm[vertex] = mean(from.sigma_mm);
    } else {
      mesh.sigma_noise_mm[vertex] = mean(from.sigma_noise_mm);
      mesh.sigma_systematic_mm[vertex] = mean(from.sigma_systematic_mm);
      mesh.sigma_mm[vertex] =
          combined_sigma(mesh.sigma_noise_mm[vertex], mesh.sigma_systematic_mm[vertex]);
    }
  }
  if (!from.colors.empty()) {
    const Eigen::Vector3f barycentric = barycentric_of(from, t, near.point_mm);
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3f values(
          from.colors[t[0]].at(i), from.colors[t[1]].at(i), from.colors[t[2]].at(i));
      mesh.colors[vertex].at(i) =
          static_cast<std::uint8_t>(std::lround(std::clamp(barycentric.dot(values), 0.0F, 255.0F)));
    }
  }
  if (!from.views.empty()) {
    mesh.views[vertex] = std::min({from.views[t[0]], from.views[t[1]], from.views[t[2]]});
  }
  if (!from.vertex_marks.empty()) {
    const Eigen::Vector3f barycentric = barycentric_of(from, t, near.point_mm);
    Eigen::Index nearest = 0;
    barycentric.maxCoeff(&nearest);
    mesh.vertex_marks[vertex] = from.vertex_marks[t.at(static_cast<std::size_t>(nearest))];
  }
}

}  // namespace

void transfer_vertex_data(Mesh& mesh, const RayScene& scene, const Run& run) {
  const Mesh& from = scene.mesh();
  const std::size_t count = mesh.vertices_mm.size();
  if (!from.sigma_mm.empty()) mesh.sigma_mm.assign(count, 0.0F);
  if (!from.sigma_systematic_mm.empty()) {
    mesh.sigma_noise_mm.assign(count, 0.0F);
    mesh.sigma_systematic_mm.assign(count, 0.0F);
  }
  if (!from.views.empty()) mesh.views.assign(count, 0);
  if (!from.colors.empty()) mesh.colors.assign(count, kUnknownColor);
  if (!from.vertex_marks.empty()) mesh.vertex_marks.assign(count, Mark::Measured);
  parallel_chunks(count, kElementsPerChunk, [&](std::size_t begin, std::size_t end) {
    if (run.stop.stop_requested()) return;  // run.check() below throws
    for (std::size_t v = begin; v < end; ++v) {
      const auto near = scene.nearest(mesh.vertices_mm[v].cast<double>());
      if (near) transfer_at(mesh, v, from, *near);
    }
  });
  run.check();
  if (!from.triangle_marks.empty()) {
    mesh.triangle_marks.assign(mesh.triangles.size(), Mark::Measured);
    parallel_chunks(
        mesh.triangles.size(), kElementsPerChunk, [&](std::size_t begin, std::size_t end) {
          if (run.stop.stop_requested()) return;
          for (std::size_t t = begin; t < end; ++t) {
            const auto& [a, b, c] = mesh.triangles[t];
            const Eigen::Vector3f centroid =
                (mesh.vertices_mm[a] + mesh.vertices_mm[b] + mesh.vertices_mm[c]) / 3.0F;
            const auto near = scene.nearest(centroid.cast<double>());
            if (near) mesh.triangle_marks[t] = from.triangle_marks[near->triangle];
          }
        });
    run.check();
  }
  if (!from.normals.empty()) mesh.normals = vertex_normals(mesh);
}

}  // namespace frangia
