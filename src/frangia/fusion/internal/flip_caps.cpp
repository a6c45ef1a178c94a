#include "frangia/fusion/internal/flip_caps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/fusion/internal/normal_agreement.h"
#include "frangia/geometry/one_rings.h"

namespace frangia {
namespace {

using Vertex = std::uint32_t;

float height_of(const Mesh& mesh, const Mesh::Triangle& t) {
  float longest = 0.0F;
  for (std::size_t i = 0; i < 3; ++i) {
    longest = std::max(longest, (mesh.vertices_mm[t[(i + 1) % 3]] - mesh.vertices_mm[t[i]]).norm());
  }
  return longest > 0.0F ? doubled_area_vector(mesh, t).norm() / longest : 0.0F;
}

/// A low triangle a, b, c, rotated so that a-b is its longest edge.
struct Cap {
  std::uint32_t triangle;
  Vertex a, b, c;
};

std::vector<Cap> find_caps(const Mesh& mesh,
                           const std::vector<std::uint32_t>& near,
                           float lowest_mm) {
  std::vector<Cap> caps;
  for (const std::uint32_t t : near) {
    const auto& corners = mesh.triangles[t];
    if (is_removed(corners) || !is_low(mesh, corners, lowest_mm)) continue;
    std::array<float, 3> lengths{};
    for (std::size_t i = 0; i < 3; ++i) {
      lengths[i] =
          (mesh.vertices_mm[corners[(i + 1) % 3]] - mesh.vertices_mm[corners[i]]).squaredNorm();
    }
    const auto longest = static_cast<std::size_t>(std::max_element(lengths.begin(), lengths.end()) -
                                                  lengths.begin());
    caps.push_back({t, corners[longest], corners[(longest + 1) % 3], corners[(longest + 2) % 3]});
  }
  return caps;
}

/// Returns the triangle on the other side of the cap's longest edge; the cap itself at the
/// boundary.
std::uint32_t across(const Mesh& mesh, const OneRings& one_rings, const Cap& cap) {
  for (const std::uint32_t t : one_rings.of(cap.a)) {
    if (t != cap.triangle && has_vertex(mesh.triangles[t], cap.b)) return t;
  }
  return cap.triangle;
}

Vertex opposite(const Mesh::Triangle& t, const Cap& cap) {
  for (const Vertex v : t) {
    if (v != cap.a && v != cap.b) return v;
  }
  return cap.c;
}

}  // namespace

bool flip_caps(Mesh& mesh, float lowest_mm, SliverCandidates& candidates) {
  const std::vector<Cap> caps = find_caps(mesh, candidates.triangles(), lowest_mm);
  if (caps.empty()) return false;
  std::vector<Vertex> corners;
  for (const Cap& cap : caps)
    corners.insert(corners.end(), {cap.a, cap.b, cap.c});
  const OneRings one_rings(mesh, corners);
  std::vector<bool> touched(mesh.vertices_mm.size(), false);
  bool any = false;
  for (const Cap& cap : caps) {
    const std::uint32_t other = across(mesh, one_rings, cap);
    if (other == cap.triangle) continue;
    const Vertex d = opposite(mesh.triangles[other], cap);
    const auto joins = [&](std::uint32_t t) { return has_vertex(mesh.triangles[t], d); };
    if (touched[cap.a] || touched[cap.b] || touched[cap.c] || touched[d] ||
        std::any_of(one_rings.of(cap.c).begin(), one_rings.of(cap.c).end(), joins)) {
      continue;
    }
    const Mesh::Triangle one{cap.a, d, cap.c};
    const Mesh::Triangle two{d, cap.b, cap.c};
    const float now = std::min(normal_agreement(mesh, mesh.triangles[cap.triangle], -1.0F),
                               normal_agreement(mesh, mesh.triangles[other], -1.0F));
    const float then =
        std::min(normal_agreement(mesh, one, -1.0F), normal_agreement(mesh, two, -1.0F));
    const float lower = std::min(height_of(mesh, one), height_of(mesh, two));
    if (then <= now || lower <= height_of(mesh, mesh.triangles[cap.triangle])) continue;
    mesh.triangles[cap.triangle] = one;
    mesh.triangles[other] = two;
    for (const Vertex v : {cap.a, cap.b, cap.c, d})
      touched[v] = true;
    any = true;
  }
  candidates.add(one_rings.selected_triangles());
  return any;
}

}  // namespace frangia
