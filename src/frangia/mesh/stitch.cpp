#include "frangia/mesh/stitch.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/random.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/internal/are_adjacent.h"
#include "frangia/mesh/internal/steps_per_check.h"
#include "frangia/mesh/make_manifold.h"

namespace frangia {
namespace {

/// The vertices found so far in a hash grid with the tolerance as its cell size.
class PointHash {
 public:
  PointHash(const Mesh& mesh, const HalfEdges& edges, double tolerance_mm)
      : mesh_(mesh), edges_(edges), tolerance_(tolerance_mm) {}

  /// The nearest vertex within the tolerance that no edge connects to `vertex`. Without one, adds
  /// `vertex` to the grid and returns it.
  std::uint32_t find_or_add(std::uint32_t vertex) {
    const Eigen::Vector3d position = mesh_.vertices_mm[vertex].cast<double>();
    std::uint32_t best = vertex;
    double nearest = tolerance_;
    const int reach = tolerance_ > 0.0 ? 1 : 0;
    for (int x = -reach; x <= reach; ++x) {
      for (int y = -reach; y <= reach; ++y) {
        for (int z = -reach; z <= reach; ++z)
          search_cell(key_of(position, {x, y, z}), vertex, best, nearest);
      }
    }
    if (best == vertex) buckets_[key_of(position, {0, 0, 0})].push_back(vertex);
    return best;
  }

 private:
  [[nodiscard]] std::uint64_t key_of(const Eigen::Vector3d& position,
                                     const std::array<int, 3>& step) const {
    if (!(tolerance_ > 0.0)) return key_of_exact(position);
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double index =
          std::floor(position[axis] / tolerance_) + step.at(static_cast<std::size_t>(axis));
      key = hash(key, static_cast<std::uint64_t>(static_cast<std::int64_t>(index)));
    }
    return key;
  }

  /// Equal positions have equal keys: -0 becomes 0.
  [[nodiscard]] static std::uint64_t key_of_exact(const Eigen::Vector3d& position) {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis)
      key = hash(key, std::bit_cast<std::uint64_t>(position[axis] + 0.0));
    return key;
  }

  void search_cell(std::uint64_t key,
                   std::uint32_t vertex,
                   std::uint32_t& best,
                   double& nearest) const {
    const auto found = buckets_.find(key);
    if (found == buckets_.end()) return;
    for (const std::uint32_t other : found->second) {
      const auto distance =
          static_cast<double>((mesh_.vertices_mm[other] - mesh_.vertices_mm[vertex]).norm());
      const bool nearer = distance < nearest || (distance == nearest && best == vertex);
      if (!nearer || are_adjacent(mesh_, edges_, vertex, other)) continue;
      best = other;
      nearest = distance;
    }
  }

  const Mesh& mesh_;
  const HalfEdges& edges_;
  double tolerance_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> buckets_;
};

}  // namespace

Mesh stitch(Mesh mesh, double tolerance_mm, const Run& run) {
  require(tolerance_mm >= 0.0, "the tolerance of stitching must not be negative");
  const HalfEdges edges(mesh);
  std::vector<std::uint8_t> on_boundary(mesh.vertices_mm.size());
  for (std::uint32_t edge = 0; edge < edges.count(); ++edge) {
    if (!edges.is_boundary(edge)) continue;
    on_boundary[source_vertex(mesh, edge)] = 1;
    on_boundary[target_vertex(mesh, edge)] = 1;
  }
  std::vector<std::uint32_t> new_index(mesh.vertices_mm.size());
  PointHash point_hash(mesh, edges, tolerance_mm);
  bool any = false;
  for (std::uint32_t vertex = 0; vertex < new_index.size(); ++vertex) {
    if (vertex % kStepsPerCheck == 0) run.check();
    new_index[vertex] = on_boundary[vertex] != 0 ? point_hash.find_or_add(vertex) : vertex;
    any = any || new_index[vertex] != vertex;
  }
  if (!any) return mesh;
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle)
      vertex = new_index[vertex];
  }
  mesh = make_manifold(std::move(mesh), run);
  recompute_normals(mesh);
  return mesh;
}

}  // namespace frangia
