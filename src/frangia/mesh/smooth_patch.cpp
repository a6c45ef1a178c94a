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
#include "frangia/mesh/refine_patch.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Rim = std::vector<std::uint32_t>;

Vector3d place_of(const Mesh& mesh, std::uint32_t vertex) {
  return mesh.vertices_mm[vertex].cast<double>();
}

PatchSurroundings surroundings_of(const Mesh& mesh, const HalfEdges& edges, const Rim& rim) {
  PatchSurroundings around;
  std::unordered_map<std::uint32_t, std::uint32_t> number;
  for (std::size_t i = 0; i < rim.size(); ++i)
    number.emplace(rim[i], static_cast<std::uint32_t>(i));
  std::vector<std::uint32_t> triangles;
  for (const std::uint32_t vertex : rim) {
    for (const std::uint32_t edge : edges.leaving(vertex))
      triangles.push_back(edge / 3);
  }
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
std::vector<PatchSpacing> spacing_of(const Mesh& mesh, const HalfEdges& edges, const Rim& rim) {
  std::vector<PatchSpacing> spacing;
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
  for (PatchSpacing& one : spacing)
    one.edge_mm = std::clamp(one.edge_mm, 0.5 * *middle, 2.0 * *middle);
  return spacing;
}

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
  for (std::uint32_t edge = 0; edge < patch.half_edges(); edge += 3) {
    result.triangles.push_back({vertex_of(patch.from(edge)),
                                vertex_of(patch.from(edge + 1)),
                                vertex_of(patch.from(edge + 2))});
  }
  return result;
}

}  // namespace

HolePatch smooth_patch(const Mesh& mesh,
                       const HalfEdges& edges,
                       const Rim& boundary,
                       const SmoothPatchOptions& options) {
  if (boundary.size() < 3) return {};
  Rim rim(boundary.rbegin(), boundary.rend());  // the patch runs against the mesh's boundary
  const auto joined = [&](std::size_t a, std::size_t b) {
    const auto leaving = edges.leaving(rim[a]);
    return std::any_of(leaving.begin(), leaving.end(), [&](std::uint32_t edge) {
      return to_of(mesh, edge) == rim[b] || across_of(mesh, edge) == rim[b];
    });
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
  std::vector<PatchSpacing> spacing = spacing_of(mesh, edges, rim);
  while (spacing.size() < patch.count())
    spacing.push_back(spacing.front());
  PatchRefinement refinement(patch, std::move(spacing));
  if (!refinement.coarsely() || !fair_patch(patch, around, options.curvature)) return {};
  if (!options.coarse && !refinement.finely(around, options.curvature)) return {};
  return hole_patch_of(patch, rim, mesh.vertices_mm.size());
}

}  // namespace frangia
