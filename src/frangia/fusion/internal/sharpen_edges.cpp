#include "frangia/fusion/internal/sharpen_edges.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <Eigen/Geometry>

#include "frangia/core/disjoint_sets.h"
#include "frangia/core/parallel.h"
#include "frangia/fusion/internal/find_feature_vertices.h"
#include "frangia/fusion/internal/split_triangle.h"

namespace frangia {
namespace {

using Vertex = std::uint32_t;
using Kind = FeatureVertex::Kind;

/// A vertex that the edge between two others is to get.
struct Split {
  Vertex a, b;  ///< a < b
  Eigen::Vector3f point;

  [[nodiscard]] std::pair<Vertex, Vertex> ends() const { return {a, b}; }
};

/// What is to become of a mesh: where its vertices go, and which of its edges are split.
struct Plan {
  const Mesh& mesh;
  const OneRings& one_rings;
  float voxel_mm;
  FeatureVertices features;
  std::vector<Split> splits;  ///< by their ends

  [[nodiscard]] Eigen::Vector3f target(Vertex v) const {
    const FeatureVertex* feature = features.at(v);
    return feature == nullptr ? mesh.vertices_mm[v] : feature->target;
  }
  [[nodiscard]] bool is_on_edge(Vertex v) const {
    const FeatureVertex* feature = features.at(v);
    return feature != nullptr && feature->kind != Kind::Face;
  }
  [[nodiscard]] const Split* between(Vertex a, Vertex b) const {
    const std::pair<Vertex, Vertex> ends{std::min(a, b), std::max(a, b)};
    const auto found = std::lower_bound(
        splits.begin(), splits.end(), ends, [](const Split& split, const auto& wanted) {
          return split.ends() < wanted;
        });
    return found != splits.end() && found->ends() == ends ? &*found : nullptr;
  }
};

/// Where the edge from one face to another gets a vertex on the edge of the object; false when the
/// faces make none between, or it is far.
bool split_edge(const Plan& plan, Split& split) {
  constexpr float kFarthest = 1.2F;  // voxels
  const FeatureVertex* one = plan.features.at(split.a);
  const FeatureVertex* other = plan.features.at(split.b);
  if (one == nullptr || other == nullptr || one->kind != Kind::Face || other->kind != Kind::Face ||
      !form_edge(one->face().normal(), other->face().normal())) {
    return false;
  }
  const float of_one = other->face().signedDistance(one->target);
  const float of_other = one->face().signedDistance(other->target);
  if (!(of_one * of_other > 0.0F)) return false;
  const Eigen::Vector3f middle = 0.5F * (one->target + other->target);
  split.point = intersect_planes(one->face(), other->face(), middle);
  return (split.point - middle).norm() < kFarthest * plan.voxel_mm;
}

std::vector<Split> find_splits(const Plan& plan) {
  std::vector<Split> splits;
  for (const Vertex v : plan.features.vertices) {
    for (const std::uint32_t t : plan.one_rings.of(v)) {
      for (const Vertex other : plan.mesh.triangles[t]) {
        Split split{v, other, Eigen::Vector3f::Zero()};
        if (v < other && split_edge(plan, split)) splits.push_back(split);
      }
    }
  }
  std::sort(splits.begin(), splits.end(), [](const Split& x, const Split& y) {
    return x.ends() < y.ends();
  });
  const auto same = [](const Split& x, const Split& y) { return x.ends() == y.ends(); };
  splits.erase(std::unique(splits.begin(), splits.end(), same), splits.end());
  return splits;
}

/// An edge of the object runs on: what makes few steps only is a fold in something round.
void remove_short_edges(Plan& plan) {
  constexpr std::uint32_t kFewest = 24;
  FeatureVertices& features = plan.features;
  DisjointSets parts(features.vertices.size());
  std::vector<std::uint32_t> steps(features.vertices.size(), 0);
  for (const Split& split : plan.splits)
    steps[features.index_of[split.a]] = steps[features.index_of[split.b]] = 1;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (plan.is_on_edge(features.vertices[i])) steps[i] = 1;
  }
  const auto is_step = [&](Vertex v) {
    return features.index_of[v] != FeatureVertices::kNone && steps[features.index_of[v]] != 0;
  };
  for (const Vertex v : features.vertices) {
    if (!is_step(v)) continue;
    for (const std::uint32_t t : plan.one_rings.of(v)) {
      for (const Vertex other : plan.mesh.triangles[t]) {
        if (is_step(other)) parts.join(features.index_of[v], features.index_of[other]);
      }
    }
  }
  std::vector<std::uint32_t> lengths(steps.size(), 0);
  for (std::uint32_t i = 0; i < steps.size(); ++i)
    lengths[parts.find(i)] += steps[i];
  for (std::uint32_t i = 0; i < steps.size(); ++i) {
    if (steps[i] != 0 && lengths[parts.find(i)] < kFewest)
      features.features[i].kind = Kind::Unknown;
  }
  const auto is_removed = [&](const Split& split) { return plan.features.at(split.a) == nullptr; };
  plan.splits.erase(std::remove_if(plan.splits.begin(), plan.splits.end(), is_removed),
                    plan.splits.end());
}

/// What no edge of the object runs past stays where it was measured.
void keep_unsplit_vertices(Plan& plan) {
  std::vector<bool> moves(plan.features.vertices.size(), false);
  for (const Split& split : plan.splits)
    moves[plan.features.index_of[split.a]] = moves[plan.features.index_of[split.b]] = true;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    FeatureVertex& feature = plan.features.features[i];
    if (feature.kind == Kind::Face && !moves[i])
      feature.target = plan.mesh.vertices_mm[plan.features.vertices[i]];
  }
}

