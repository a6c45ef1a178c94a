#include "frangia/mesh/orient.h"

#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/geometry/connectivity.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/mesh/internal/steps_per_check.h"

namespace frangia {
namespace {

/// Another triangle at an edge and whether its orientation is inconsistent with the first one.
struct Neighbor {
  std::uint32_t triangle;
  bool opposite;
};

/// The triangle that continues the surface beyond an edge; none at a boundary, and none where three
/// or more triangles share the edge, since which one continues is ambiguous.
std::vector<Neighbor> neighbors(const Mesh& mesh, const HalfEdges& edges, std::uint32_t edge) {
  if (edges.is_boundary(edge)) return {};
  if (edges.has_twin(edge)) return {{edges.twin(edge) / 3, false}};
  const std::uint32_t from = source_vertex(mesh, edge);
  const std::uint32_t to = target_vertex(mesh, edge);
  std::vector<Neighbor> found;
  for (const std::uint32_t e : edges.outgoing(from)) {
    if (e == edge || target_vertex(mesh, e) != to) continue;
    found.push_back({e / 3, true});
    if (found.size() > 1) return {};
  }
  for (const std::uint32_t e : edges.outgoing(to)) {
    if (target_vertex(mesh, e) != from) continue;
    found.push_back({e / 3, false});
    if (found.size() > 1) return {};
  }
  return found;
}

struct OrientedComponent {
  std::vector<std::uint32_t> triangles;
  bool closed = true;
  double volume_mm3 = 0.0;  ///< six times the signed volume after reorientation
  double area_kept = 0.0;   ///< twice the area of the triangles that keep their orientation
  double area_flipped = 0.0;
};

class OrientationPropagation {
 public:
  explicit OrientationPropagation(const Mesh& mesh)
      : mesh_(mesh), edges_(mesh), state_(mesh.triangles.size(), State::Unknown) {}

  std::vector<bool> flipped(const Run& run) {
    std::vector<bool> result(mesh_.triangles.size());
    for (std::uint32_t seed = 0; seed < mesh_.triangles.size(); ++seed) {
      if (state_[seed] != State::Unknown) continue;
      const OrientedComponent component = walk(seed, run);
      const bool flip_all = component.closed ? component.volume_mm3 < 0.0
                                             : component.area_flipped > component.area_kept;
      for (const std::uint32_t t : component.triangles)
        result[t] = (state_[t] == State::Flipped) != flip_all;
    }
    return result;
  }

 private:
  enum class State : std::uint8_t { Unknown, Kept, Flipped };

  OrientedComponent walk(std::uint32_t seed, const Run& run) {
    OrientedComponent component;
    state_[seed] = State::Kept;
    component.triangles.push_back(seed);
    for (std::size_t i = 0; i < component.triangles.size(); ++i) {
      if (i % kStepsPerCheck == 0) run.check();
      const std::uint32_t t = component.triangles[i];
      add_triangle(t, component);
      for (std::uint32_t edge = 3 * t; edge < 3 * t + 3; ++edge) {
        const auto adjacent = neighbors(mesh_, edges_, edge);
        component.closed = component.closed && !adjacent.empty();
        for (const Neighbor& neighbor : adjacent) {
          if (state_[neighbor.triangle] != State::Unknown) continue;
          const bool flip = (state_[t] == State::Flipped) != neighbor.opposite;
          state_[neighbor.triangle] = flip ? State::Flipped : State::Kept;
          component.triangles.push_back(neighbor.triangle);
        }
      }
    }
    return component;
  }

  void add_triangle(std::uint32_t t, OrientedComponent& component) const {
    const Eigen::Vector3d a = mesh_.vertices_mm[mesh_.triangles[t][0]].cast<double>();
    const Eigen::Vector3d b = mesh_.vertices_mm[mesh_.triangles[t][1]].cast<double>();
    const Eigen::Vector3d c = mesh_.vertices_mm[mesh_.triangles[t][2]].cast<double>();
    const bool is_flipped = state_[t] == State::Flipped;
    component.volume_mm3 += (is_flipped ? -1.0 : 1.0) * a.dot(b.cross(c));
    (is_flipped ? component.area_flipped : component.area_kept) += (b - a).cross(c - a).norm();
  }

  const Mesh& mesh_;
  HalfEdges edges_;
  std::vector<State> state_;
};

}  // namespace

Mesh orient(Mesh mesh, const Run& run) {
  run.check();
  const std::vector<bool> flipped = OrientationPropagation(mesh).flipped(run);
  bool any = false;
  for (std::size_t i = 0; i < flipped.size(); ++i) {
    if (!flipped[i]) continue;
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    any = true;
  }
  if (any) recompute_normals(mesh);
  return mesh;
}

Mesh reverse_orientation(Mesh mesh) {
  for (auto& triangle : mesh.triangles)
    std::swap(triangle[1], triangle[2]);
  for (auto& normal : mesh.normals)
    normal = -normal;
  return mesh;
}

}  // namespace frangia
