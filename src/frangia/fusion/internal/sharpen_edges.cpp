#include "frangia/fusion/internal/sharpen_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/disjoint_sets.h"
#include "frangia/core/parallel.h"
#include "frangia/fusion/internal/edge_limits.h"
#include "frangia/fusion/internal/find_feature_vertices.h"
#include "frangia/fusion/internal/remove_slivers.h"
#include "frangia/uncertainty/combined_sigma.h"

namespace frangia {
namespace {

/// A new vertex on the mesh edge between two vertices.
struct EdgeSplit {
  std::uint32_t a, b;  ///< a < b
  Eigen::Vector3f point;

  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> ends() const { return {a, b}; }
};

/// The changes that sharpen a mesh: new positions of vertices, and splits of mesh edges.
struct SharpeningPlan {
  const Mesh& mesh;
  const OneRings& one_rings;
  const EdgeLimits& limits;
  FeatureVertices features;
  std::vector<EdgeSplit> splits;  ///< ascending by their ends

  /// Returns the new position of a vertex.
  [[nodiscard]] Eigen::Vector3f target(std::uint32_t v) const;
  /// Returns the split of the mesh edge between two vertices; null without one.
  [[nodiscard]] const EdgeSplit* between(std::uint32_t a, std::uint32_t b) const;
};

using Kind = FeatureVertex::Kind;

bool is_on_edge(const FeatureVertex* feature) {
  return feature != nullptr && feature->kind != Kind::Face;
}

/// Computes the point of a split between two face vertices; returns false when their faces form no
/// edge between them, or when it is far.
bool split_edge(const SharpeningPlan& plan, EdgeSplit& split) {
  const FeatureVertex* one = plan.features.at(split.a);
  const FeatureVertex* other = plan.features.at(split.b);
  if (one == nullptr || other == nullptr || one->kind != Kind::Face || other->kind != Kind::Face ||
      !form_edge(one->face().normal(), other->face().normal(), plan.limits)) {
    return false;
  }
  const float of_one = other->face().signedDistance(one->target);
  const float of_other = one->face().signedDistance(other->target);
  if (!(of_one * of_other > 0.0F)) return false;
  const Eigen::Vector3f middle = 0.5F * (one->target + other->target);
  split.point = intersect_planes(one->face(), other->face(), middle);
  return (split.point - middle).norm() < plan.limits.max_split_mm;
}

std::vector<EdgeSplit> find_splits(const SharpeningPlan& plan) {
  std::vector<EdgeSplit> splits;
  for (const std::uint32_t v : plan.features.vertices) {
    for (const std::uint32_t t : plan.one_rings.of(v)) {
      for (const std::uint32_t other : plan.mesh.triangles[t]) {
        EdgeSplit split{v, other, Eigen::Vector3f::Zero()};
        if (v < other && split_edge(plan, split)) splits.push_back(split);
      }
    }
  }
  std::sort(splits.begin(), splits.end(), [](const EdgeSplit& x, const EdgeSplit& y) {
    return x.ends() < y.ends();
  });
  const auto same = [](const EdgeSplit& x, const EdgeSplit& y) { return x.ends() == y.ends(); };
  splits.erase(std::unique(splits.begin(), splits.end(), same), splits.end());
  return splits;
}

/// Removes edges of the object with few vertices: they are folds in a round surface.
void remove_short_edges(SharpeningPlan& plan) {
  FeatureVertices& features = plan.features;
  DisjointSets parts(features.vertices.size());
  std::vector<std::uint32_t> members(features.vertices.size(), 0);
  for (const EdgeSplit& split : plan.splits)
    members[features.index_of[split.a]] = members[features.index_of[split.b]] = 1;
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (is_on_edge(features.at(features.vertices[i]))) members[i] = 1;
  }
  const auto is_member = [&](std::uint32_t v) {
    return features.index_of[v] != FeatureVertices::kNone && members[features.index_of[v]] != 0;
  };
  for (const std::uint32_t v : features.vertices) {
    if (!is_member(v)) continue;
    for (const std::uint32_t t : plan.one_rings.of(v)) {
      for (const std::uint32_t other : plan.mesh.triangles[t]) {
        if (is_member(other)) parts.join(features.index_of[v], features.index_of[other]);
      }
    }
  }
  std::vector<std::uint32_t> lengths(members.size(), 0);
  for (std::uint32_t i = 0; i < members.size(); ++i)
    lengths[parts.find(i)] += members[i];
  for (std::uint32_t i = 0; i < members.size(); ++i) {
    if (members[i] != 0 && lengths[parts.find(i)] < plan.limits.min_edge_vertices)
      features.features[i].kind = Kind::Unknown;
  }
  const auto is_removed = [&](const EdgeSplit& split) {
    return plan.features.at(split.a) == nullptr;
  };
  plan.splits.erase(std::remove_if(plan.splits.begin(), plan.splits.end(), is_removed),
                    plan.splits.end());
}

/// Keeps the measured position of face vertices next to no split.
void keep_unsplit_vertices(SharpeningPlan& plan) {
  std::vector<bool> moves(plan.features.vertices.size(), false);
  for (const EdgeSplit& split : plan.splits)
    moves[plan.features.index_of[split.a]] = moves[plan.features.index_of[split.b]] = true;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    FeatureVertex& feature = plan.features.features[i];
    if (feature.kind == Kind::Face && !moves[i])
      feature.target = plan.mesh.vertices_mm[plan.features.vertices[i]];
  }
}

