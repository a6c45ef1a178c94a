#include "frangia/surface/mesh_quads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/core/pixel_allocator.h"
#include "frangia/surface/collapse_slivers.h"
#include "frangia/surface/find_quads.h"
#include "frangia/surface/flip_caps.h"
#include "frangia/surface/sharpen_edges.h"
#include "frangia/surface/unfold_mesh.h"

namespace frangia {
namespace {

constexpr float kSliver = 0.1F;  // voxels: shorter edges are not worth their triangles

/// How a quad reads when cut between corners `from` and `from + 2`.
struct Cut {
  std::array<Mesh::Triangle, 2> triangles;
  bool upright;   ///< neither triangle faces inward
  bool folded;    ///< one does, and is more than a sliver
  float away_mm;  ///< of the cut's middle from the surface at the crossing
  float length_mm;
};
using Cuts = std::vector<Cut, PixelAllocator<Cut>>;

/// The surface at a crossing: its plane, and which way out is along the grid's edge.
struct Surface {
  Eigen::Hyperplane<float, 3> plane;
  Eigen::Vector3f outward;
  float voxel_mm = 0.0F;
};

Surface surface_at(const Crossings& crossings, const Evidence& evidence, std::uint32_t crossing) {
  const Evidence::Face& face = evidence.main();
  const Eigen::Vector3f normal = face.normal.normalized();
  const int axis = std::abs(crossings.outward[crossing]) - 1;
  const float sign = crossings.outward[crossing] > 0 ? 1.0F : -1.0F;
  return {{normal, crossings.points_mm[crossing] - normal * face.distance_mm()},
          sign * Eigen::Vector3f::Unit(axis),
          static_cast<float>(crossings.voxel_mm)};
}

Cut cut_quad(const Mesh& mesh,
             const std::array<std::uint32_t, 4>& ring,
             std::size_t from,
             const Surface& surface) {
  const Eigen::Vector3f& one = mesh.vertices_mm[ring[from]];
  const Eigen::Vector3f& other = mesh.vertices_mm[ring[(from + 2) % 4]];
  Cut cut;
  cut.upright = true;
  cut.folded = false;
  cut.length_mm = (one - other).norm();
  cut.away_mm = surface.plane.absDistance(0.5F * (one + other));
  for (std::size_t half = 0; half < 2; ++half) {
    const std::size_t start = (from + 2 * half) % 4;
    Mesh::Triangle& triangle = cut.triangles[half];
    triangle = {ring[start], ring[(start + 1) % 4], ring[(start + 2) % 4]};
    const Eigen::Vector3f& origin = mesh.vertices_mm[triangle[0]];
    const Eigen::Vector3f cross =
        (mesh.vertices_mm[triangle[1]] - origin).cross(mesh.vertices_mm[triangle[2]] - origin);
    // Against the edge of the grid, which a triangle within the cells never is, or the plane.
    const float facing = std::max(cross.dot(surface.outward), cross.dot(surface.plane.normal()));
    cut.upright = cut.upright && facing > 0.0F;
    cut.folded = cut.folded || facing < -kSliver * surface.voxel_mm * surface.voxel_mm;
  }
  return cut;
}

/// The cut that folds no triangle over, then stays on the surface, then is short.
Cut best_cut(const Mesh& mesh, const std::array<std::uint32_t, 4>& ring, const Surface& surface) {
  const Cut one = cut_quad(mesh, ring, 0, surface);
  const Cut other = cut_quad(mesh, ring, 1, surface);
  constexpr float kAlike = 0.02F;  // of the cut's length
  if (one.folded != other.folded) return one.folded ? other : one;
  if (one.upright != other.upright) return one.upright ? one : other;
  if (std::abs(one.away_mm - other.away_mm) > kAlike * (one.length_mm + other.length_mm)) {
    return one.away_mm < other.away_mm ? one : other;
  }
  return one.length_mm <= other.length_mm ? one : other;
}

/// Cuts all quads but pinched ones, and tells which of them fold whatever the cut.
Cuts cut_quads(const Mesh& mesh,
               const Crossings& crossings,
               std::span<const Evidence> evidence,
               std::span<const Quad> quads) {
  Cuts cuts(quads.size());
  parallel_chunks(quads.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      auto ring = quads[i].ring;
      if (crossings.outward[quads[i].crossing] < 0) std::reverse(ring.begin(), ring.end());
      cuts[i] = best_cut(
          mesh, ring, surface_at(crossings, evidence[quads[i].crossing], quads[i].crossing));
    }
  });
  return cuts;
}

