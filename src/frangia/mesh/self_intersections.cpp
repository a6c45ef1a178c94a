#include "frangia/mesh/self_intersections.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/geometry/aabb_tree.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/components.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/selection.h"
#include "frangia/geometry/triangle_predicates.h"
#include "frangia/geometry/triangles_intersect.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/internal/unite_bodies.h"
#include "frangia/mesh/make_manifold.h"

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

namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Mesh component_of(const Mesh& mesh, const ConnectedComponents& all, std::uint32_t part) {
  Selection keep(mesh.triangles.size());
  for (std::size_t t = 0; t < keep.size(); ++t)
    keep[t] = all.component_of[t] == part ? 1 : 0;
  Mesh one = mesh;
  keep_triangles(one, keep);
  return one;
}

double volume_of(const Mesh& mesh) {
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += mesh.vertices_mm[a].cast<double>().dot(
        mesh.vertices_mm[b].cast<double>().cross(mesh.vertices_mm[c].cast<double>()));
  }
  return volume / 6.0;
}

/// Two components that intersect each other and that were not refused as bodies.
std::optional<std::pair<std::uint32_t, std::uint32_t>> intersecting_components(
    const Pairs& pairs,
    const ConnectedComponents& parts,
    const std::set<std::pair<std::uint32_t, std::uint32_t>>& refused) {
  for (const auto& [a, b] : pairs) {
    const auto both = std::minmax(parts.component_of[a], parts.component_of[b]);
    if (both.first != both.second && !refused.contains(both)) return both;
  }
  return std::nullopt;
}

/// Unites closed components that intersect each other.
Mesh unite_intersecting_bodies(Mesh mesh, const Run& run) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> refused;
  for (;;) {
    const Pairs pairs = self_intersections(mesh, run);
    const ConnectedComponents parts = connected_components(mesh);
    const auto two = intersecting_components(pairs, parts, refused);
    if (!two) return mesh;
    const Mesh a = component_of(mesh, parts, two->first);
    const Mesh b = component_of(mesh, parts, two->second);
    std::optional<Mesh> united;
    if (volume_of(a) > 0.0 && volume_of(b) > 0.0) united = unite_bodies(a, b, run);
    if (!united) {
      refused.insert(*two);
      continue;
    }
    Selection others(mesh.triangles.size());
    for (std::size_t t = 0; t < others.size(); ++t)
      others[t] =
          parts.component_of[t] != two->first && parts.component_of[t] != two->second ? 1 : 0;
    keep_triangles(mesh, others);
    append_mesh(mesh, *united);
    refused.clear();  // the components have new numbers
    run.check();
  }
}

/// A piece that deleting cuts off is removed below this share of the largest piece's area.
constexpr double kFragment = 0.1;

/// Adds small pieces that deleting would cut off to the removed triangles.
Selection with_fragments(const Mesh& mesh, Selection removed) {
  const ConnectedComponents before = connected_components(mesh);
  Mesh left = mesh;
  const Selection kept = invert_selection(removed);
  keep_triangles(left, kept);
  const ConnectedComponents after = connected_components(left);
  std::vector<std::uint32_t> component_before(after.components.size());
  std::vector<std::uint32_t> piece_of(mesh.triangles.size());
  std::size_t next = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (kept[t] == 0) continue;
    piece_of[t] = after.component_of[next++];
    component_before[piece_of[t]] = before.component_of[t];
  }
  std::vector<double> largest(before.components.size());
  for (std::size_t p = 0; p < after.components.size(); ++p)
    largest[component_before[p]] =
        std::max(largest[component_before[p]], after.components[p].area_mm2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (kept[t] == 0) continue;
    const std::uint32_t piece = piece_of[t];
    if (after.components[piece].area_mm2 < kFragment * largest[component_before[piece]])
      removed[t] = 1;
  }
  return removed;
}

enum class VertexOrigin : std::uint8_t { Inside, NewBoundary, OldBoundary };

/// Classifies the vertices that remain after deleting: those whose triangles were removed, and
/// those that were on a boundary before.
std::vector<VertexOrigin> origins_after_deleting(const Mesh& mesh, const Selection& removed) {
  std::vector<std::uint8_t> remains(mesh.vertices_mm.size());
  std::vector<VertexOrigin> at(mesh.vertices_mm.size(), VertexOrigin::Inside);
  for (std::size_t i = 0; i < removed.size(); ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      if (removed[i] != 0) at[vertex] = VertexOrigin::NewBoundary;
      if (removed[i] == 0) remains[vertex] = 1;
    }
  }
  const HalfEdges edges(mesh);
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (edges.is_boundary(edge))
      at[source_vertex(mesh, edge)] = at[target_vertex(mesh, edge)] = VertexOrigin::OldBoundary;
  }
  std::vector<VertexOrigin> left;
  for (std::size_t v = 0; v < remains.size(); ++v)
    if (remains[v] != 0) left.push_back(at[v]);
  return left;
}

/// Fills the holes whose boundary is new and nowhere part of an old one.
Mesh close_new_boundaries(Mesh mesh, const std::vector<VertexOrigin>& at, const Run& run) {
  FillHolesOptions options;
  const std::vector<BoundaryLoop> loops = boundary_loops(mesh);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const auto vertices = vertices_of(mesh, loops[i]);
    const auto is = [&](VertexOrigin what) {
      return [&at, what](std::uint32_t v) { return v < at.size() && at[v] == what; };
    };
    if (std::any_of(vertices.begin(), vertices.end(), is(VertexOrigin::NewBoundary)) &&
        std::none_of(vertices.begin(), vertices.end(), is(VertexOrigin::OldBoundary))) {
      options.only.push_back(i);
    }
  }
  return options.only.empty() ? mesh : fill_holes(std::move(mesh), options, run);
}

}  // namespace

Mesh remove_self_intersections(Mesh mesh, const Run& run) {
  constexpr int kRounds = 8;  // each removes one more ring of triangles
  mesh = unite_intersecting_bodies(std::move(mesh), run);
  for (int round = 0; round < kRounds; ++round) {
    Selection intersecting = select_self_intersections(mesh, run);
    if (count_selected(intersecting) == 0) return mesh;
    intersecting = with_fragments(mesh, grow_selection(mesh, std::move(intersecting), round));
    const std::vector<VertexOrigin> at = origins_after_deleting(mesh, intersecting);
    mesh = make_manifold(delete_selected(std::move(mesh), intersecting), run);
    mesh = close_new_boundaries(std::move(mesh), at, run);
    run.report((round + 1.0) / kRounds);
  }
  if (count_selected(select_self_intersections(mesh, run)) > 0) {
    run.warn(
        "some triangles still intersect; select them with `select_self_intersections`, delete them "
        "and fill the holes");
  }
  return mesh;
}

}  // namespace frangia
