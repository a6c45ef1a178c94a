#include "frangia/fusion/internal/sharpening_plan.h"

#include <algorithm>

#include "frangia/core/disjoint_sets.h"

namespace frangia {
namespace {

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

}  // namespace

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

void plan_splits(SharpeningPlan& plan) {
  plan.splits = find_splits(plan);
  remove_short_edges(plan);
  keep_unsplit_vertices(plan);
}

}  // namespace frangia
