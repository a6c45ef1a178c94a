#include "frangia/fusion/internal/find_feature_vertices.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "frangia/core/parallel.h"

namespace frangia {
namespace {

/// The mesh around a vertex.
struct Surroundings {
  const Mesh& mesh;
  const OneRings& one_rings;
  const std::vector<std::uint8_t>& near_edge;  ///< not 0 near an edge
  const EdgeLimits& limits;

  [[nodiscard]] Faces faces_at(std::uint32_t vertex) const {
    constexpr int kRings = 16;  // more than the reach contains
    auto around = vertices_within(mesh, one_rings, vertex, kRings, limits.face_reach_mm);
    const auto uncertain = [&](std::uint32_t v) { return near_edge[v] != 0; };
    around.erase(std::remove_if(around.begin(), around.end(), uncertain), around.end());
    return find_faces(mesh, around, mesh.vertices_mm[vertex], limits);
  }

  /// Whether all vertices around one lie on the faces or near their edges.
  [[nodiscard]] bool is_made_of(const Faces& faces, std::uint32_t vertex) const {
    const auto around = vertices_within(mesh, one_rings, vertex, 2, limits.check_reach_mm);
    return std::all_of(around.begin(), around.end(), [&](std::uint32_t v) {
      const Eigen::Vector3f& point = mesh.vertices_mm[v];
      float off = faces.planes[0].absDistance(point);
      bool near_an_edge = false;
      for (std::size_t a = 1; a < faces.count; ++a) {
        off = std::min(off, faces.planes[a].absDistance(point));
        for (std::size_t b = 0; b < a; ++b) {
          const Eigen::Vector3f edge = intersect_planes(faces.planes[a], faces.planes[b], point);
          near_an_edge = near_an_edge || (edge - point).norm() < limits.edge_zone_mm;
        }
      }
      return near_an_edge || off < limits.on_face_mm + limits.on_face_sigmas * mesh.sigma_mm[v];
    });
  }
};

/// A vertex next to a chamfer: it lies on a face and keeps its measured position.
FeatureVertex face_vertex(const Surroundings& around, std::uint32_t vertex) {
  FeatureVertex feature;
  feature.target = around.mesh.vertices_mm[vertex];
  feature.faces = around.faces_at(vertex);
  for (std::size_t i = 0; i < feature.faces.count; ++i) {
    if (feature.faces.planes[i].normal().dot(around.mesh.normals[vertex]) <
        around.limits.face_vertex_cosine)
      continue;
    std::swap(feature.faces.planes[0], feature.faces.planes[i]);
    feature.kind = FeatureVertex::Kind::Face;
    break;
  }
  return feature;
}

/// A vertex on a chamfer: it moves to a corner, an edge or a face of the object.
FeatureVertex chamfer_vertex(const Surroundings& around, std::uint32_t vertex) {
  const Eigen::Vector3f& here = around.mesh.vertices_mm[vertex];
  FeatureVertex feature;
  feature.faces = around.faces_at(vertex);
  const auto& planes = feature.faces.planes;
  if (feature.faces.count < 2 || !around.is_made_of(feature.faces, vertex)) return feature;
  const auto is_within = [&](float reach_mm) { return (feature.target - here).norm() < reach_mm; };
  if (feature.faces.count == 3) {
    feature.target = intersect_planes(planes, here);
    if (is_within(around.limits.to_corner_mm)) {
      feature.kind = FeatureVertex::Kind::Corner;
      return feature;
    }
  }
  if (form_edge(planes[0].normal(), planes[1].normal(), around.limits)) {
    feature.target = intersect_planes(planes[0], planes[1], here);
    if (is_within(around.limits.to_edge_mm)) {
      feature.kind = FeatureVertex::Kind::Edge;
      return feature;
    }
  }
  feature.target = planes[0].projection(here);
  if (is_within(around.limits.to_face_mm)) feature.kind = FeatureVertex::Kind::Face;
  return feature;
}

}  // namespace

std::vector<std::uint32_t> chamfer_vertices(const Mesh& mesh, const EdgeLimits& limits) {
  constexpr std::size_t kChunk = 16384;
  std::vector<std::vector<std::uint32_t>> parts((mesh.triangles.size() + kChunk - 1) / kChunk);
  parallel_chunks(mesh.triangles.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& t = mesh.triangles[i];
      const Eigen::Vector3f& origin = mesh.vertices_mm[t[0]];
      const Eigen::Vector3f cross =
          (mesh.vertices_mm[t[1]] - origin).cross(mesh.vertices_mm[t[2]] - origin);
      const float least = limits.chamfer_cosine * cross.norm();
      for (const std::uint32_t v : t) {
        if (cross.dot(mesh.normals[v]) < least) parts[begin / kChunk].push_back(v);
      }
    }
  });
  std::vector<std::uint32_t> all;
  for (const auto& part : parts)
    all.insert(all.end(), part.begin(), part.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

float FeatureVertex::agreement(const Eigen::Vector3f& normal) const {
  float best = face().normal().dot(normal);
  if (kind != Kind::Face) best = std::max(best, faces.planes[1].normal().dot(normal));
  if (kind == Kind::Corner) best = std::max(best, faces.planes[2].normal().dot(normal));
  return best;
}

FeatureVertices find_feature_vertices(const Mesh& mesh,
                                      const OneRings& one_rings,
                                      std::span<const std::uint32_t> chamfered,
                                      const EdgeLimits& limits) {
  FeatureVertices all;
  all.index_of.assign(mesh.vertices_mm.size(), FeatureVertices::kNone);
  std::vector<std::uint8_t> near_edge(mesh.vertices_mm.size(), 0);
  for (const std::uint32_t v : chamfered) {
    for (const std::uint32_t other : vertices_within(mesh, one_rings, v, 1, limits.face_reach_mm)) {
      if (all.index_of[other] != FeatureVertices::kNone) continue;
      all.index_of[other] = static_cast<std::uint32_t>(all.vertices.size());
      all.vertices.push_back(other);
      near_edge[other] = 1;
    }
  }
  all.features.resize(all.vertices.size());
  const Surroundings around{mesh, one_rings, near_edge, limits};
  parallel_chunks(all.vertices.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t v = all.vertices[i];
      const bool is_chamfered = std::binary_search(chamfered.begin(), chamfered.end(), v);
      all.features[i] = is_chamfered ? chamfer_vertex(around, v) : face_vertex(around, v);
    }
  });
  return all;
}

