#include "frangia/mesh/patch_mesh.h"

#include <algorithm>
#include <map>
#include <utility>

#include <Eigen/Geometry>

namespace frangia {

using Eigen::Vector3d;

PatchMesh::PatchMesh(std::vector<Vector3d> rim_mm,
                     const std::vector<std::array<std::size_t, 3>>& triangles,
                     Joined joined)
    : rim_(static_cast<std::uint32_t>(rim_mm.size())),
      places_(std::move(rim_mm)),
      joined_(std::move(joined)) {
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
  twins_.insert(twins_.end(), 3, kRim);
  return first;
}

void PatchMesh::link(std::uint32_t one, std::uint32_t other) {
  twins_[one] = other;
  if (other != kRim) twins_[other] = one;
}

Vector3d PatchMesh::cross(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  return (places_[b] - places_[a]).cross(places_[c] - places_[a]);
}

std::uint32_t PatchMesh::split_triangle(std::uint32_t triangle, const Vector3d& place_mm) {
  const std::uint32_t middle = count();
  places_.push_back(place_mm);
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
  waiting_ = {ab, bc, ca};
  settle_waiting();
  return middle;
}

std::uint32_t PatchMesh::split_edge(std::uint32_t edge, const Vector3d& place_mm) {
  const std::uint32_t middle = count();
  places_.push_back(place_mm);
  const std::uint32_t back = twins_[edge];
  const std::uint32_t bc = next(edge);
  const std::uint32_t ca = before(edge);
  const std::uint32_t ad = next(back);
  const std::uint32_t db = before(back);
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
  waiting_ = {right + 1, left + 1, ca, db};
  settle_waiting();
  return middle;
}

bool PatchMesh::should_turn(std::uint32_t edge) const {
  const std::uint32_t back = twins_[edge];
  const auto dot_and_cross = [&](std::uint32_t side) {
    const Vector3d& apex = places_[from_[before(side)]];
    const Vector3d u = places_[from_[side]] - apex;
    const Vector3d v = places_[to(side)] - apex;
    return std::pair(u.dot(v), u.cross(v).norm());
  };
  const auto [dot_a, cross_a] = dot_and_cross(edge);
  const auto [dot_b, cross_b] = dot_and_cross(back);
  const double size = (std::abs(dot_a) + cross_a) * (std::abs(dot_b) + cross_b);
  return dot_a * cross_b + dot_b * cross_a < -1e-9 * size;
}

/// Whether a half-edge leaves the vertex where `leaving` begins for `other`, or comes from there.
bool PatchMesh::neighbors(std::uint32_t leaving, std::uint32_t other) const {
  std::uint32_t edge = leaving;
  do {
    if (to(edge) == other || from_[before(edge)] == other) return true;
    edge = twins_[before(edge)];
  } while (edge != kRim && edge != leaving);
  if (edge == leaving) return false;
  for (edge = twins_[leaving]; edge != kRim; edge = twins_[edge]) {
    edge = next(edge);
    if (to(edge) == other || from_[before(edge)] == other) return true;
  }
  return false;
}

bool PatchMesh::may_turn(std::uint32_t edge) const {
  const std::uint32_t back = twins_[edge];
  const std::uint32_t a = from_[edge];
  const std::uint32_t b = from_[back];
  const std::uint32_t c = from_[before(edge)];
  const std::uint32_t d = from_[before(back)];
  if (c == d) return false;
  const Vector3d first = cross(a, d, c);
  const Vector3d second = cross(d, b, c);
  const Vector3d before_both = cross(a, b, c) + cross(b, a, d);
  if (first.dot(second) < 0.0 || first.dot(before_both) < 0.0 || second.dot(before_both) < 0.0) {
    return false;
  }
  if (c < rim_ && d < rim_ && joined_ && joined_(c, d)) return false;
  return !neighbors(before(edge), d);
}

void PatchMesh::turn(std::uint32_t edge) {
  const std::uint32_t back = twins_[edge];
  const std::uint32_t bc = twins_[next(edge)];
  const std::uint32_t ca = twins_[before(edge)];
  const std::uint32_t ad = twins_[next(back)];
  const std::uint32_t db = twins_[before(back)];
  const std::uint32_t a = from_[edge];
  const std::uint32_t b = from_[back];
  const std::uint32_t c = from_[before(edge)];
  const std::uint32_t d = from_[before(back)];
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
  waiting_.insert(waiting_.end(), {s, s + 2, t, t + 1});
}

void PatchMesh::settle_waiting() {
  // In space the turning might go round in circles.
  std::size_t left = 50 * waiting_.size() + 100;
  while (!waiting_.empty() && left > 0) {
    const std::uint32_t edge = waiting_.back();
    waiting_.pop_back();
    if (twins_[edge] == kRim || !should_turn(edge) || !may_turn(edge)) continue;
    turn(edge);
    --left;
  }
  waiting_.clear();
}

void PatchMesh::settle() {
  for (std::uint32_t edge = 0; edge < half_edges(); ++edge) {
    const std::uint32_t twin = twins_[edge];
    if (twin != kRim && edge < twin) waiting_.push_back(edge);
  }
  std::reverse(waiting_.begin(), waiting_.end());
  settle_waiting();
}

}  // namespace frangia
