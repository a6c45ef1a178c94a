#include "frangia/mesh/decimate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"
#include "frangia/geometry/half_edges.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/internal/collapse_cost.h"
#include "frangia/mesh/internal/collapse_topology.h"
#include "frangia/mesh/internal/distance_guard.h"
#include "frangia/mesh/internal/lazy_priority_queue.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

/// An edge that may go. It is out of date once either end has changed since.
struct Candidate {
  float cost = 0.0F;
  std::uint32_t a = 0, b = 0;
  std::uint32_t version = 0;

  bool operator<(const Candidate& other) const {
    if (cost != other.cost) return cost < other.cost;
    return a != other.a ? a < other.a : b < other.b;
  }
};

class Decimation {
 public:
  Decimation(Mesh& mesh, const HalfEdges& edges, double tolerance_mm)
      : mesh_(mesh),
        limit_(tolerance_mm * tolerance_mm),
        cost_(mesh, edges),
        topology_(mesh, edges),
        versions_(mesh.vertices_mm.size()) {}

  void run(const HalfEdges& edges, std::size_t target, DistanceGuard* guard, const Run& run) {
    LazyPriorityQueue<Candidate> queue(candidates_of(edges));
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
        for (const std::uint32_t v : neighbors_)
          if (const auto fresh = candidate_of(candidate->a, v)) queue.push(*fresh);
      }
      if (++steps % 65'536 == 0) {
        run.report(static_cast<double>(begin - topology_.remaining_triangles()) /
                   static_cast<double>(begin - target));
      }
    }
    keep_triangles(mesh_, topology_.alive());
  }

 private:
  [[nodiscard]] Vector3d position(std::uint32_t v) const {
    return mesh_.vertices_mm[v].cast<double>();
  }

  [[nodiscard]] std::vector<Candidate> candidates_of(const HalfEdges& edges) const {
    constexpr std::size_t kChunk = 65'536;
    std::vector<std::vector<Candidate>> found((edges.count() + kChunk - 1) / kChunk);
    parallel_chunks(edges.count(), kChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto edge = static_cast<std::uint32_t>(i);
        if (edges.has_twin(edge) && edges.twin(edge) < edge) continue;
        const auto candidate = candidate_of(source_vertex(mesh_, edge), target_vertex(mesh_, edge));
        if (candidate) found[begin / kChunk].push_back(*candidate);
      }
    });
    std::vector<Candidate> all;
    for (auto& some : found) {
      all.insert(all.end(), some.begin(), some.end());
      some = {};
    }
    return all;
  }

  [[nodiscard]] std::optional<Candidate> candidate_of(std::uint32_t a, std::uint32_t b) const {
    if (a > b) std::swap(a, b);
    if (a == b || topology_.is_fixed(a) || topology_.is_fixed(b)) return std::nullopt;
    const CollapseTarget target_mm = cost_.target(a, b);
    if (target_mm.mean_square > limit_) return std::nullopt;
    // A trace of length parts what is equally flat: short edges first.
    const double cost = target_mm.cost + 1e-12 * (position(a) - position(b)).squaredNorm();
    return Candidate{static_cast<float>(cost), a, b, versions_[a] + versions_[b]};
  }

  /// Whether they were joined; `neighbors_` are then those of a.
  bool try_collapse(std::uint32_t a, std::uint32_t b, DistanceGuard* guard) {
    // The position as the mesh will have it, so that what is checked is what is kept.
    const Vector3d target_mm = cost_.target(a, b).position.cast<float>().cast<double>();
    if (!topology_.can_collapse(a, b)) return false;
    if (!keeps_orientation(a, b, target_mm) || !keeps_orientation(b, a, target_mm)) return false;
    if (guard != nullptr) {
      if (!guard->allows(topology_, mesh_, a, b, target_mm)) return false;
      guard->accept();
    }
    collapse(a, b, target_mm);
    return true;
  }

  /// No triangle at v that stays turns over or becomes a sliver.
  [[nodiscard]] bool keeps_orientation(std::uint32_t v,
                                       std::uint32_t other,
                                       const Vector3d& target_mm) const {
    constexpr double kLeastCosine = 0.2;
    constexpr double kLeastShape = 0.02;  // of twice the area over the longest side squared
    bool unflipped = true;
    topology_.for_each_corner(v, [&](std::uint32_t corner) {
      const std::uint32_t next = topology_.at(HalfEdges::next(corner));
      const std::uint32_t last = topology_.at(HalfEdges::previous(corner));
      if (!unflipped || next == other || last == other) return;
      const Vector3d side = position(last) - position(next);
      const Vector3d before = (position(next) - position(v)).cross(side);
      const Vector3d after = (position(next) - target_mm).cross(side);
      const double longest = std::max({side.squaredNorm(),
                                       (position(next) - target_mm).squaredNorm(),
                                       (position(last) - target_mm).squaredNorm()});
      const bool turned = before.dot(after) < kLeastCosine * before.norm() * after.norm();
      const bool thin = after.norm() < kLeastShape * longest && after.norm() < before.norm();
      unflipped = !turned && !thin;
    });
    return unflipped;
  }

  void collapse(std::uint32_t a, std::uint32_t b, const Vector3d& target_mm) {
    topology_.collapse(a, b);
    cost_.collapse(a, b);
    mesh_.vertices_mm[a] = target_mm.cast<float>();
    if (!mesh_.sigma_mm.empty()) mesh_.sigma_mm[a] = std::max(mesh_.sigma_mm[a], mesh_.sigma_mm[b]);
    if (!mesh_.views.empty()) mesh_.views[a] = std::min(mesh_.views[a], mesh_.views[b]);
    if (!mesh_.vertex_marks.empty()) {
      mesh_.vertex_marks[a] = std::max(mesh_.vertex_marks[a], mesh_.vertex_marks[b]);
    }
    versions_[a] += 1 + versions_[b];
    topology_.neighbors(a, neighbors_);
  }

  Mesh& mesh_;
  double limit_;
  CollapseCost cost_;
  CollapseTopology topology_;
  std::vector<std::uint32_t> versions_;
  std::vector<std::uint32_t> neighbors_;
};

Mesh decimate_to_count(Mesh mesh, std::size_t triangles, const Run& run) {
  const HalfEdges edges(mesh);
  Decimation(mesh, edges, std::numeric_limits<double>::infinity())
      .run(edges, triangles, nullptr, run);
  return mesh;
}

Mesh decimate_within(Mesh mesh, const DecimateOptions& options, const Run& run) {
  constexpr double kCheckedShare = 0.8;  // of the tolerance: room for what lies between the points
  const HalfEdges edges(mesh);
  const RayScene original(mesh);
  DistanceGuard guard(original, edges, kCheckedShare * options.tolerance_mm);
  Decimation(mesh, edges, options.tolerance_mm).run(edges, options.triangles, &guard, run);
  return mesh;
}

}  // namespace

Mesh decimate(Mesh mesh, const DecimateOptions& options, const Run& run) {
  require(options.tolerance_mm > 0.0, "decimate: the tolerance must be positive");
  if (mesh.triangles.size() <= options.triangles) return mesh;
  mesh = std::isinf(options.tolerance_mm)
             ? decimate_to_count(std::move(mesh), options.triangles, run)
             : decimate_within(std::move(mesh), options, run);
  recompute_normals(mesh);
  return mesh;
}

}  // namespace frangia
