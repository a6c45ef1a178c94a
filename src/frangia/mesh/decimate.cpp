#include "frangia/mesh/decimate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/internal/distance_guard.h"
#include "frangia/mesh/internal/edge_collapse.h"
#include "frangia/mesh/internal/lazy_priority_queue.h"
#include "frangia/mesh/internal/with_manifold_edges.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

/// An edge that may be collapsed. It is outdated once either end has changed.
struct Candidate {
  float cost = 0.0F;
  std::uint32_t a = 0, b = 0;
  std::uint32_t version = 0;

  bool operator<(const Candidate& other) const {
    if (cost != other.cost) return cost < other.cost;
    return a != other.a ? a < other.a : b < other.b;
  }
};

/// A collapse of b into a.
struct CollapseStep {
  std::uint32_t a = 0, b = 0;
  Eigen::Vector3f target_mm = Eigen::Vector3f::Zero();
};

class Decimation {
 public:
  /// Vertices that `kept` marks stay where they are; empty: none.
  Decimation(Mesh& mesh,
             const HalfEdges& edges,
             double tolerance_mm,
             const std::vector<std::uint8_t>& kept)
      : mesh_(mesh),
        kept_(kept),
        max_mean_square_(tolerance_mm * tolerance_mm),
        tie_weight_(tie_weight_of(mesh)),
        cost_(mesh, edges),
        topology_(mesh, edges),
        versions_(mesh.vertices_mm.size()) {}

  /// Collapses candidates, and what they lead to, until `target` triangles are left or no edge may
  /// collapse.
  void run(std::vector<Candidate> candidates,
           std::size_t target,
           DistanceGuard* guard,
           const Run& run) {
    constexpr std::size_t kCollapsesPerCheck = 1024;  // about 10 ms with a guard
    LazyPriorityQueue<Candidate> queue(std::move(candidates));
    const auto outdated = [this](const Candidate& candidate) {
      return candidate.version != versions_[candidate.a] + versions_[candidate.b] ||
             topology_.is_removed(candidate.a) || topology_.is_removed(candidate.b);
    };
    const std::size_t begin = topology_.remaining_triangles();
    std::size_t steps = 0;
    while (topology_.remaining_triangles() > target) {
      const auto candidate = queue.pop(outdated);
      if (!candidate) break;
      if (outdated(*candidate)) continue;
      if (try_collapse(candidate->a, candidate->b, guard)) {
        topology_.neighbors(candidate->a, neighbors_);
        for (const std::uint32_t v : neighbors_)
          if (const auto fresh = candidate_of(candidate->a, v)) queue.push(*fresh);
      }
      if (++steps % kCollapsesPerCheck == 0) {
        run.report(static_cast<double>(begin - topology_.remaining_triangles()) /
                   static_cast<double>(begin - target));
      }
    }
  }

  /// Edges may collapse whose root mean square distance from the planes of the original is at most
  /// this.
  void limit(double distance_mm) { max_mean_square_ = distance_mm * distance_mm; }

  /// The edges of a mesh of which none has collapsed.
  [[nodiscard]] std::vector<Candidate> candidates_of(const HalfEdges& edges, const Run& run) const {
    constexpr std::size_t kChunk = 65'536;
    std::vector<std::vector<Candidate>> found((edges.count() + kChunk - 1) / kChunk);
    parallel_chunks(edges.count(), kChunk, [&](std::size_t begin, std::size_t end) {
      if (run.stop.stop_requested()) return;  // run.check() below throws
      for (std::size_t i = begin; i < end; ++i) {
        const auto edge = static_cast<std::uint32_t>(i);
        if (edges.has_twin(edge) && edges.twin(edge) < edge) continue;
        const auto candidate = candidate_of(source_vertex(mesh_, edge), target_vertex(mesh_, edge));
        if (candidate) found[begin / kChunk].push_back(*candidate);
      }
    });
    run.check();
    std::vector<Candidate> all;
    for (auto& candidates : found) {
      all.insert(all.end(), candidates.begin(), candidates.end());
      candidates = {};
    }
    return all;
  }