/// A triangle cut where its edges are split, the vertices where they are to go.
SplitTriangle pieces_of(const Plan& plan, const Mesh::Triangle& triangle) {
  SplitTriangle out;
  for (std::size_t i = 0; i < 3; ++i) {
    out.points[i] = plan.target(triangle[i]);
    const Split* split = plan.between(triangle[i], triangle[(i + 1) % 3]);
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

/// Whether a triangle, as it would become, turns against the faces that its corners are on.
bool folds(const Plan& plan, const Mesh::Triangle& triangle) {
  constexpr float kNothing = 0.003F;  // voxels squared: slivers are collapsed
  constexpr float kAgrees = 0.5F;
  constexpr float kFarthest = 3.0F;  // voxels
  const SplitTriangle cut = pieces_of(plan, triangle);
  const auto& origin = plan.mesh.vertices_mm[triangle[0]];
  const Eigen::Vector3f before = (plan.mesh.vertices_mm[triangle[1]] - origin)
                                     .cross(plan.mesh.vertices_mm[triangle[2]] - origin);
  for (std::size_t i = 0; i < cut.count; ++i) {
    const SplitTriangle::Piece& piece = cut.pieces[i];
    const Eigen::Vector3f& corner = cut.points[piece[0]];
    const Eigen::Vector3f cross =
        (cut.points[piece[1]] - corner).cross(cut.points[piece[2]] - corner);
    if (cross.norm() < kNothing * plan.voxel_mm * plan.voxel_mm) continue;
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
    if (has_normal ? best < kAgrees : normal.dot(before) < 0.0F) return true;
  }
  return cut.count == 6 && (cut.points[6] - cut.points[0]).norm() > kFarthest * plan.voxel_mm;
}

/// Lets go of the vertices of triangles that would fold; returns whether there were any.
bool release_folding_vertices(Plan& plan) {
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

/// Adds a vertex between two others; returns its number.
Vertex add_vertex(Mesh& mesh, const Eigen::Vector3f& point, Vertex a, Vertex b) {
  mesh.vertices_mm.push_back(point);
  mesh.normals.emplace_back((mesh.normals[a] + mesh.normals[b]).normalized());
  mesh.sigma_mm.push_back(std::max(mesh.sigma_mm[a], mesh.sigma_mm[b]));
  mesh.views.push_back(std::min(mesh.views[a], mesh.views[b]));
  return static_cast<Vertex>(mesh.vertices_mm.size() - 1);
}

/// Does what is planned.
void apply(const Plan& plan, Mesh& mesh, std::vector<std::uint8_t>& sharp) {
  const auto first = static_cast<Vertex>(mesh.vertices_mm.size());
  std::vector<std::pair<std::uint32_t, SplitTriangle>> cuts;
  for (const Vertex v : plan.features.vertices) {
    for (const std::uint32_t t : plan.one_rings.of(v)) {
      const auto& corners = mesh.triangles[t];  // each once: by its first corner that has a spot
      const auto* owner = std::find_if(corners.begin(), corners.end(), [&](Vertex corner) {
        return plan.features.index_of[corner] != FeatureVertices::kNone;
      });
      if (*owner != v) continue;
      SplitTriangle cut = pieces_of(plan, corners);
      if (cut.count > 1) cuts.emplace_back(t, cut);
    }
  }
  for (const Split& split : plan.splits)
    add_vertex(mesh, split.point, split.a, split.b);
  sharp.resize(mesh.vertices_mm.size(), 1);
  for (const auto& [which, cut] : cuts) {
    const Mesh::Triangle corners = mesh.triangles[which];
    std::array<Vertex, 7> vertex{corners[0], corners[1], corners[2]};
    for (std::size_t i = 0; i < 3; ++i) {
      const Split* split = plan.between(corners[i], corners[(i + 1) % 3]);
      if (split != nullptr) vertex[3 + i] = first + static_cast<Vertex>(split - plan.splits.data());
    }
    if (cut.count == cut.pieces.size()) {
      vertex[6] = add_vertex(mesh, cut.points[6], corners[0], corners[1]);
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
    mesh.vertices_mm[v] = feature->target;
    sharp[v] = feature->kind == Kind::Corner ? 2 : feature->kind == Kind::Edge ? 1 : 0;
  }
}

}  // namespace

std::vector<std::uint8_t> sharpen_edges(Mesh& mesh, float voxel_mm) {
  std::vector<std::uint8_t> sharp(mesh.vertices_mm.size(), 0);
  const std::vector<std::uint32_t> chamfered = chamfer_vertices(mesh);
  if (chamfered.empty()) return sharp;
  const OneRings one_rings(mesh);
  Plan plan{
      mesh, one_rings, voxel_mm, find_feature_vertices(mesh, one_rings, chamfered, voxel_mm), {}};
  do {
    plan.splits = find_splits(plan);
    remove_short_edges(plan);
    keep_unsplit_vertices(plan);
  } while (release_folding_vertices(plan));
  apply(plan, mesh, sharp);
  return sharp;
}

}  // namespace frangia
