#include "frangia/mesh/self_intersections.h"

#include <algorithm>
#include <utility>

#include "frangia/core/parallel.h"
#include "frangia/geometry/aabb_tree.h"
#include "frangia/geometry/surely_disjoint.h"
#include "frangia/geometry/triangles_intersect.h"

namespace frangia {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

constexpr std::size_t kChunk = 2048;  // leaves of the tree

IndexedTriangle corners_of(const Mesh& mesh, std::uint32_t triangle) {
  return indexed_triangle(mesh.triangles[triangle],
                          [&](std::uint32_t v) { return mesh.vertices_mm[v].cast<double>(); });
}

bool do_intersect(const Mesh& mesh, std::uint32_t a, std::uint32_t b) {
  const IndexedTriangle of_a = corners_of(mesh, a);
  const IndexedTriangle of_b = corners_of(mesh, b);
  return !surely_disjoint(of_a, of_b) && triangles_intersect(of_a, of_b);
}

}  // namespace

Pairs self_intersections(const Mesh& mesh, const Run& run) {
  const AabbTree tree(mesh);
  const std::size_t count = tree.leaves();
  std::vector<Pairs> found((count + kChunk - 1) / kChunk);
  run.check();
  parallel_chunks(count, kChunk, [&](std::size_t begin, std::size_t end) {
    if (run.stop.stop_requested()) return;  // run.check() below throws
    Pairs& pairs = found[begin / kChunk];
    for (std::size_t leaf = begin; leaf < end; ++leaf) {
      tree.overlapping_pairs(leaf, [&](std::uint32_t a, std::uint32_t b) {
        if (do_intersect(mesh, a, b)) {
          pairs.emplace_back(std::min(a, b), std::max(a, b));
        }
      });
    }
  });
  run.check();
  Pairs all;
  for (const Pairs& pairs : found)
    all.insert(all.end(), pairs.begin(), pairs.end());
  std::sort(all.begin(), all.end());
  return all;
}

Selection select_self_intersections(const Mesh& mesh, const Run& run) {
  Selection selection(mesh.triangles.size());
  for (const auto& pair : self_intersections(mesh, run))
    selection[pair.first] = selection[pair.second] = 1;
  return selection;
}

}  // namespace frangia