  /// The edges of the present mesh at vertices that `chosen` marks.
  [[nodiscard]] std::vector<Candidate> present_candidates(const std::vector<std::uint8_t>& chosen) {
    std::vector<Candidate> found;
    for (std::uint32_t v = 0; v < versions_.size(); ++v) {
      if (topology_.is_removed(v) || chosen[v] == 0) continue;
      topology_.neighbors(v, neighbors_);
      for (const std::uint32_t other : neighbors_) {
        if (other < v && chosen[other] != 0) continue;
        if (const auto candidate = candidate_of(v, other)) found.push_back(*candidate);
      }
    }
    return found;
  }

  /// Performs the steps of an earlier decimation, except those at vertices that stay now and those
  /// that depend on them. Returns the vertices at which the mesh differs.
  std::vector<std::uint8_t> repeat(const std::vector<CollapseStep>& earlier, const Run& run) {
    constexpr std::size_t kStepsPerCheck = 16'384;
    std::vector<std::uint8_t> differs(kept_);
    std::vector<std::uint8_t> beside(kept_.size());  // a neighbour differs
    const auto mark_beside = [&](std::uint32_t v) {
      topology_.neighbors(v, neighbors_);
      for (const std::uint32_t other : neighbors_)
        beside[other] = 1;
    };
    for (std::uint32_t v = 0; v < differs.size(); ++v)
      if (differs[v] != 0) mark_beside(v);
    for (std::size_t i = 0; i < earlier.size(); ++i) {
      if (i % kStepsPerCheck == 0) run.check();
      const auto& [a, b, target_mm] = earlier[i];
      const Vector3d target = target_mm.cast<double>();
      const bool same = differs[a] == 0 && differs[b] == 0 &&
                        ((beside[a] == 0 && beside[b] == 0) ||
                         (topology_.can_collapse(a, b) && keeps_orientation(a, b, target) &&
                          keeps_orientation(b, a, target)));
      if (same) {
        collapse(a, b, target);
        beside[a] |= beside[b];
        continue;
      }
      for (const std::uint32_t v : {a, b}) {
        if (differs[v] == 0) mark_beside(v);
        differs[v] = 1;
      }
    }
    return differs;
  }

  /// The collapses, in their order.
  [[nodiscard]] const std::vector<CollapseStep>& steps() const { return steps_; }
  /// Which triangles of the mesh are left.
  [[nodiscard]] const std::vector<std::uint8_t>& alive() const { return topology_.alive(); }
  [[nodiscard]] const CollapseTopology& topology() const { return topology_; }

 private:
  [[nodiscard]] Vector3d position(std::uint32_t v) const {
    return mesh_.vertices_mm[v].cast<double>();
  }

  /// Rounding of a quadric's error at the largest coordinate, per squared length of an edge.
  [[nodiscard]] static double tie_weight_of(const Mesh& mesh) {
    double largest_mm = 0.0;
    for (const Eigen::Vector3f& vertex : mesh.vertices_mm)
      largest_mm = std::max(largest_mm, static_cast<double>(vertex.cwiseAbs().maxCoeff()));
    return std::numeric_limits<double>::epsilon() * largest_mm * largest_mm;
  }

  [[nodiscard]] std::optional<Candidate> candidate_of(std::uint32_t a, std::uint32_t b) const {
    if (a > b) std::swap(a, b);
    if (a == b || topology_.is_fixed(a) || topology_.is_fixed(b)) return std::nullopt;
    if (!kept_.empty() && (kept_[a] != 0 || kept_[b] != 0)) return std::nullopt;
    const CollapseTarget target = cost_.target(a, b);
    if (target.mean_square > max_mean_square_) return std::nullopt;
    // Of edges that are equally flat, short ones come first.
    const double cost = target.cost + tie_weight_ * (position(a) - position(b)).squaredNorm();
    return Candidate{static_cast<float>(cost), a, b, versions_[a] + versions_[b]};
  }

