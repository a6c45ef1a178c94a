#include "frangia/mesh/internal/patch_mesh.h"

#include <algorithm>
#include <map>
#include <utility>

#include <Eigen/Geometry>

namespace frangia {

using Eigen::Vector3d;

PatchMesh::PatchMesh(std::vector<Vector3d> boundary_mm,
                     const std::vector<std::array<std::size_t, 3>>& triangles,
                     AreAdjacent are_adjacent)
    : boundary_vertices_(static_cast<std::uint32_t>(boundary_mm.size())),
      positions_(std::move(boundary_mm)),
      are_adjacent_(std::move(are_adjacent)) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edge_of;
  for (const auto& [a, b, c] : triangles) {
    const std::uint32_t first = add_triangle(static_cast<std::uint32_t>(a),
                                             static_cast<std::uint32_t>(b),
                                             static_cast<std::uint32_t>(c));
    for (std::uint32_t edge = first; edge < first + 3; ++edge) {
      const auto twin = edge_of.find({to(edge), from(edge)});
      if (twin != edge_of.end()) link(edge, twin->second);
      edge_of.emplace(std::pair(from(edge), to(edge)), edge);
    }
  }
}

std::uint32_t PatchMesh::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const std::uint32_t first = half_edges();
  from_.insert(from_.end(), {a, b, c});
  twins_.insert(twins_.end(), 3, kBoundary);
  return first;
}

void PatchMesh::link(std::uint32_t one, std::uint32_t other) {
  twins_[one] = other;
  if (other != kBoundary) twins_[other] = one;
}

Vector3d PatchMesh::cross(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  return (positions_[b] - positions_[a]).cross(positions_[c] - positions_[a]);
}

std::uint32_t PatchMesh::split_triangle(std::uint32_t triangle, const Vector3d& position_mm) {
  const std::uint32_t middle = count();
  positions_.push_back(position_mm);
  const std::uint32_t ab = 3 * triangle;
  const std::uint32_t a = from_[ab];
  const std::uint32_t b = from_[ab + 1];
  const std::uint32_t c = from_[ab + 2];
  const std::uint32_t beyond_bc = twins_[ab + 1];
  const std::uint32_t beyond_ca = twins_[ab + 2];
  const std::uint32_t bc = add_triangle(b, c, middle);
  const std::uint32_t ca = add_triangle(c, a, middle);
  from_[ab + 2] = middle;
  link(bc, beyond_bc);
  link(ca, beyond_ca);
  link(ab + 1, bc + 2);
  link(bc + 1, ca + 2);
  link(ca + 1, ab + 2);
  pending_ = {ab, bc, ca};
  flip_pending();
  return middle;
}

std::uint32_t PatchMesh::split_edge(std::uint32_t edge, const Vector3d& position_mm) {
  const std::uint32_t middle = count();
  positions_.push_back(position_mm);
  const std::uint32_t back = twins_[edge];
  const std::uint32_t bc = next(edge);
  const std::uint32_t ca = previous(edge);
  const std::uint32_t ad = next(back);
  const std::uint32_t db = previous(back);
  const std::uint32_t beyond_bc = twins_[bc];
  const std::uint32_t beyond_ad = twins_[ad];
  const std::uint32_t right = add_triangle(middle, from_[bc], from_[ca]);
  const std::uint32_t left = add_triangle(middle, from_[ad], from_[db]);
  from_[bc] = middle;  // a, middle, c
  from_[ad] = middle;  // b, middle, d
  link(right + 1, beyond_bc);
  link(left + 1, beyond_ad);
  link(right + 2, bc);
  link(left + 2, ad);
  link(right, back);
  link(left, edge);
  pending_ = {right + 1, left + 1, ca, db};
  flip_pending();
  return middle;
}

