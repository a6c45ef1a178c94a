#include "frangia/fusion/internal/sharpen_edges.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/fusion/internal/edge_limits.h"
#include "frangia/fusion/internal/find_feature_vertices.h"
#include "frangia/fusion/internal/sharpening_plan.h"
#include "frangia/fusion/internal/split_triangle.h"
#include "frangia/uncertainty/combined_sigma.h"

namespace frangia {
namespace {

using Vertex = std::uint32_t;
using Kind = FeatureVertex::Kind;

/// Returns the pieces of a triangle with split edges, its corners at their new positions.
SplitTriangle pieces_of(const SharpeningPlan& plan, const Mesh::Triangle& triangle) {
  SplitTriangle out;
  for (std::size_t i = 0; i < 3; ++i) {
    out.points[i] = plan.target(triangle[i]);
    const EdgeSplit* split = plan.between(triangle[i], triangle[(i + 1) % 3]);
    if (split == nullptr) continue;
    out.split |= 1U << i;
    out.points[3 + i] = split->point;
  }
  constexpr unsigned kAll = 7;
  if (out.split == kAll) {
    const auto face = [&](std::size_t i) { return plan.features.at(triangle[i])->face(); };
    out.points[6] = intersect_planes({face(0), face(1), face(2)},
                                     (out.points[0] + out.points[1] + out.points[2]) / 3.0F);
  }
  triangulate(out);
  return out;
}

/// Whether a piece of a triangle deviates from the faces that the corners lie on.
bool folds(const SharpeningPlan& plan, const Mesh::Triangle& triangle) {
  constexpr float kDegenerate = 0.003F;  // twice the area, voxel^2; slivers are removed later
  const SplitTriangle cut = pieces_of(plan, triangle);
  const auto& origin = plan.mesh.vertices_mm[triangle[0]];
  const Eigen::Vector3f before = (plan.mesh.vertices_mm[triangle[1]] - origin)
                                     .cross(plan.mesh.vertices_mm[triangle[2]] - origin);
  for (std::size_t i = 0; i < cut.count; ++i) {
    const SplitTriangle::Piece& piece = cut.pieces[i];
    const Eigen::Vector3f& corner = cut.points[piece[0]];
    const Eigen::Vector3f cross =
        (cut.points[piece[1]] - corner).cross(cut.points[piece[2]] - corner);
    if (cross.norm() < kDegenerate * plan.limits.voxel_mm * plan.limits.voxel_mm) continue;
    const Eigen::Vector3f normal = cross.normalized();
    float best = -1.0F;
    bool has_normal = false;
    for (const std::uint8_t point : piece) {
      const FeatureVertex* feature = point < 3 ? plan.features.at(triangle[point]) : nullptr;
      if (feature == nullptr ||
          (cut.count == 1 && feature->target == plan.mesh.vertices_mm[triangle[point]]))
        continue;
      best = std::max(best, feature->agreement(normal));
      has_normal = true;
    }
    if (has_normal ? best < plan.limits.fold_cosine : normal.dot(before) < 0.0F) return true;
  }
  return cut.count == 6 && (cut.points[6] - cut.points[0]).norm() > plan.limits.max_corner_mm;
}

/// Drops the features of the vertices of triangles that would fold; returns whether there were any.
bool release_folding_vertices(SharpeningPlan& plan) {
  FeatureVertices& features = plan.features;
  std::vector<std::uint8_t> folded(features.vertices.size(), 0);
  parallel_chunks(folded.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto one_ring = plan.one_rings.of(features.vertices[i]);
      const auto folds_now = [&](std::uint32_t t) { return folds(plan, plan.mesh.triangles[t]); };
      folded[i] = std::any_of(one_ring.begin(), one_ring.end(), folds_now) ? 1 : 0;
    }
  });
  bool any = false;
  for (std::size_t i = 0; i < folded.size(); ++i) {
    if (folded[i] == 0 || features.features[i].kind == Kind::Unknown) continue;
    features.features[i].kind = Kind::Unknown;
    any = true;
  }
  return any;
}

/// Adds to the sigma of a vertex that it was moved onto an edge: whether an edge is sharp
/// or has a fillet or a chamfer as narrow as that, the points do not tell.
void add_move(Mesh& mesh, Vertex vertex, float moved_mm) {
  constexpr float kShare = 0.3F;  // between what sharp parts and parts with chamfers are off by
  mesh.sigma_mm[vertex] = combined_sigma(mesh.sigma_mm[vertex], kShare * moved_mm);
}