namespace {

/// Weighted moments of the vertices of one face.
struct FaceMoments {
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();  ///< relative to the given point
  Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
  float noise2 = 0.0F;  ///< mean variance of the vertices
  Eigen::Vector3f outward = Eigen::Vector3f::Zero();
};

/// Vertices near the point have the largest weight, since a face may be curved.
FaceMoments moments_of(const Mesh& mesh,
                       const std::vector<std::uint32_t>& members,
                       const Eigen::Vector3f& near,
                       float reach_mm) {
  FaceMoments fit;
  float sum = 0.0F;
  const auto weight = [&](std::uint32_t v) {
    const float ratio2 = (mesh.vertices_mm[v] - near).squaredNorm() / (reach_mm * reach_mm);
    constexpr float kLeast = 0.01F;  // keeps the sum positive
    const float inner = std::max(0.0F, 1.0F - ratio2);
    return std::max(kLeast, inner * inner);
  };
  for (const std::uint32_t v : members) {
    sum += weight(v);
    fit.mean += weight(v) * (mesh.vertices_mm[v] - near);
    fit.noise2 += weight(v) * mesh.sigma_mm[v] * mesh.sigma_mm[v];
    fit.outward += mesh.normals[v];
  }
  fit.mean /= sum;
  fit.noise2 /= sum;
  for (const std::uint32_t v : members) {
    const Eigen::Vector3f off = mesh.vertices_mm[v] - near - fit.mean;
    fit.spread += weight(v) / sum * off * off.transpose();
  }
  return fit;
}

/// Returns the plane of a face; nothing when its vertices are not flat, or lie on a line.
std::optional<Faces::Plane> plane_through(const Mesh& mesh,
                                          const std::vector<std::uint32_t>& members,
                                          const Eigen::Vector3f& near,
                                          const EdgeLimits& limits) {
  const float voxel_mm = limits.voxel_mm;
  const FaceMoments fit = moments_of(mesh, members, near, limits.face_reach_mm);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(fit.spread);
  const Eigen::Vector3f squares = solver.eigenvalues() / (voxel_mm * voxel_mm);
  const float flat = limits.flat_voxels * limits.flat_voxels +
                     limits.flat_sigmas * limits.flat_sigmas * fit.noise2 / (voxel_mm * voxel_mm);
  if (!(squares[0] <= flat && squares[1] >= limits.face_width_voxels * limits.face_width_voxels))
    return std::nullopt;
  const Eigen::Vector3f normal = solver.eigenvectors().col(0).normalized();
  return Faces::Plane(normal.dot(fit.outward) < 0.0F ? Eigen::Vector3f(-normal) : normal,
                      near + fit.mean);
}

/// Returns the largest set of vertices in the plane of one of them and with similar normals.
std::vector<std::uint32_t> largest_face(const Mesh& mesh,
                                        const std::vector<std::uint32_t>& vertices,
                                        const EdgeLimits& limits) {
  std::vector<std::uint32_t> best;
  for (const std::uint32_t seed : vertices) {
    const Eigen::Vector3f& normal = mesh.normals[seed];
    std::vector<std::uint32_t> members;
    for (const std::uint32_t v : vertices) {
      const float off = std::abs(normal.dot(mesh.vertices_mm[v] - mesh.vertices_mm[seed]));
      if (mesh.normals[v].dot(normal) > limits.face_normal_cosine && off < limits.face_offset_mm)
        members.push_back(v);
    }
    if (members.size() > best.size()) best = std::move(members);
  }
  return best;
}

}  // namespace

