#include "frangia/mesh/self_intersections.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/geometry/aabb_tree.h"
#include "frangia/geometry/surely_disjoint.h"
#include "frangia/geometry/triangles_intersect.h"

namespace frangia {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

constexpr std::size_t kSearchesPerChunk = 2048;  // leaves of the tree, or triangles
/// Triangles that all coincide intersect in pairs without bound. A scan has thousands of pairs.
constexpr std::size_t kMaxPairs = 1'000'000;

IndexedTriangle corners_of(const Mesh& mesh, std::uint32_t triangle) {
  return indexed_triangle(mesh.triangles[triangle],
                          [&](std::uint32_t v) { return mesh.vertices_mm[v].cast<double>(); });
}

bool do_intersect(const Mesh& mesh, std::uint32_t a, std::uint32_t b) {
  const IndexedTriangle of_a = corners_of(mesh, a);
  const IndexedTriangle of_b = corners_of(mesh, b);
  return !surely_disjoint(of_a, of_b) && triangles_intersect(of_a, of_b);
}

/// Whether two corners are at the same position: such a triangle intersects none.
bool is_collapsed(const Mesh& mesh, const Mesh::Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  return mesh.vertices_mm[a] == mesh.vertices_mm[b] || mesh.vertices_mm[b] == mesh.vertices_mm[c] ||
         mesh.vertices_mm[c] == mesh.vertices_mm[a];
}

/// Some triangles of a mesh and the tree of their boxes.
struct Part {
  Part(const Mesh& mesh, std::vector<std::uint32_t> numbers)
      : triangles(std::move(numbers)), tree(part_of(mesh, triangles)) {}

  static Mesh part_of(const Mesh& mesh, const std::vector<std::uint32_t>& numbers) {
    Mesh part;
    for (const std::uint32_t triangle : numbers) {
      const auto first = static_cast<std::uint32_t>(part.vertices_mm.size());
      for (const std::uint32_t vertex : mesh.triangles[triangle])
        part.vertices_mm.push_back(mesh.vertices_mm[vertex]);
      part.triangles.push_back({first, first + 1, first + 2});
    }
    return part;
  }

