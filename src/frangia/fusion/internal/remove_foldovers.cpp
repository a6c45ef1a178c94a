#include "frangia/fusion/internal/remove_foldovers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/fusion/internal/normal_agreement.h"
#include "frangia/geometry/connectivity.h"

namespace frangia {
namespace {

using Vertex = std::uint32_t;

/// Returns the triangles whose normal agreement is below `least`.
std::vector<std::uint32_t> find_foldovers(const Mesh& mesh, float least) {
  constexpr std::size_t kChunk = 65536;
  std::vector<std::vector<std::uint32_t>> parts((mesh.triangles.size() + kChunk - 1) / kChunk);
  parallel_chunks(mesh.triangles.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      if (normal_agreement(mesh, mesh.triangles[t], 0.0F) < least)
        parts[begin / kChunk].push_back(static_cast<std::uint32_t>(t));
    }
  });
  std::vector<std::uint32_t> foldovers;
  for (const auto& part : parts)
    foldovers.insert(foldovers.end(), part.begin(), part.end());
  return foldovers;
}

/// Returns how far the triangles around a vertex are folded: the sum of what their normal agreement
/// lacks to kUpright.
float foldover_measure(const Mesh& mesh, const OneRings& one_rings, Vertex v) {
  constexpr float kUpright = 0.4F;  // cosine, a little above that of a foldover
  float sum = 0.0F;
  for (const std::uint32_t t : one_rings.of(v))
    sum += std::max(0.0F, kUpright - normal_agreement(mesh, mesh.triangles[t], 0.0F));
  return sum;
}

/// Moves a vertex along the surface to the mean of its neighbours if that reduces the foldovers.
void relax_tangentially(Mesh& mesh, const OneRings& one_rings, Vertex v) {
  const std::vector<Vertex> around = one_ring_neighbors(mesh, one_rings, v);
  for (std::size_t i = 0; i < around.size(); i += 2) {
    if (i + 1 == around.size() || around[i] != around[i + 1]) return;  // at the boundary
  }
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  for (const Vertex other : around)
    middle += mesh.vertices_mm[other] / static_cast<float>(around.size());
  const Eigen::Vector3f before = mesh.vertices_mm[v];
  const Eigen::Vector3f& normal = mesh.normals[v];
  const float folded = foldover_measure(mesh, one_rings, v);
  const Eigen::Vector3f step = middle - before;
  mesh.vertices_mm[v] += step - normal * normal.dot(step);
  if (foldover_measure(mesh, one_rings, v) >= folded) mesh.vertices_mm[v] = before;
}

/// Whether one of the triangle's edges is at the boundary.
bool is_at_boundary(const Mesh& mesh, const OneRings& one_rings, std::uint32_t triangle) {
  const Mesh::Triangle& corners = mesh.triangles[triangle];
  for (std::size_t i = 0; i < 3; ++i) {
    const auto one_ring = one_rings.of(corners[i]);
    const auto shared = std::count_if(one_ring.begin(), one_ring.end(), [&](std::uint32_t t) {
      return has_vertex(mesh.triangles[t], corners[(i + 1) % 3]);
    });
    if (shared < 2) return true;
  }
  return false;
}

void erase_triangles(Mesh& mesh, const std::vector<std::uint32_t>& ascending) {
  std::size_t kept = 0;
  for (std::size_t t = 0, next = 0; t < mesh.triangles.size(); ++t) {
    if (next < ascending.size() && ascending[next] == t) {
      ++next;
    } else {
      mesh.triangles[kept++] = mesh.triangles[t];
    }
  }
  mesh.triangles.resize(kept);
}

enum class FoldoverAction : std::uint8_t { Relax, Remove };

/// Relaxes or removes the triangles whose normal agreement is below `least`; returns false without
/// any.
bool treat_foldovers(Mesh& mesh,
                     std::span<const std::uint8_t> sharp,
                     float least,
                     FoldoverAction action) {
  const std::vector<std::uint32_t> foldovers = find_foldovers(mesh, least);
  if (foldovers.empty()) return false;
  std::vector<Vertex> corners;
  for (const std::uint32_t t : foldovers)
    corners.insert(corners.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  const OneRings one_rings(mesh, corners);
  std::vector<std::uint32_t> removed;
  for (const std::uint32_t t : foldovers) {
    if (action == FoldoverAction::Remove || is_at_boundary(mesh, one_rings, t)) {
      removed.push_back(t);
      continue;
    }
    for (const Vertex v : mesh.triangles[t]) {
      if (v >= sharp.size() || sharp[v] == 0) relax_tangentially(mesh, one_rings, v);
    }
  }
  erase_triangles(mesh, removed);
  return true;
}

}  // namespace

void remove_foldovers(Mesh& mesh,
                      std::span<const std::uint8_t> sharp,
                      const CleanupParameters& parameters) {
  constexpr int kMostPasses = 4;
  const auto foldover_cosine = static_cast<float>(std::cos(parameters.foldover_rad));
  for (int pass = 0; pass < kMostPasses; ++pass) {
    if (!treat_foldovers(mesh, sharp, foldover_cosine, FoldoverAction::Relax)) break;
  }
  treat_foldovers(mesh, sharp, 0.0F, FoldoverAction::Remove);
}

}  // namespace frangia
