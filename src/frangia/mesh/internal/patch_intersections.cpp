#include "frangia/mesh/internal/patch_intersections.h"

#include <algorithm>
#include <utility>

#include "frangia/core/parallel.h"
#include "frangia/geometry/aabb_tree.h"
#include "frangia/geometry/surely_disjoint.h"
#include "frangia/geometry/triangles_intersect.h"

namespace frangia {
namespace {

constexpr std::size_t kCandidatesPerChunk = 16'384;

/// The triangles of all patches.
class Patches {
 public:
  Patches(const Mesh& mesh, const std::vector<HolePatch>& patches) : mesh_(mesh) {
    const auto count = static_cast<std::uint32_t>(mesh.vertices_mm.size());
    for (std::uint32_t patch = 0; patch < patches.size(); ++patch) {
      const auto shift = static_cast<std::uint32_t>(positions_.size());
      for (Mesh::Triangle triangle : patches[patch].triangles) {
        for (std::uint32_t& vertex : triangle)
          if (vertex >= count) vertex += shift;
        triangles_.push_back(triangle);
        owner_.push_back(patch);
      }
      positions_.insert(
          positions_.end(), patches[patch].positions_mm.begin(), patches[patch].positions_mm.end());
    }
    find_boundaries();
  }

  /// The patches as triangles without shared vertices, for an AabbTree.
  [[nodiscard]] Mesh unconnected() const {
    Mesh all;
    for (const Mesh::Triangle& name : triangles_) {
      const auto first = static_cast<std::uint32_t>(all.vertices_mm.size());
      for (const std::uint32_t vertex : name)
        all.vertices_mm.push_back(position(vertex));
      all.triangles.push_back({first, first + 1, first + 2});
    }
    return all;
  }
  [[nodiscard]] IndexedTriangle corners(const Mesh::Triangle& triangle) const {
    return indexed_triangle(triangle, [&](std::uint32_t v) { return position(v).cast<double>(); });
  }
  [[nodiscard]] const Mesh::Triangle& triangle(std::uint32_t triangle) const {
    return triangles_[triangle];
  }
  [[nodiscard]] std::uint32_t owner(std::uint32_t triangle) const { return owner_[triangle]; }
  [[nodiscard]] bool at_boundary(std::uint32_t triangle) const {
    return at_boundary_[triangle] != 0;
  }

 private:
  /// Finds the triangles within five rings of the boundary vertices.
  void find_boundaries() {
    constexpr int kRings = 5;
    const std::size_t count = mesh_.vertices_mm.size();
    std::vector<std::uint8_t> reached(positions_.size());
    const auto is_reached = [&](std::uint32_t v) { return v < count || reached[v - count] != 0; };
    at_boundary_.assign(triangles_.size(), 0);
    for (int ring = 0; ring < kRings; ++ring) {
      for (std::size_t t = 0; t < triangles_.size(); ++t) {
        at_boundary_[t] =
            std::any_of(triangles_[t].begin(), triangles_[t].end(), is_reached) ? 1 : 0;
      }
      for (std::size_t t = 0; t < triangles_.size(); ++t) {
        for (const std::uint32_t vertex : triangles_[t])
          if (at_boundary_[t] != 0 && vertex >= count) reached[vertex - count] = 1;
      }
    }
  }
  [[nodiscard]] const Eigen::Vector3f& position(std::uint32_t vertex) const {
    const std::size_t count = mesh_.vertices_mm.size();
    return vertex < count ? mesh_.vertices_mm[vertex] : positions_[vertex - count];
  }

  const Mesh& mesh_;
  std::vector<Mesh::Triangle> triangles_;  ///< indices of mesh vertices, then of `positions_`
  std::vector<std::uint32_t> owner_;
  std::vector<std::uint8_t> at_boundary_;
  std::vector<Eigen::Vector3f> positions_;
};

bool intersect(const IndexedTriangle& a, const IndexedTriangle& b) {
  return !surely_disjoint(a, b) && triangles_intersect(a, b);
}

struct FoundPair {
  std::uint32_t patch;
  bool at_boundary;
};
using Found = std::vector<FoundPair>;

/// Adds the pairs that `find(begin, end, found)` appends, on all cores.
template <typename Find>
void add_found(std::size_t count,
               std::vector<PatchIntersections>& intersections,
               const Run& run,
               const Find& find) {
  std::vector<Found> found((count + kCandidatesPerChunk - 1) / kCandidatesPerChunk);
  parallel_chunks(count, kCandidatesPerChunk, [&](std::size_t begin, std::size_t end) {
    if (!run.stop.stop_requested()) find(begin, end, found[begin / kCandidatesPerChunk]);
  });
  run.check();
  for (const Found& pairs : found) {
    for (const FoundPair& pair : pairs) {
      PatchIntersections& of_patch = intersections[pair.patch];
      ++(pair.at_boundary ? of_patch.at_boundary : of_patch.inside);
    }
  }
}

}  // namespace

std::vector<PatchIntersections> patch_intersections(const Mesh& mesh,
                                                    const std::vector<HolePatch>& patches,
                                                    const Run& run) {
  std::vector<PatchIntersections> intersections(patches.size());
  const Patches all(mesh, patches);
  const AabbTree tree(all.unconnected());
  add_found(
      tree.leaves(), intersections, run, [&](std::size_t begin, std::size_t end, Found& found) {
        for (std::size_t leaf = begin; leaf < end; ++leaf) {
          tree.overlapping_pairs(leaf, [&](std::uint32_t a, std::uint32_t b) {
            if (!intersect(all.corners(all.triangle(a)), all.corners(all.triangle(b)))) return;
            const bool at_boundary = all.at_boundary(a) && all.at_boundary(b);
            found.push_back({all.owner(a), at_boundary});
            if (all.owner(b) != all.owner(a)) found.push_back({all.owner(b), at_boundary});
          });
        }
      });
  add_found(mesh.triangles.size(),
            intersections,
            run,
            [&](std::size_t begin, std::size_t end, Found& found) {
              for (std::size_t t = begin; t < end; ++t) {
                const auto box = AabbTree::box_of(mesh, static_cast<std::uint32_t>(t));
                tree.overlapping(box, [&](std::uint32_t a) {
                  if (intersect(all.corners(all.triangle(a)), all.corners(mesh.triangles[t])))
                    found.push_back({all.owner(a), all.at_boundary(a)});
                });
              }
            });
  return intersections;
}

}  // namespace frangia