  std::vector<std::uint32_t> triangles;
  AabbTree tree;
};

/// Calls `work(i, pairs)` for each i below `count`, in parallel, and adds the pairs in order.
template <typename Work>
void collect(std::size_t count, std::size_t chunk, Pairs& all, const Run& run, const Work& work) {
  std::vector<Pairs> found((count + chunk - 1) / chunk);
  std::atomic<std::size_t> total = all.size();
  run.check();
  parallel_chunks(count, chunk, [&](std::size_t begin, std::size_t end) {
    Pairs& pairs = found[begin / chunk];
    for (std::size_t i = begin; i < end; ++i) {
      if (run.stop.stop_requested() || total > kMaxPairs) return;  // an error follows below
      const std::size_t before = pairs.size();
      work(i, pairs);
      total += pairs.size() - before;
    }
  });
  run.check();
  if (total > kMaxPairs) {
    throw Error(ErrorKind::Input,
                "more than a million pairs of triangles intersect; remove the triangles that "
                "coincide");
  }
  for (const Pairs& pairs : found)
    all.insert(all.end(), pairs.begin(), pairs.end());
}

/// The triangles around vertices of high valence, and the others, without collapsed ones. All boxes
/// of a fan overlap at its apex, so a tree of them has a quadratic number of overlapping pairs.
class FanSearch {
 public:
  FanSearch(const Mesh& mesh, const std::vector<std::uint32_t>& valence) : mesh_(mesh) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> by_apex;
    std::vector<std::uint32_t> others;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto& corners = mesh.triangles[i];
      if (is_collapsed(mesh, corners)) continue;
      const std::uint32_t apex =
          *std::max_element(corners.begin(), corners.end(), [&](std::uint32_t a, std::uint32_t b) {
            return valence[a] < valence[b];
          });
      (valence[apex] > kMaxValence ? by_apex[apex] : others).push_back(i);
    }
    parts_.emplace_back(mesh, std::move(others));
    for (auto& [apex, triangles] : by_apex) {
      apexes_.push_back(apex);
      parts_.emplace_back(mesh, std::move(triangles));
    }
  }

  void find(Pairs& all, const Run& run) const {
    const Part& others = parts_.front();
    collect(others.tree.leaves(), kSearchesPerChunk, all, run, [&](std::size_t leaf, Pairs& pairs) {
      others.tree.overlapping_pairs(leaf, [&](std::uint32_t a, std::uint32_t b) {
        add(others.triangles[a], others.triangles[b], pairs);
      });
    });
    for (std::size_t fan = 1; fan < parts_.size(); ++fan) {
      for (std::size_t earlier = 0; earlier < fan; ++earlier)
        find_between(parts_[fan], parts_[earlier], all, run);
      find_within(parts_[fan], apexes_[fan - 1], all, run);
    }
  }

  /// The valence up to which the tree of all triangles is faster.
  static constexpr std::uint32_t kMaxValence = 256;

 private:
  void add(std::uint32_t a, std::uint32_t b, Pairs& pairs) const {
    if (do_intersect(mesh_, a, b)) pairs.emplace_back(std::min(a, b), std::max(a, b));
  }

  void find_between(const Part& fan, const Part& other, Pairs& all, const Run& run) const {
    collect(fan.triangles.size(), kSearchesPerChunk, all, run, [&](std::size_t i, Pairs& pairs) {
      const std::uint32_t triangle = fan.triangles[i];
      other.tree.overlapping(AabbTree::box_of(mesh_, triangle),
                             [&](std::uint32_t k) { add(triangle, other.triangles[k], pairs); });
    });
  }

  /// Two triangles with the apex in common intersect elsewhere only where the edge of one that is
  /// opposite to the apex meets the other: a ray from the apex leaves a triangle through that edge.
  void find_within(const Part& fan, std::uint32_t apex, Pairs& all, const Run& run) const {
    Mesh opposite;
    for (const std::uint32_t triangle : fan.triangles) {
      const auto& corners = mesh_.triangles[triangle];
      const auto at = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), apex) -
                                               corners.begin());
      const auto first = static_cast<std::uint32_t>(opposite.vertices_mm.size());
      opposite.vertices_mm.push_back(mesh_.vertices_mm[corners[(at + 1) % 3]]);
      opposite.vertices_mm.push_back(mesh_.vertices_mm[corners[(at + 2) % 3]]);
      opposite.triangles.push_back({first, first + 1, first + 1});
    }
    const AabbTree edges(opposite);
    collect(fan.triangles.size(), kSearchesPerChunk, all, run, [&](std::size_t i, Pairs& pairs) {
      const std::uint32_t triangle = fan.triangles[i];
      edges.overlapping(AabbTree::box_of(mesh_, triangle), [&](std::uint32_t k) {
        if (k != i) add(triangle, fan.triangles[k], pairs);
      });
    });
  }

  const Mesh& mesh_;
  std::vector<Part> parts_;  ///< the triangles of no fan, then the fans
  std::vector<std::uint32_t> apexes_;
};

}  // namespace

Pairs self_intersections(const Mesh& mesh, const Run& run) {
  std::vector<std::uint32_t> valence(mesh.vertices_mm.size());
  bool any_collapsed = false;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      require(vertex < valence.size(),
              "a triangle refers to a vertex that does not exist; repair the mesh first");
      ++valence[vertex];
    }
    any_collapsed = any_collapsed || is_collapsed(mesh, triangle);
  }
  Pairs all;
  const auto most = std::max_element(valence.begin(), valence.end());
  if (any_collapsed || (most != valence.end() && *most > FanSearch::kMaxValence)) {
    FanSearch(mesh, valence).find(all, run);
  } else {
    const AabbTree tree(mesh);
    collect(tree.leaves(), kSearchesPerChunk, all, run, [&](std::size_t leaf, Pairs& pairs) {
      tree.overlapping_pairs(leaf, [&](std::uint32_t a, std::uint32_t b) {
        if (do_intersect(mesh, a, b)) pairs.emplace_back(std::min(a, b), std::max(a, b));
      });
    });
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

Selection select_self_intersections(const Mesh& mesh, const Run& run) {
  Selection selection(mesh.triangles.size());
  for (const auto& pair : self_intersections(mesh, run))
    selection[pair.first] = selection[pair.second] = 1;
  return selection;
}

}  // namespace frangia