bool form_edge(const Eigen::Vector3f& one, const Eigen::Vector3f& other, const EdgeLimits& limits) {
  const float cosine = one.dot(other);
  return cosine < limits.min_edge_cosine && cosine > limits.max_edge_cosine;
}

Eigen::Vector3f intersect_planes(const Faces::Plane& one,
                                 const Faces::Plane& other,
                                 const Eigen::Vector3f& from) {
  const float cosine = one.normal().dot(other.normal());
  const float first = one.signedDistance(from);
  const float second = other.signedDistance(from);
  const Eigen::Vector3f step =
      (first - cosine * second) * one.normal() + (second - cosine * first) * other.normal();
  return from - step / (1.0F - cosine * cosine);
}

Eigen::Vector3f intersect_planes(const std::array<Faces::Plane, 3>& planes,
                                 const Eigen::Vector3f& from) {
  Eigen::Matrix3f rows;
  Eigen::Vector3f away;
  for (int i = 0; i < 3; ++i) {
    const Faces::Plane& plane = planes[static_cast<std::size_t>(i)];
    rows.row(i) = plane.normal().transpose();
    away[i] = plane.signedDistance(from);
  }
  return from - rows.inverse() * away;
}

Faces find_faces(const Mesh& mesh,
                 std::span<const std::uint32_t> vertices,
                 const Eigen::Vector3f& near,
                 const EdgeLimits& limits) {
  std::vector<std::uint32_t> left(vertices.begin(), vertices.end());
  Faces faces;
  while (faces.count < faces.planes.size() && left.size() >= limits.min_face_vertices) {
    const std::vector<std::uint32_t> members = largest_face(mesh, left, limits);
    if (members.size() < limits.min_face_vertices) break;
    const auto plane = plane_through(mesh, members, near, limits);
    const Eigen::Vector3f normal = plane ? plane->normal() : mesh.normals[members[0]];
    if (plane) faces.planes[faces.count++] = *plane;
    const auto same = [&](std::uint32_t v) { return !form_edge(mesh.normals[v], normal, limits); };
    left.erase(std::remove_if(left.begin(), left.end(), same), left.end());
  }
  const auto nearer = [&](const Faces::Plane& a, const Faces::Plane& b) {
    return a.absDistance(near) < b.absDistance(near);
  };
  std::sort(faces.planes.begin(),
            faces.planes.begin() + static_cast<std::ptrdiff_t>(faces.count),
            nearer);
  return faces;
}

}  // namespace frangia