bool PatchMesh::should_flip(std::uint32_t edge) const {
  const std::uint32_t back = twins_[edge];
  const auto dot_and_cross = [&](std::uint32_t side) {
    const Vector3d& apex = positions_[from_[previous(side)]];
    const Vector3d u = positions_[from_[side]] - apex;
    const Vector3d v = positions_[to(side)] - apex;
    return std::pair(u.dot(v), u.cross(v).norm());
  };
  const auto [dot_a, cross_a] = dot_and_cross(edge);
  const auto [dot_b, cross_b] = dot_and_cross(back);
  const double size = (std::abs(dot_a) + cross_a) * (std::abs(dot_b) + cross_b);
  constexpr double kRounding = 1e-9;  // sine of the angle sum: cocircular vertices do not flip
  return dot_a * cross_b + dot_b * cross_a < -kRounding * size;
}

/// Whether an edge connects the source of `outgoing` to `other`.
bool PatchMesh::are_connected(std::uint32_t outgoing, std::uint32_t other) const {
  std::uint32_t edge = outgoing;
  do {
    if (to(edge) == other || from_[previous(edge)] == other) return true;
    edge = twins_[previous(edge)];
  } while (edge != kBoundary && edge != outgoing);
  if (edge == outgoing) return false;
  for (edge = twins_[outgoing]; edge != kBoundary; edge = twins_[edge]) {
    edge = next(edge);
    if (to(edge) == other || from_[previous(edge)] == other) return true;
  }
  return false;
}

bool PatchMesh::can_flip(std::uint32_t edge) const {
  const std::uint32_t back = twins_[edge];
  const std::uint32_t a = from_[edge];
  const std::uint32_t b = from_[back];
  const std::uint32_t c = from_[previous(edge)];
  const std::uint32_t d = from_[previous(back)];
  if (c == d) return false;
  const Vector3d first = cross(a, d, c);
  const Vector3d second = cross(d, b, c);
  const Vector3d before_both = cross(a, b, c) + cross(b, a, d);
  if (first.dot(second) < 0.0 || first.dot(before_both) < 0.0 || second.dot(before_both) < 0.0) {
    return false;
  }
  if (c < boundary_vertices_ && d < boundary_vertices_ && are_adjacent_ && are_adjacent_(c, d))
    return false;
  return !are_connected(previous(edge), d);
}

void PatchMesh::flip(std::uint32_t edge) {
  const std::uint32_t back = twins_[edge];
  const std::uint32_t bc = twins_[next(edge)];
  const std::uint32_t ca = twins_[previous(edge)];
  const std::uint32_t ad = twins_[next(back)];
  const std::uint32_t db = twins_[previous(back)];
  const std::uint32_t a = from_[edge];
  const std::uint32_t b = from_[back];
  const std::uint32_t c = from_[previous(edge)];
  const std::uint32_t d = from_[previous(back)];
  const std::uint32_t s = 3 * (edge / 3);
  const std::uint32_t t = 3 * (back / 3);
  from_[s] = a;
  from_[s + 1] = d;
  from_[s + 2] = c;
  from_[t] = d;
  from_[t + 1] = b;
  from_[t + 2] = c;
  link(s, ad);
  link(s + 2, ca);
  link(t, db);
  link(t + 1, bc);
  link(s + 1, t + 2);
  pending_.insert(pending_.end(), {s, s + 2, t, t + 1});
}

void PatchMesh::flip_pending() {
  // In space, flips may cycle: the limit is far above the number that a patch needs.
  std::size_t left = 50 * pending_.size() + 100;
  while (!pending_.empty() && left > 0) {
    const std::uint32_t edge = pending_.back();
    pending_.pop_back();
    if (twins_[edge] == kBoundary || !should_flip(edge) || !can_flip(edge)) continue;
    flip(edge);
    --left;
  }
  pending_.clear();
}

void PatchMesh::restore_delaunay() {
  for (std::uint32_t edge = 0; edge < half_edges(); ++edge) {
    const std::uint32_t twin = twins_[edge];
    if (twin != kBoundary && edge < twin) pending_.push_back(edge);
  }
  std::reverse(pending_.begin(), pending_.end());
  flip_pending();
}

}  // namespace frangia