std::uint32_t add_vertex(Mesh& mesh, const Eigen::Vector3f& point, std::uint32_t like) {
  mesh.vertices_mm.push_back(point);
  mesh.normals.push_back(mesh.normals[like]);
  mesh.sigma_mm.push_back(mesh.sigma_mm[like]);
  mesh.views.push_back(mesh.views[like]);
  return static_cast<std::uint32_t>(mesh.vertices_mm.size() - 1);
}

/// Fans of triangles around the crossings of pinched quads, with the vertices on their faces.
void add_pinched(Mesh& mesh, const Crossings& crossings, std::span<const Quad> quads) {
  std::map<std::tuple<int, int, int, int>, std::uint32_t> on_face;
  for (const Quad& quad : quads) {
    if (quad.pinched == 0) continue;
    const Eigen::Vector3f& point = crossings.points_mm[quad.crossing];
    std::vector<std::uint32_t> ring;
    for (std::size_t side = 0; side < 4; ++side) {
      ring.push_back(quad.ring[side]);
      if ((quad.pinched >> side & 1U) == 0) continue;
      const Eigen::Vector3i low = face_low(quad, side);
      const std::tuple key{low.x(), low.y(), low.z(), face_axis(quad, side)};
      const auto found = on_face.find(key);
      if (found == on_face.end()) {
        const std::uint32_t vertex = add_vertex(mesh, point, quad.ring[side]);
        on_face.emplace(key, vertex);
        ring.push_back(vertex);
      } else {  // the second of the strand's two quads: halfway between their crossings
        mesh.vertices_mm[found->second] = 0.5F * (mesh.vertices_mm[found->second] + point);
        ring.push_back(found->second);
      }
    }
    if (crossings.outward[quad.crossing] < 0) std::reverse(ring.begin(), ring.end());
    const std::uint32_t centre = add_vertex(mesh, point, ring[0]);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      mesh.triangles.push_back({centre, ring[i], ring[(i + 1) % ring.size()]});
    }
  }
}

/// Takes slivers and caps away.
void smooth_out(Mesh& mesh, const std::vector<std::uint8_t>& sharp, float voxel_mm) {
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    const bool joined = collapse_slivers(mesh, sharp, 2.0F * kSliver * voxel_mm);
    const bool turned = flip_caps(mesh, kSliver * voxel_mm);
    if (!joined && !turned) break;
  }
}

}  // namespace

Mesh mesh_quads(PlacedVertices vertices,
                const Crossings& crossings,
                std::span<const Evidence> evidence) {
  Mesh& mesh = vertices.mesh;
  const Quads quads = find_quads(crossings, evidence);

  Cuts cuts = cut_quads(mesh, crossings, evidence, quads);

  constexpr int kRounds = 3;  // pulling one quad's vertices back may fold the next
  for (int round = 0; round < kRounds; ++round) {
    bool folded = false;
    for (std::size_t i = 0; i < quads.size(); ++i) {
      if (!cuts[i].folded && quads[i].pinched == 0) continue;
      folded = true;
      for (const std::uint32_t v : quads[i].ring)
        mesh.vertices_mm[v] = vertices.within_mm[v];
    }
    if (!folded) break;
    cuts = cut_quads(mesh, crossings, evidence, quads);
  }
  mesh.triangles.reserve(2 * quads.size());
  for (std::size_t i = 0; i < quads.size(); ++i) {
    if (quads[i].pinched != 0) continue;
    for (const auto& triangle : cuts[i].triangles)
      mesh.triangles.push_back(triangle);
  }
  add_pinched(mesh, crossings, quads);

  const auto voxel_mm = static_cast<float>(crossings.voxel_mm);
  smooth_out(mesh, vertices.sharp, voxel_mm);

  const std::vector<std::uint8_t> sharp = sharpen_edges(mesh, voxel_mm);

  smooth_out(mesh, sharp, voxel_mm);

  unfold_mesh(mesh, sharp);

  return std::move(vertices.mesh);
}

}  // namespace frangia
