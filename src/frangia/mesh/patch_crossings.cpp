#include "frangia/mesh/patch_crossings.h"

#include <algorithm>
#include <utility>

#include "frangia/core/parallel.h"
#include "frangia/mesh/box_tree.h"
#include "frangia/mesh/surely_parted.h"
#include "frangia/mesh/triangles_cross.h"

namespace frangia {
namespace {

constexpr std::size_t kChunk = 16'384;

/// The triangles of all patches, with the corners' places of their own.
class Patches {
 public:
  Patches(const Mesh& mesh, const std::vector<HolePatch>& patches) : mesh_(mesh) {
    const auto count = static_cast<std::uint32_t>(mesh.vertices_mm.size());
    for (std::uint32_t patch = 0; patch < patches.size(); ++patch) {
      const auto shift = static_cast<std::uint32_t>(places_.size());
      for (Mesh::Triangle triangle : patches[patch].triangles) {
        for (std::uint32_t& vertex : triangle)
          if (vertex >= count) vertex += shift;
        names_.push_back(triangle);
        owner_.push_back(patch);
      }
      places_.insert(
          places_.end(), patches[patch].places_mm.begin(), patches[patch].places_mm.end());
    }
    find_rims();
  }

  /// The patches alone, each triangle with three vertices: for a BoxTree.
  [[nodiscard]] Mesh loose() const {
    Mesh all;
    for (const Mesh::Triangle& name : names_) {
      const auto first = static_cast<std::uint32_t>(all.vertices_mm.size());
      for (const std::uint32_t vertex : name)
        all.vertices_mm.push_back(place(vertex));
      all.triangles.push_back({first, first + 1, first + 2});
    }
    return all;
  }
  [[nodiscard]] CornerPlaces corners(const Mesh::Triangle& triangle) const {
    return corner_places(triangle, [&](std::uint32_t v) { return place(v).cast<double>(); });
  }
  [[nodiscard]] const Mesh::Triangle& name(std::uint32_t triangle) const {
    return names_[triangle];
  }
  [[nodiscard]] std::uint32_t owner(std::uint32_t triangle) const { return owner_[triangle]; }
  [[nodiscard]] bool at_rim(std::uint32_t triangle) const { return at_rim_[triangle] != 0; }

 private:
  /// Triangles within some rings of the mesh's own vertices.
  void find_rims() {
    constexpr int kRings = 5;
    const std::size_t count = mesh_.vertices_mm.size();
    std::vector<std::uint8_t> reached(places_.size());
    const auto is_reached = [&](std::uint32_t v) { return v < count || reached[v - count] != 0; };
    at_rim_.assign(names_.size(), 0);
    for (int ring = 0; ring < kRings; ++ring) {
      for (std::size_t t = 0; t < names_.size(); ++t)
        at_rim_[t] = std::any_of(names_[t].begin(), names_[t].end(), is_reached) ? 1 : 0;
      for (std::size_t t = 0; t < names_.size(); ++t) {
        for (const std::uint32_t vertex : names_[t])
          if (at_rim_[t] != 0 && vertex >= count) reached[vertex - count] = 1;
      }
    }
  }
  [[nodiscard]] const Eigen::Vector3f& place(std::uint32_t vertex) const {
    const std::size_t count = mesh_.vertices_mm.size();
    return vertex < count ? mesh_.vertices_mm[vertex] : places_[vertex - count];
  }

  const Mesh& mesh_;
  std::vector<Mesh::Triangle> names_;  ///< by the mesh's vertices, then the patches'
  std::vector<std::uint32_t> owner_;
  std::vector<std::uint8_t> at_rim_;
  std::vector<Eigen::Vector3f> places_;
};

bool cross(const CornerPlaces& a, const CornerPlaces& b) {
  return !surely_parted(a, b) && triangles_cross(a, b);
}

struct FoundPair {
  std::uint32_t patch;
  bool at_rim;
};
using Found = std::vector<FoundPair>;

/// Adds what `find(begin, end, found)` finds on all cores.
template <typename Find>
void add_found(std::size_t count, std::vector<PatchCrossings>& crossings, const Find& find) {
  std::vector<Found> found((count + kChunk - 1) / kChunk);
  parallel_chunks(count, kChunk, [&](std::size_t begin, std::size_t end) {
    find(begin, end, found[begin / kChunk]);
  });
  for (const Found& some : found) {
    for (const FoundPair& pair : some) {
      PatchCrossings& of_patch = crossings[pair.patch];
      ++(pair.at_rim ? of_patch.at_rim : of_patch.inside);
    }
  }
}

}  // namespace

std::vector<PatchCrossings> patch_crossings(const Mesh& mesh,
                                            const std::vector<HolePatch>& patches) {
  std::vector<PatchCrossings> crossings(patches.size());
  const Patches all(mesh, patches);
  const BoxTree tree(all.loose());
  add_found(tree.leaves(), crossings, [&](std::size_t begin, std::size_t end, Found& found) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) {
      tree.touching_pairs(leaf, [&](std::uint32_t a, std::uint32_t b) {
        if (!cross(all.corners(all.name(a)), all.corners(all.name(b)))) return;
        const bool at_rim = all.at_rim(a) && all.at_rim(b);
        found.push_back({all.owner(a), at_rim});
        if (all.owner(b) != all.owner(a)) found.push_back({all.owner(b), at_rim});
      });
    }
  });
  add_found(
      mesh.triangles.size(), crossings, [&](std::size_t begin, std::size_t end, Found& found) {
        for (std::size_t t = begin; t < end; ++t) {
          const auto box = BoxTree::box_of(mesh, static_cast<std::uint32_t>(t));
          tree.touching(box, [&](std::uint32_t a) {
            if (cross(all.corners(all.name(a)), all.corners(mesh.triangles[t])))
              found.push_back({all.owner(a), all.at_rim(a)});
          });
        }
      });
  return crossings;
}

}  // namespace frangia
