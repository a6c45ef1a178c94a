#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/mesh/fair_patch.h"
#include "frangia/mesh/fill_polygon.h"
#include "frangia/mesh/hole_patch.h"
#include "frangia/mesh/patch_mesh.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Rim = std::vector<std::uint32_t>;

constexpr double kWidening = 0.2;       // how much edges grow on the way inwards, for the shape
constexpr double kMostTriangles = 2e6;  // of one patch; larger ones get coarser inwards

/// How long edges at a vertex should be, and how far it is from the rim.
struct Spacing {
  double edge_mm = 0.0;
  double inwards_mm = 0.0;
};

Vector3d place_of(const Mesh& mesh, std::uint32_t vertex) {
  return mesh.vertices_mm[vertex].cast<double>();
}

PatchSurroundings surroundings_of(const Mesh& mesh, const HalfEdges& edges, const Rim& rim) {
  PatchSurroundings around;
  std::unordered_map<std::uint32_t, std::uint32_t> number;
  for (std::size_t i = 0; i < rim.size(); ++i)
    number.emplace(rim[i], static_cast<std::uint32_t>(i));
  std::vector<std::uint32_t> triangles;
  for (const std::uint32_t vertex : rim)
    for (const std::uint32_t edge : edges.leaving(vertex))
      triangles.push_back(edge / 3);
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  for (const std::uint32_t t : triangles) {
    Mesh::Triangle named{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t vertex = mesh.triangles[t].at(i);
      const auto fresh = static_cast<std::uint32_t>(rim.size() + around.outer_mm.size());
      const auto [place, is_new] = number.emplace(vertex, fresh);
      if (is_new) around.outer_mm.push_back(place_of(mesh, vertex));
      named.at(i) = place->second;
    }
    around.triangles.push_back(named);
  }
  return around;
}

/// The direction of the surface around each corner of the rim, evened out along it.
std::vector<Vector3d> rim_normals(const std::vector<Vector3d>& rim_mm,
                                  const PatchSurroundings& around) {
  constexpr int kRounds = 10;
  const auto place = [&](std::uint32_t v) {
    return v < rim_mm.size() ? rim_mm[v] : around.outer_mm[v - rim_mm.size()];
  };
  std::vector<Vector3d> normals(rim_mm.size(), Vector3d::Zero());
  for (const auto& [a, b, c] : around.triangles) {
    const Vector3d cross = (place(b) - place(a)).cross(place(c) - place(a));
    for (const std::uint32_t v : {a, b, c})
      if (v < rim_mm.size()) normals[v] += cross;
  }
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Vector3d> from = normals;
    for (std::size_t i = 0; i < from.size(); ++i)
      normals[i] += from[(i + 1) % from.size()] + from[(i + from.size() - 1) % from.size()];
  }
  return normals;
}