Eigen::Vector3f SharpeningPlan::target(std::uint32_t v) const {
  const FeatureVertex* feature = features.at(v);
  return feature == nullptr ? mesh.vertices_mm[v] : feature->target;
}

const EdgeSplit* SharpeningPlan::between(std::uint32_t a, std::uint32_t b) const {
  const std::pair ends{std::min(a, b), std::max(a, b)};
  const auto found = std::lower_bound(
      splits.begin(), splits.end(), ends, [](const EdgeSplit& split, const auto& wanted) {
        return split.ends() < wanted;
      });
  return found != splits.end() && found->ends() == ends ? &*found : nullptr;
}

/// Plans the splits for the plan's features.
///
/// Edges of the object with fewer than `min_edge_vertices` are removed, with their features. Face
/// vertices next to no split keep their measured position.
void plan_splits(SharpeningPlan& plan) {
  plan.splits = find_splits(plan);
  remove_short_edges(plan);
  keep_unsplit_vertices(plan);
}

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

namespace {

/// How far the vertices beside each lie from its tangent plane.
struct Rise {
  float most_mm = 0.0F;
  float steepest = 0.0F;  ///< sine of the angle that one of them is seen under
};

std::vector<Rise> rises_of(const Mesh& mesh) {
  std::vector<Rise> rises(mesh.vertices_mm.size());
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = triangle.at(i);
      for (std::size_t other = 1; other < 3; ++other) {
        const std::uint32_t beside = triangle.at((i + other) % 3);
        const Eigen::Vector3f way = mesh.vertices_mm[beside] - mesh.vertices_mm[v];
        const float rise = std::abs(mesh.normals[v].dot(way));
        rises[v].most_mm = std::max(rises[v].most_mm, rise);
        const float length = way.norm();
        if (length > 0.0F) rises[v].steepest = std::max(rises[v].steepest, rise / length);
      }
    }
  }
  return rises;
}

/// What counts of a bend of one face. The surface is off by 0 to angle * edge / 4, evenly
/// distributed, which is rise / 2; at a step anywhere within the rise.
float counted(float bend_mm, const Rise& rise) {
  constexpr float kOfRise = 0.1443F;  // 1 / 2 / sqrt(12)
  constexpr float kOfStep = 0.2887F;  // 1 / sqrt(12)
  constexpr float kStep = 0.26F;      // sine of 15 degrees: beyond, the planes are not one face
  if (rise.steepest > kStep) return std::max(bend_mm, kOfStep * rise.most_mm);
  return std::min(bend_mm, kOfRise * rise.most_mm);
}

}  // namespace

void settle_bends(PlacedVertices& vertices, std::span<const std::uint8_t> on_edge) {
  Mesh& mesh = vertices.mesh;
  const std::vector<Rise> rises = rises_of(mesh);
  for (std::size_t v = 0; v < vertices.bend_mm.size(); ++v) {
    if (vertices.sharp[v] != 0 || on_edge[v] != 0) continue;
    const float bend = vertices.bend_mm[v];
    const float counts = counted(bend, rises[v]);
    float& sigma = mesh.sigma_mm[v];
    sigma = std::sqrt(std::max(0.0F, sigma * sigma - bend * bend) + counts * counts);
  }
}

}  // namespace frangia
