#include "frangia/mesh/orient.h"

#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/geometry/half_edges.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

/// The other triangles at an edge, and whether they are wound against the edge's own.
struct Neighbor {
  std::uint32_t triangle;
  bool opposite;
};

std::vector<Neighbor> neighbors(const Mesh& mesh, const HalfEdges& edges, std::uint32_t edge) {
  if (edges.is_boundary(edge)) return {};
  if (edges.has_twin(edge)) return {{edges.twin(edge) / 3, false}};
  const std::uint32_t from = source_vertex(mesh, edge);
  const std::uint32_t to = target_vertex(mesh, edge);
  std::vector<Neighbor> found;
  for (const std::uint32_t e : edges.outgoing(from))
    if (e != edge && target_vertex(mesh, e) == to) found.push_back({e / 3, true});
  for (const std::uint32_t e : edges.outgoing(to))
    if (target_vertex(mesh, e) == from) found.push_back({e / 3, false});
  if (found.size() > 1) found.clear();  // where many meet none can say which continues
  return found;
}

struct Part {
  std::vector<std::uint32_t> triangles;
  bool closed = true;
  double volume_mm3 = 0.0;      ///< six times, of the part as turned
  double area_as_it_was = 0.0;  ///< of the triangles that were not turned
  double area_turned = 0.0;
};

class OrientationPropagation {
 public:
  explicit OrientationPropagation(const Mesh& mesh)
      : mesh_(mesh), edges_(mesh), state_(mesh.triangles.size(), State::Unknown) {}

  std::vector<bool> flipped() {
    std::vector<bool> result(mesh_.triangles.size());
    for (std::uint32_t seed = 0; seed < mesh_.triangles.size(); ++seed) {
      if (state_[seed] != State::Unknown) continue;
      const Part part = walk(seed);
      const bool turn_all =
          part.closed ? part.volume_mm3 < 0.0 : part.area_turned > part.area_as_it_was;
      for (const std::uint32_t t : part.triangles)
        result[t] = (state_[t] == State::Flipped) != turn_all;
    }
    return result;
  }

 private:
  enum class State : std::uint8_t { Unknown, Kept, Flipped };

  Part walk(std::uint32_t seed) {
    Part part;
    state_[seed] = State::Kept;
    part.triangles.push_back(seed);
    for (std::size_t i = 0; i < part.triangles.size(); ++i) {
      const std::uint32_t t = part.triangles[i];
      weigh(t, part);
      for (std::uint32_t edge = 3 * t; edge < 3 * t + 3; ++edge) {
        const auto adjacent = neighbors(mesh_, edges_, edge);
        part.closed = part.closed && !adjacent.empty();
        for (const Neighbor& neighbor : adjacent) {
          if (state_[neighbor.triangle] != State::Unknown) continue;
          const bool turn = (state_[t] == State::Flipped) != neighbor.opposite;
          state_[neighbor.triangle] = turn ? State::Flipped : State::Kept;
          part.triangles.push_back(neighbor.triangle);
        }
      }
    }
    return part;
  }

  void weigh(std::uint32_t t, Part& part) const {
    const Eigen::Vector3d a = mesh_.vertices_mm[mesh_.triangles[t][0]].cast<double>();
    const Eigen::Vector3d b = mesh_.vertices_mm[mesh_.triangles[t][1]].cast<double>();
    const Eigen::Vector3d c = mesh_.vertices_mm[mesh_.triangles[t][2]].cast<double>();
    const bool is_turned = state_[t] == State::Flipped;
    part.volume_mm3 += (is_turned ? -1.0 : 1.0) * a.dot(b.cross(c));
    (is_turned ? part.area_turned : part.area_as_it_was) += (b - a).cross(c - a).norm();
  }

  const Mesh& mesh_;
  HalfEdges edges_;
  std::vector<State> state_;
};

}  // namespace

Mesh orient(Mesh mesh) {
  const std::vector<bool> flipped = OrientationPropagation(mesh).flipped();
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