/// The mean length of the edges at each corner of the rim, within twice of the usual.
std::vector<Spacing> spacing_of(const Mesh& mesh, const HalfEdges& edges, const Rim& rim) {
  std::vector<Spacing> spacing;
  std::vector<double> lengths;
  for (const std::uint32_t vertex : rim) {
    double sum = 0.0;
    for (const std::uint32_t edge : edges.leaving(vertex)) {
      sum += (place_of(mesh, to_of(mesh, edge)) - place_of(mesh, vertex)).norm();
      sum += (place_of(mesh, across_of(mesh, edge)) - place_of(mesh, vertex)).norm();
    }
    const auto count = static_cast<double>(2 * edges.leaving(vertex).size());
    spacing.push_back({sum / std::max(count, 1.0), 0.0});
    lengths.push_back(spacing.back().edge_mm);
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  for (Spacing& one : spacing)
    one.edge_mm = std::clamp(one.edge_mm, 0.5 * *middle, 2.0 * *middle);
  return spacing;
}

/// Makes a patch denser, first coarsely for the shape, then as the surface around is.
class Refinement {
 public:
  Refinement(PatchMesh& patch, std::vector<Spacing> spacing)
      : patch_(patch), spacing_(std::move(spacing)) {}

  /// Puts a vertex into each triangle that is large for its corners, until none is.
  /// source  Liepa 2003, Filling Holes in Meshes
  void coarsely() {
    for (std::uint32_t begin = patch_.count() + 1; begin != patch_.count();) {
      begin = patch_.count();
      const std::uint32_t triangles = patch_.half_edges() / 3;
      for (std::uint32_t t = 0; t < triangles; ++t)
        split_if_large(t);
    }
  }

  /// Cuts edges that are longer than those around the rim, along the curve between their ends.
  void finely(const PatchSurroundings& around) {
    const double coarser = coarser_than_around();
    for (std::uint32_t begin = patch_.count() + 1; begin != patch_.count();) {
      begin = patch_.count();
      const std::vector<Vector3d> normals = normals_of(patch_, around);
      const std::uint32_t edges = patch_.half_edges();
      for (std::uint32_t edge = 0; edge < edges; ++edge)
        split_if_long(edge, normals, coarser);
    }
  }

 private:
  [[nodiscard]] double wide(const Spacing& at) const {
    return at.edge_mm + kWidening * at.inwards_mm;
  }

  void split_if_large(std::uint32_t triangle) {
    const std::array<std::uint32_t, 3> corners{
        patch_.from(3 * triangle), patch_.from(3 * triangle + 1), patch_.from(3 * triangle + 2)};
    Vector3d middle = Vector3d::Zero();
    for (const std::uint32_t corner : corners)
      middle += patch_.place(corner) / 3.0;
    Spacing mean{0.0, INFINITY};
    for (const std::uint32_t corner : corners) {
      const double away = (patch_.place(corner) - middle).norm();
      mean.edge_mm += spacing_[corner].edge_mm / 3.0;
      mean.inwards_mm = std::min(mean.inwards_mm, spacing_[corner].inwards_mm + away);
    }
    for (const std::uint32_t corner : corners) {
      const double away = std::sqrt(2.0) * (patch_.place(corner) - middle).norm();
      if (!(away > wide(mean)) || !(away > wide(spacing_[corner]))) return;
    }
    patch_.split_triangle(triangle, middle);
    spacing_.push_back(mean);
  }

  /// How many times longer edges must be than around the rim to keep the patch's size in bounds.
  [[nodiscard]] double coarser_than_around() const {
    double triangles = 0.0;
    for (std::uint32_t edge = 0; edge < patch_.half_edges(); edge += 3) {
      const Vector3d& a = patch_.place(patch_.from(edge));
      const Vector3d& b = patch_.place(patch_.from(edge + 1));
      const Vector3d& c = patch_.place(patch_.from(edge + 2));
      const double side = spacing_[patch_.from(edge)].edge_mm;
      triangles += 0.5 * (b - a).cross(c - a).norm() / (std::sqrt(0.1875) * side * side);
    }
    return std::max(1.0, std::sqrt(triangles / kMostTriangles));
  }

  void split_if_long(std::uint32_t edge, const std::vector<Vector3d>& normals, double coarser) {
    constexpr double kLong = 1.4;  // halves are then as much too short as the whole was too long
    const std::uint32_t a = patch_.from(edge);
    const std::uint32_t b = patch_.to(edge);
    if (patch_.twin(edge) == PatchMesh::kRim || a >= normals.size() || b >= normals.size()) return;
    const Vector3d way = patch_.place(b) - patch_.place(a);
    const double length = way.norm();
    const Spacing mean{0.5 * (spacing_[a].edge_mm + spacing_[b].edge_mm),
                       0.5 * (spacing_[a].inwards_mm + spacing_[b].inwards_mm)};
    const double allowed = std::min(coarser * mean.edge_mm, wide(mean));
    if (!(length > kLong * allowed)) return;
    const Vector3d leaving = way - normals[a] * normals[a].dot(way);
    const Vector3d arriving = way - normals[b] * normals[b].dot(way);
    Vector3d bulge = (leaving - arriving) / 8.0;
    if (bulge.norm() > 0.15 * length) bulge *= 0.15 * length / bulge.norm();
    patch_.split_edge(edge, patch_.place(a) + 0.5 * way + bulge);
    spacing_.push_back(mean);
  }

  PatchMesh& patch_;
  std::vector<Spacing> spacing_;
};

/// Cuts what the mesh would otherwise have twice: chords between corners of the rim that it joins.
void cut_doubled_edges(PatchMesh& patch, const PatchMesh::Joined& joined) {
  const std::uint32_t edges = patch.half_edges();
  for (std::uint32_t edge = 0; edge < edges; ++edge) {
    const std::uint32_t a = patch.from(edge);
    const std::uint32_t b = patch.to(edge);
    if (a >= patch.rim() || b >= patch.rim() || patch.twin(edge) == PatchMesh::kRim) continue;
    if (joined(a, b)) patch.split_edge(edge, 0.5 * (patch.place(a) + patch.place(b)));
  }
}

HolePatch hole_patch_of(const PatchMesh& patch, const Rim& rim, std::size_t mesh_vertices) {
  HolePatch result;
  for (std::uint32_t v = patch.rim(); v < patch.count(); ++v) {
    result.places_mm.emplace_back(patch.place(v).cast<float>());
  }
  const auto vertex_of = [&](std::uint32_t v) {
    return v < patch.rim() ? rim[v] : static_cast<std::uint32_t>(mesh_vertices + v - patch.rim());
  };
  for (std::uint32_t edge = 0; edge < patch.half_edges(); edge += 3)
    result.triangles.push_back({vertex_of(patch.from(edge)),
                                vertex_of(patch.from(edge + 1)),
                                vertex_of(patch.from(edge + 2))});
  return result;
}

}  // namespace

HolePatch smooth_patch(const Mesh& mesh, const HalfEdges& edges, const Rim& boundary) {
  if (boundary.size() < 3) return {};
  Rim rim(boundary.rbegin(), boundary.rend());  // the patch runs against the mesh's boundary
  const auto joined = [&](std::size_t a, std::size_t b) {
    for (const std::uint32_t edge : edges.leaving(rim[a]))
      if (to_of(mesh, edge) == rim[b] || across_of(mesh, edge) == rim[b]) return true;
    return false;
  };
  std::vector<Vector3d> places;
  for (const std::uint32_t vertex : rim)
    places.push_back(place_of(mesh, vertex));
  const PatchSurroundings around = surroundings_of(mesh, edges, rim);
  const auto triangles =
      fill_polygon(places, {.normals = rim_normals(places, around), .barred = joined});
  PatchMesh patch(std::move(places), triangles, joined);
  cut_doubled_edges(patch, joined);
  patch.settle();
  std::vector<Spacing> spacing = spacing_of(mesh, edges, rim);
  while (spacing.size() < patch.count())
    spacing.push_back(spacing.front());
  Refinement refinement(patch, std::move(spacing));
  refinement.coarsely();
  if (!fair_patch(patch, around)) return {};
  refinement.finely(around);
  return hole_patch_of(patch, rim, mesh.vertices_mm.size());
}

}  // namespace frangia