/// Adds a vertex between two others; returns its number.
Vertex add_split_vertex(Mesh& mesh, const Eigen::Vector3f& point, Vertex a, Vertex b) {
  mesh.vertices_mm.push_back(point);
  mesh.normals.emplace_back((mesh.normals[a] + mesh.normals[b]).normalized());
  for (std::vector<float>* sigma : {&mesh.sigma_mm, &mesh.sigma_systematic_mm})
    if (!sigma->empty()) sigma->push_back(std::max((*sigma)[a], (*sigma)[b]));
  mesh.views.push_back(std::min(mesh.views[a], mesh.views[b]));
  return static_cast<Vertex>(mesh.vertices_mm.size() - 1);
}

/// Applies the plan to the mesh.
void apply(const SharpeningPlan& plan, Mesh& mesh, std::vector<std::uint8_t>& sharp) {
  const auto first = static_cast<Vertex>(mesh.vertices_mm.size());
  std::vector<std::pair<std::uint32_t, SplitTriangle>> cuts;
  for (const Vertex v : plan.features.vertices) {
    for (const std::uint32_t t : plan.one_rings.of(v)) {
      const auto& corners = mesh.triangles[t];  // each triangle once: at its first feature vertex
      const auto* owner = std::find_if(corners.begin(), corners.end(), [&](Vertex corner) {
        return plan.features.index_of[corner] != FeatureVertices::kNone;
      });
      if (*owner != v) continue;
      SplitTriangle cut = pieces_of(plan, corners);
      if (cut.count > 1) cuts.emplace_back(t, cut);
    }
  }
  for (const EdgeSplit& split : plan.splits) {
    const Eigen::Vector3f middle = 0.5F * (mesh.vertices_mm[split.a] + mesh.vertices_mm[split.b]);
    add_move(
        mesh, add_split_vertex(mesh, split.point, split.a, split.b), (split.point - middle).norm());
  }
  sharp.resize(mesh.vertices_mm.size(), 1);
  for (const auto& [which, cut] : cuts) {
    const Mesh::Triangle corners = mesh.triangles[which];
    std::array<Vertex, 7> vertex{corners[0], corners[1], corners[2]};
    for (std::size_t i = 0; i < 3; ++i) {
      const EdgeSplit* split = plan.between(corners[i], corners[(i + 1) % 3]);
      if (split != nullptr) vertex[3 + i] = first + static_cast<Vertex>(split - plan.splits.data());
    }
    if (cut.count == cut.pieces.size()) {
      vertex[6] = add_split_vertex(mesh, cut.points[6], corners[0], corners[1]);
      const Eigen::Vector3f middle = (cut.points[0] + cut.points[1] + cut.points[2]) / 3.0F;
      add_move(mesh, vertex[6], (cut.points[6] - middle).norm());
      sharp.push_back(2);
    }
    for (std::size_t i = 0; i < cut.count; ++i) {
      const auto& [a, b, c] = cut.pieces[i];
      const Mesh::Triangle piece{vertex[a], vertex[b], vertex[c]};
      if (i == 0) {
        mesh.triangles[which] = piece;
      } else {
        mesh.triangles.push_back(piece);
      }
    }
  }
  for (const Vertex v : plan.features.vertices) {
    const FeatureVertex* feature = plan.features.at(v);
    if (feature == nullptr) continue;
    add_move(mesh, v, (feature->target - mesh.vertices_mm[v]).norm());
    mesh.vertices_mm[v] = feature->target;
    sharp[v] = feature->kind == Kind::Corner ? 2 : feature->kind == Kind::Edge ? 1 : 0;
  }
}

}  // namespace

std::vector<std::uint8_t> sharpen_edges(Mesh& mesh,
                                        float voxel_mm,
                                        const EdgeParameters& parameters) {
  const EdgeLimits limits(parameters, voxel_mm);
  std::vector<std::uint8_t> sharp(mesh.vertices_mm.size(), 0);
  const std::vector<std::uint32_t> chamfered = chamfer_vertices(mesh, limits);
  if (chamfered.empty()) return sharp;
  const OneRings one_rings(mesh);
  SharpeningPlan plan{
      mesh, one_rings, limits, find_feature_vertices(mesh, one_rings, chamfered, limits), {}};
  do {
    plan_splits(plan);
  } while (release_folding_vertices(plan));
  apply(plan, mesh, sharp);
  return sharp;
}

}  // namespace frangia
