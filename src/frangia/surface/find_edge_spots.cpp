#include "frangia/surface/find_edge_spots.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/parallel.h"

namespace frangia {
namespace {

/// The mesh around the vertex that is looked at.
struct Surroundings {
  const Mesh& mesh;
  const Fans& fans;
  const std::vector<std::uint8_t>& beside;  ///< not 0 near an edge
  float voxel_mm;

  [[nodiscard]] Faces faces_at(std::uint32_t vertex) const {
    constexpr int kRings = 16;  // more than the reach holds
    auto around = vertices_around(mesh, fans, vertex, kRings, kFaceReach * voxel_mm);
    const auto doubtful = [&](std::uint32_t v) { return beside[v] != 0; };
    around.erase(std::remove_if(around.begin(), around.end(), doubtful), around.end());
    return find_faces(mesh, around, mesh.vertices_mm[vertex], voxel_mm);
  }

  /// Whether the surface around a vertex is the faces, but for what lies close to their edge.
  [[nodiscard]] bool is_made_of(const Faces& faces, std::uint32_t vertex) const {
    constexpr float kClose = 0.9F;  // voxels
    constexpr float kReach = 2.0F;
    constexpr float kOff = 0.08F;
    constexpr float kSigmas = 3.0F;
    const auto around = vertices_around(mesh, fans, vertex, 2, kReach * voxel_mm);
    return std::all_of(around.begin(), around.end(), [&](std::uint32_t v) {
      const Eigen::Vector3f& point = mesh.vertices_mm[v];
      float off = faces.planes[0].absDistance(point);
      bool close = false;
      for (std::size_t a = 1; a < faces.count; ++a) {
        off = std::min(off, faces.planes[a].absDistance(point));
        for (std::size_t b = 0; b < a; ++b) {
          const Eigen::Vector3f edge = meet(faces.planes[a], faces.planes[b], point);
          close = close || (edge - point).norm() < kClose * voxel_mm;
        }
      }
      return close || off < kOff * voxel_mm + kSigmas * mesh.sigma_mm[v];
    });
  }
};

/// A vertex whose triangles slope as they should is of a face, and stays where it was measured.
EdgeSpot smooth_spot(const Surroundings& around, std::uint32_t vertex) {
  constexpr float kAlike = 0.9F;
  EdgeSpot spot;
  spot.target = around.mesh.vertices_mm[vertex];
  spot.faces = around.faces_at(vertex);
  for (std::size_t i = 0; i < spot.faces.count; ++i) {
    if (spot.faces.planes[i].normal().dot(around.mesh.normals[vertex]) < kAlike) continue;
    std::swap(spot.faces.planes[0], spot.faces.planes[i]);
    spot.kind = EdgeSpot::Kind::Face;
    break;
  }
  return spot;
}

EdgeSpot rough_spot(const Surroundings& around, std::uint32_t vertex) {
  constexpr float kOnCorner = 0.85F;  // voxels
  constexpr float kOnEdge = 0.45F;
  constexpr float kOnFace = 0.45F;
  const Eigen::Vector3f& here = around.mesh.vertices_mm[vertex];
  EdgeSpot spot;
  spot.faces = around.faces_at(vertex);
  const auto& planes = spot.faces.planes;
  if (spot.faces.count < 2 || !around.is_made_of(spot.faces, vertex)) return spot;
  const auto is_near = [&](float voxels) {
    return (spot.target - here).norm() < voxels * around.voxel_mm;
  };
  if (spot.faces.count == 3) {
    spot.target = meet(planes, here);
    if (is_near(kOnCorner)) {
      spot.kind = EdgeSpot::Kind::Corner;
      return spot;
    }
  }
  if (make_edge(planes[0].normal(), planes[1].normal())) {
    spot.target = meet(planes[0], planes[1], here);
    if (is_near(kOnEdge)) {
      spot.kind = EdgeSpot::Kind::Edge;
      return spot;
    }
  }
  spot.target = planes[0].projection(here);
  if (is_near(kOnFace)) spot.kind = EdgeSpot::Kind::Face;
  return spot;
}

}  // namespace

std::vector<std::uint32_t> rough_vertices(const Mesh& mesh) {
  constexpr float kRough = 0.966F;  // cosine of 15 degrees
  constexpr std::size_t kChunk = 16384;
  std::vector<std::vector<std::uint32_t>> parts((mesh.triangles.size() + kChunk - 1) / kChunk);
  parallel_chunks(mesh.triangles.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& t = mesh.triangles[i];
      const Eigen::Vector3f& origin = mesh.vertices_mm[t[0]];
      const Eigen::Vector3f cross =
          (mesh.vertices_mm[t[1]] - origin).cross(mesh.vertices_mm[t[2]] - origin);
      const float least = kRough * cross.norm();
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

float EdgeSpot::agreement(const Eigen::Vector3f& normal) const {
  float best = face().normal().dot(normal);
  if (kind != Kind::Face) best = std::max(best, faces.planes[1].normal().dot(normal));
  if (kind == Kind::Corner) best = std::max(best, faces.planes[2].normal().dot(normal));
  return best;
}

EdgeSpots find_edge_spots(const Mesh& mesh,
                          const Fans& fans,
                          std::span<const std::uint32_t> rough,
                          float voxel_mm) {
  EdgeSpots all;
  all.places.assign(mesh.vertices_mm.size(), EdgeSpots::kNone);
  std::vector<std::uint8_t> beside(mesh.vertices_mm.size(), 0);
  for (const std::uint32_t v : rough) {
    for (const std::uint32_t other : vertices_around(mesh, fans, v, 1, kFaceReach * voxel_mm)) {
      if (all.places[other] != EdgeSpots::kNone) continue;
      all.places[other] = static_cast<std::uint32_t>(all.vertices.size());
      all.vertices.push_back(other);
      beside[other] = 1;
    }
  }
  all.spots.resize(all.vertices.size());
  const Surroundings around{mesh, fans, beside, voxel_mm};
  parallel_chunks(all.vertices.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t v = all.vertices[i];
      const bool is_rough = std::binary_search(rough.begin(), rough.end(), v);
      all.spots[i] = is_rough ? rough_spot(around, v) : smooth_spot(around, v);
    }
  });
  return all;
}

}  // namespace frangia