  /// Collapses an edge if that is allowed.
  bool try_collapse(std::uint32_t a, std::uint32_t b, DistanceGuard* guard) {
    // Rounded to the precision of the mesh, so that the checks see the final position.
    CollapseTarget target = cost_.target(a, b);
    const Vector3d target_mm = target.position.cast<float>().cast<double>();
    target.position = target_mm;
    if (!topology_.can_collapse(a, b)) return false;
    if (!keeps_orientation(a, b, target_mm) || !keeps_orientation(b, a, target_mm)) return false;
    if (guard != nullptr) {
      if (!guard->allows(topology_, mesh_, a, b, target)) return false;
      guard->accept();
    }
    collapse(a, b, target_mm);
    return true;
  }

  /// Whether no remaining triangle at v flips or becomes a sliver.
  [[nodiscard]] bool keeps_orientation(std::uint32_t v,
                                       std::uint32_t other,
                                       const Vector3d& target_mm) const {
    constexpr double kMinCosine = 0.2;  // a triangle turns by less than 78 degrees
    constexpr double kMinShape = 0.02;  // twice the area over the longest side squared
    bool is_valid = true;
    topology_.for_each_corner(v, [&](std::uint32_t corner) {
      const std::uint32_t next = topology_.at(HalfEdges::next(corner));
      const std::uint32_t last = topology_.at(HalfEdges::previous(corner));
      if (!is_valid || next == other || last == other) return;
      const Vector3d side = position(last) - position(next);
      const Vector3d before = (position(next) - position(v)).cross(side);
      const Vector3d after = (position(next) - target_mm).cross(side);
      const double longest = std::max({side.squaredNorm(),
                                       (position(next) - target_mm).squaredNorm(),
                                       (position(last) - target_mm).squaredNorm()});
      const bool flipped = before.dot(after) < kMinCosine * before.norm() * after.norm();
      const bool thin = after.norm() < kMinShape * longest && after.norm() < before.norm();
      is_valid = !flipped && !thin;
    });
    return is_valid;
  }

  void collapse(std::uint32_t a, std::uint32_t b, const Vector3d& target_mm) {
    topology_.collapse(a, b);
    cost_.collapse(a, b);
    if (!mesh_.colors.empty()) {
      const Vector3d edge = position(b) - position(a);
      const double along = edge.dot(target_mm - position(a)) / std::max(edge.squaredNorm(), 1e-300);
      mesh_.colors[a] = mix_colors(
          mesh_.colors[a], mesh_.colors[b], static_cast<float>(std::clamp(along, 0.0, 1.0)));
    }
    mesh_.vertices_mm[a] = target_mm.cast<float>();
    set_sigma(
        mesh_, a, [&](const std::vector<float>& values) { return std::max(values[a], values[b]); });
    if (!mesh_.views.empty()) mesh_.views[a] = std::min(mesh_.views[a], mesh_.views[b]);
    if (!mesh_.vertex_marks.empty()) {
      mesh_.vertex_marks[a] = std::max(mesh_.vertex_marks[a], mesh_.vertex_marks[b]);
    }
    versions_[a] += 1 + versions_[b];
    steps_.push_back({a, b, mesh_.vertices_mm[a]});
  }

  Mesh& mesh_;
  const std::vector<std::uint8_t>& kept_;
  double max_mean_square_;
  double tie_weight_;
  CollapseCost cost_;
  CollapseTopology topology_;
  std::vector<std::uint32_t> versions_;
  std::vector<CollapseStep> steps_;
  std::vector<std::uint32_t> neighbors_;
};

Mesh decimate_to_count(Mesh mesh, std::size_t triangles, const Run& run) {
  const HalfEdges edges(mesh);
  run.check();
  const std::vector<std::uint8_t> none;
  Decimation decimation(mesh, edges, std::numeric_limits<double>::infinity(), none);
  decimation.run(decimation.candidates_of(edges, run), triangles, nullptr, run);
  keep_triangles(mesh, std::vector<std::uint8_t>(decimation.alive()));
  return mesh;
}

