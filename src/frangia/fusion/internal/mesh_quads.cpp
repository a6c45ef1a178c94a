#include "frangia/fusion/internal/mesh_quads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <tuple>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/fusion/internal/cell_loops.h"
#include "frangia/fusion/internal/hermite_accumulators.h"
#include "frangia/fusion/internal/remove_foldovers.h"
#include "frangia/fusion/internal/remove_slivers.h"
#include "frangia/fusion/internal/sharpen_edges.h"

namespace frangia {
namespace {

/// The quad around one crossing. Side i, between corners i and i + 1, crosses the face between two
/// cells.
struct Quad {
  std::array<std::uint32_t, 4> ring;  ///< counter-clockwise seen from the edge's upper end
  std::uint32_t crossing;
  Eigen::Vector3i voxel;
  std::uint8_t axis;
  std::uint8_t pinched;       ///< bit i: side i needs an additional vertex on its face
  std::uint8_t diagonal = 0;  ///< corner, 0 or 1, at which the diagonal starts
  bool folded = false;        ///< a triangle faces inward with either diagonal
};

/// Quads in the order of the blocks, in chunks of several blocks.
using Quads = std::vector<std::vector<Quad>>;

/// Offsets of the four cells around an edge along axis a, on axes a + 1 and a + 2,
/// counter-clockwise seen from the edge's upper end.
constexpr std::array<std::array<int, 2>, 4> kRing{{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};

Eigen::Vector3i cell_of(const Quad& quad, std::size_t corner) {
  Eigen::Vector3i cell = quad.voxel;
  cell[(quad.axis + 1) % 3] += kRing[corner % 4][0];
  cell[(quad.axis + 2) % 3] += kRing[corner % 4][1];
  return cell;
}

/// Returns the axis normal to the face between the cells of corners i and i + 1.
int face_axis(const Quad& quad, std::size_t side) {
  return (quad.axis + (side % 2 == 0 ? 1 : 2)) % 3;
}

/// Returns the lowest corner of that face.
Eigen::Vector3i face_low(const Quad& quad, std::size_t side) {
  return cell_of(quad, side).cwiseMax(cell_of(quad, side + 1));
}

/// Whether the quad's side needs an additional vertex on its face. Of the two strands of surface
/// through a pinched face, the one around the inside corner that is lower along the face's first
/// axis gets it.
bool is_pinched(const EdgeCrossings::Neighborhood& around,
                const Quad& quad,
                std::size_t side,
                bool outside_is_up) {
  const int across = face_axis(quad, side);
  const Eigen::Vector3i one = cell_of(quad, side);
  const Eigen::Vector3i other = cell_of(quad, side + 1);
  const auto pinched = [&](const Eigen::Vector3i& cell, const Eigen::Vector3i& neighbour) {
    const auto address = around.at(cell);
    const int face = 2 * across + (neighbour[across] > cell[across] ? 1 : 0);
    return (cell_loops()[address.block->inside[address.voxel]].pinched_faces >> face & 1) != 0;
  };
  if (!pinched(one, other) || !pinched(other, one)) return false;
  Eigen::Vector3i inside = quad.voxel;
  if (!outside_is_up) inside[quad.axis] += 1;
  const int first = (across + 1) % 3;
  return inside[first] == face_low(quad, side)[first];
}

void add_quads(std::vector<Quad>& quads,
               const EdgeCrossings& crossings,
               const HermiteAccumulators& hermite,
               std::size_t block) {
  const EdgeCrossings::Block& cells = *crossings.blocks[block];
  const EdgeCrossings::Neighborhood around = crossings.neighborhood(block);
  for (int i = 0; i < static_cast<int>(DistanceField::kVoxels); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (cells.axes[at] == 0) continue;
    Quad quad;
    quad.voxel =
        crossings.block_coords[block] * kBlockEdge + Eigen::Vector3i(i & 7, i >> 3 & 7, i >> 6);
    quad.crossing = cells.first_crossing(at);
    for (quad.axis = 0; quad.axis < 3; ++quad.axis) {
      if ((cells.axes[at] >> quad.axis & 1) == 0) continue;
      bool whole = hermite.is_supported(quad.crossing);
      unsigned pinched = 0;
      for (std::size_t corner = 0; whole && corner < 4; ++corner) {
        const auto cell = around.at(cell_of(quad, corner));
        whole = cell.block != nullptr && cell.block->inside[cell.voxel] != 0;
        if (!whole) break;
        const int edge = 4 * quad.axis - kRing[corner][0] - 2 * kRing[corner][1];
        const CellLoops& shape = cell_loops()[cell.block->inside[cell.voxel]];
        quad.ring[corner] = cell.block->first_vertex(cell.voxel) +
                            shape.loop_of_edge[static_cast<std::size_t>(edge)];
        pinched |= shape.pinched_faces;
      }
      if (whole) {
        quad.pinched = 0;
        for (std::size_t side = 0; pinched != 0 && side < 4; ++side) {
          if (is_pinched(around, quad, side, crossings.outward[quad.crossing] > 0))
            quad.pinched = static_cast<std::uint8_t>(quad.pinched | 1U << side);
        }
        quads.push_back(quad);
      }
      ++quad.crossing;
    }
  }
}

/// Returns the quads around all supported crossings whose four cells have surface.
Quads find_quads(const EdgeCrossings& crossings, const HermiteAccumulators& hermite) {
  constexpr std::size_t kChunk = 64;
  Quads quads((crossings.blocks.size() + kChunk - 1) / kChunk);
  parallel_chunks(crossings.blocks.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    std::vector<Quad>& part = quads[begin / kChunk];
    part.reserve(crossings.first_of(end) - crossings.first_of(begin));
    for (std::size_t block = begin; block < end; ++block)
      add_quads(part, crossings, hermite, block);
  });
  return quads;
}

/// The two triangles of a quad that is cut between corners `from` and `from + 2`.
struct Diagonal {
  bool unflipped = true;  ///< neither triangle faces inward
  bool folded = false;    ///< one faces inward and is larger than a sliver
  float away_mm = 0.0F;   ///< distance of the diagonal's middle from the plane at the crossing
  float length_mm = 0.0F;
};

struct QuadLimits {
  float sliver_mm2;          ///< twice the area below which an inward triangle is a sliver
  float diagonal_tolerance;  ///< see `CleanupParameters`
};

/// Corners of a quad, counter-clockwise from outside.
using Ring = std::array<std::uint32_t, 4>;

Ring ring_of(const Quad& quad, const EdgeCrossings& crossings) {
  Ring ring = quad.ring;
  if (crossings.outward[quad.crossing] < 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

/// Returns one of the two triangles next to the diagonal from a corner.
Mesh::Triangle half_of(const Ring& ring, std::size_t from, std::size_t half) {
  const std::size_t start = from + 2 * half;
  return {ring[start % 4], ring[(start + 1) % 4], ring[(start + 2) % 4]};
}

/// The surface at a crossing.
struct CrossingPlane {
  Eigen::Hyperplane<float, 3> plane;
  Eigen::Vector3f outward;  ///< direction of the grid edge, towards the outside
};

CrossingPlane plane_at(const EdgeCrossings& crossings,
                       const HermiteAccumulators& hermite,
                       std::uint32_t crossing) {
  const HermiteAccumulator::PlaneSum& face = hermite.dominant(crossing);
  const Eigen::Vector3f normal = face.normal.normalized();
  const int axis = std::abs(crossings.outward[crossing]) - 1;
  const float sign = crossings.outward[crossing] > 0 ? 1.0F : -1.0F;
  return {{normal, crossings.points_mm[crossing] - normal * face.distance_mm()},
          sign * Eigen::Vector3f::Unit(axis)};
}

Diagonal evaluate_diagonal(const Mesh& mesh,
                           const Ring& ring,
                           std::size_t from,
                           const CrossingPlane& surface,
                           float sliver_mm2) {
  const Eigen::Vector3f& one = mesh.vertices_mm[ring[from]];
  const Eigen::Vector3f& other = mesh.vertices_mm[ring[(from + 2) % 4]];
  Diagonal cut;
  cut.length_mm = (one - other).norm();
  cut.away_mm = surface.plane.absDistance(0.5F * (one + other));
  for (std::size_t half = 0; half < 2; ++half) {
    const Mesh::Triangle triangle = half_of(ring, from, half);
    const Eigen::Vector3f& origin = mesh.vertices_mm[triangle[0]];
    const Eigen::Vector3f cross =
        (mesh.vertices_mm[triangle[1]] - origin).cross(mesh.vertices_mm[triangle[2]] - origin);
    // A triangle within the cells always faces along the grid edge.
    const float facing = std::max(cross.dot(surface.outward), cross.dot(surface.plane.normal()));
    cut.unflipped = cut.unflipped && facing > 0.0F;
    cut.folded = cut.folded || facing < -sliver_mm2;
  }
  return cut;
}

/// Chooses the diagonal that folds no triangle, else the one nearer to the surface, else the
/// shorter one.
void choose_diagonal(Quad& quad,
                     const Mesh& mesh,
                     const Ring& ring,
                     const CrossingPlane& surface,
                     const QuadLimits& limits) {
  const Diagonal one = evaluate_diagonal(mesh, ring, 0, surface, limits.sliver_mm2);
  const Diagonal other = evaluate_diagonal(mesh, ring, 1, surface, limits.sliver_mm2);
  const bool second = [&] {
    if (one.folded != other.folded) return one.folded;
    if (one.unflipped != other.unflipped) return other.unflipped;
    if (std::abs(one.away_mm - other.away_mm) >
        limits.diagonal_tolerance * (one.length_mm + other.length_mm))
      return other.away_mm < one.away_mm;
    return other.length_mm < one.length_mm;
  }();
  quad.diagonal = second ? 1 : 0;
  quad.folded = one.folded && other.folded;
}

void choose_diagonals(Quads& quads,
                      const Mesh& mesh,
                      const EdgeCrossings& crossings,
                      const HermiteAccumulators& hermite,
                      const QuadLimits& limits) {
  parallel_chunks(quads.size(), 1, [&](std::size_t part, std::size_t) {
    for (Quad& quad : quads[part]) {
      choose_diagonal(quad,
                      mesh,
                      ring_of(quad, crossings),
                      plane_at(crossings, hermite, quad.crossing),
                      limits);
    }
  });
}

/// Returns the vertices of quads that are folded or pinched to their cells; returns false without
/// such quads.
bool return_to_cells(const Quads& quads, PlacedVertices& vertices) {
  bool any = false;
  for (const auto& part : quads) {
    for (const Quad& quad : part) {
      if (!quad.folded && quad.pinched == 0) continue;
      any = true;
      for (const std::uint32_t v : quad.ring)
        vertices.mesh.vertices_mm[v] = vertices.in_cell_mm[v];
    }
  }
  return any;
}

void add_triangles(Mesh& mesh, const EdgeCrossings& crossings, const Quads& quads) {
  std::size_t count = 0;
  for (const auto& part : quads)
    count += part.size();
  mesh.triangles.reserve(2 * count);
  for (const auto& part : quads) {
    for (const Quad& quad : part) {
      if (quad.pinched != 0) continue;
      const Ring ring = ring_of(quad, crossings);
      mesh.triangles.push_back(half_of(ring, quad.diagonal, 0));
      mesh.triangles.push_back(half_of(ring, quad.diagonal, 1));
    }
  }
}

std::uint32_t copy_vertex_to(Mesh& mesh, const Eigen::Vector3f& point, std::uint32_t like) {
  mesh.vertices_mm.push_back(point);
  mesh.normals.push_back(mesh.normals[like]);
  mesh.sigma_mm.push_back(mesh.sigma_mm[like]);
  if (!mesh.sigma_systematic_mm.empty())
    mesh.sigma_systematic_mm.push_back(mesh.sigma_systematic_mm[like]);
  mesh.views.push_back(mesh.views[like]);
  return static_cast<std::uint32_t>(mesh.vertices_mm.size() - 1);
}

/// Adds a fan of triangles around the crossing of each pinched quad, with vertices on its pinched
/// faces.
void add_pinched(Mesh& mesh, const EdgeCrossings& crossings, const Quads& quads) {
  std::vector<Quad> pinched;
  for (const auto& part : quads) {
    std::copy_if(part.begin(), part.end(), std::back_inserter(pinched), [](const Quad& quad) {
      return quad.pinched != 0;
    });
  }
  std::map<std::tuple<int, int, int, int>, std::uint32_t> on_face;
  for (const Quad& quad : pinched) {
    const Eigen::Vector3f& point = crossings.points_mm[quad.crossing];
    std::vector<std::uint32_t> ring;
    for (std::size_t side = 0; side < 4; ++side) {
      ring.push_back(quad.ring[side]);
      if ((quad.pinched >> side & 1U) == 0) continue;
      const Eigen::Vector3i low = face_low(quad, side);
      const std::tuple key{low.x(), low.y(), low.z(), face_axis(quad, side)};
      const auto found = on_face.find(key);
      if (found == on_face.end()) {
        const std::uint32_t vertex = copy_vertex_to(mesh, point, quad.ring[side]);
        on_face.emplace(key, vertex);
        ring.push_back(vertex);
      } else {  // the second of the two quads at the face: halfway between their crossings
        mesh.vertices_mm[found->second] = 0.5F * (mesh.vertices_mm[found->second] + point);
        ring.push_back(found->second);
      }
    }
    if (crossings.outward[quad.crossing] < 0) std::reverse(ring.begin(), ring.end());
    const std::uint32_t center = copy_vertex_to(mesh, point, ring[0]);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      mesh.triangles.push_back({center, ring[i], ring[(i + 1) % ring.size()]});
    }
  }
}

}  // namespace

Mesh mesh_quads(PlacedVertices vertices,
                const EdgeCrossings& crossings,
                const HermiteAccumulators& hermite,
                const FusionParameters& parameters) {
  const auto voxel_mm = static_cast<float>(crossings.voxel_mm);
  const float sliver_mm = static_cast<float>(parameters.cleanup.sliver_voxels) * voxel_mm;
  const QuadLimits limits{sliver_mm * voxel_mm,
                          static_cast<float>(parameters.cleanup.diagonal_tolerance)};
  Mesh& mesh = vertices.mesh;
  Quads quads = find_quads(crossings, hermite);
  choose_diagonals(quads, mesh, crossings, hermite, limits);
  constexpr int kMostPasses = 3;  // returning one quad's vertices may fold its neighbour
  for (int pass = 0; pass < kMostPasses && return_to_cells(quads, vertices); ++pass)
    choose_diagonals(quads, mesh, crossings, hermite, limits);
  add_triangles(mesh, crossings, quads);
  add_pinched(mesh, crossings, quads);
  quads = {};

  remove_slivers(mesh, vertices.sharp, sliver_mm, parameters.cleanup);
  const std::vector<std::uint8_t> sharp = sharpen_edges(mesh, voxel_mm, parameters.edges);
  remove_slivers(mesh, sharp, sliver_mm, parameters.cleanup);
  remove_foldovers(mesh, sharp, parameters.cleanup);
  settle_bends(vertices, sharp);

  return std::move(vertices.mesh);
}

}  // namespace frangia