/// `kept` with more vertices and those that share a triangle with them.
std::vector<std::uint8_t> kept_with(std::vector<std::uint8_t> kept,
                                    const Mesh& mesh,
                                    const std::vector<std::uint32_t>& vertices) {
  std::vector<std::uint8_t> marked(mesh.vertices_mm.size());
  for (const std::uint32_t vertex : vertices)
    marked[vertex] = kept[vertex] = 1;
  for (const auto& [a, b, c] : mesh.triangles)
    if ((marked[a] | marked[b] | marked[c]) != 0) kept[a] = kept[b] = kept[c] = 1;
  return kept;
}

/// The vertex that each one has become part of.
std::vector<std::uint32_t> ends_of(const std::vector<CollapseStep>& steps, std::size_t vertices) {
  std::vector<std::uint32_t> ends(vertices);
  std::iota(ends.begin(), ends.end(), 0U);
  for (auto step = steps.rbegin(); step != steps.rend(); ++step)
    ends[step->b] = ends[step->a];
  return ends;
}

Mesh decimate_within(Mesh mesh, const DecimateOptions& options, const Run& run) {
  // Shares of the tolerance: of the vertices during the collapses, and of the points by which the
  // result is verified. The rest is for the surface between them.
  constexpr double kGuardedShare = 0.75;
  constexpr double kVerifiedShare = 0.85;
  constexpr int kPasses = 40;  // few suffice for scans
  constexpr int kSparing = 4;  // passes after which the surroundings stay, too
  const HalfEdges edges(mesh);
  run.check();
  const RayScene original(std::move(mesh), run);
  run.check();
  std::vector<std::uint8_t> kept(original.mesh().vertices_mm.size());
  std::vector<CollapseStep> steps;
  std::vector<std::uint8_t> changed(kept.size(), 1);  // at which edges may collapse
  CheckedSurface checked;
  for (int pass = 0; pass < kPasses; ++pass) {
    Mesh few = original.mesh();
    DistanceGuard guard(original, edges, kGuardedShare * options.tolerance_mm);
    Decimation decimation(few, edges, options.tolerance_mm, kept);
    if (pass > 0) {
      changed = decimation.repeat(steps, run);
    } else if (guard.is_fine()) {  // by far most collapses, which need no guard
      decimation.limit(guard.plain_distance_mm());
      decimation.run(decimation.candidates_of(edges, run), options.triangles, nullptr, run);
      decimation.limit(options.tolerance_mm);
    }
    guard.assign(decimation.topology(), few, ends_of(decimation.steps(), kept.size()));
    decimation.run(decimation.present_candidates(changed), options.triangles, &guard, run);
    const std::vector<std::uint32_t> beyond = guard.vertices_beyond(
        few, decimation.alive(), kVerifiedShare * options.tolerance_mm, checked, run);
    if (beyond.empty()) {
      keep_triangles(few, std::vector<std::uint8_t>(decimation.alive()));
      return few;
    }
    steps = decimation.steps();
    const bool known = std::all_of(
        beyond.begin(), beyond.end(), [&](std::uint32_t vertex) { return kept[vertex] != 0; });
    for (const std::uint32_t vertex : beyond)
      kept[vertex] = 1;
    if (known || pass >= kSparing) kept = kept_with(std::move(kept), original.mesh(), beyond);
  }
  run.warn("the mesh stays as it is: no decimation within the tolerance was found");
  return original.mesh();
}

}  // namespace

Mesh decimate(Mesh mesh, const DecimateOptions& options, const Run& run) {
  require(options.tolerance_mm > 0.0, "the tolerance of decimation must be positive");
  require(options.triangles > 0 || std::isfinite(options.tolerance_mm),
          "decimation needs a number of triangles greater than 0 or a tolerance");
  run.check();
  if (mesh.triangles.size() <= options.triangles) return mesh;
  mesh = with_manifold_edges(std::move(mesh), "decimation", run);
  mesh = std::isinf(options.tolerance_mm)
             ? decimate_to_count(std::move(mesh), options.triangles, run)
             : decimate_within(std::move(mesh), options, run);
  recompute_normals(mesh);
  return mesh;
}

}  // namespace frangia
