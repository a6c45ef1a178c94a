#include "frangia/inspect/uncertainty_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "frangia/core/missing.h"
#include "frangia/core/statistics.h"
#include "frangia/inspect/internal/patch_grid.h"

namespace frangia {
namespace {

using Eigen::Vector3f;

constexpr float kMapFace = 0.3F;                 // cosine, as of the patches
constexpr std::size_t kMostTriangles = 400'000;  // of a map

/// A triangle on its own, so that vertices of different faces have different values.
using Corners = std::array<Vector3f, 3>;

float longest_edge(const Corners& at) {
  return std::max({(at[1] - at[0]).norm(), (at[2] - at[1]).norm(), (at[0] - at[2]).norm()});
}

/// Halves the longest edges until none is longer than `step_mm`, or there are too many triangles.
std::vector<Corners> divided(const Mesh& mesh, float step_mm) {
  std::vector<Corners> work;
  for (const Mesh::Triangle& t : mesh.triangles)
    work.push_back({mesh.vertices_mm[t[0]], mesh.vertices_mm[t[1]], mesh.vertices_mm[t[2]]});
  std::vector<Corners> done;
  while (!work.empty()) {
    const Corners at = work.back();
    work.pop_back();
    if (longest_edge(at) <= step_mm || work.size() + done.size() >= kMostTriangles) {
      done.push_back(at);
      continue;
    }
    std::size_t from = 0;  // of the longest edge
    for (std::size_t i = 1; i < 3; ++i)
      if ((at.at((i + 1) % 3) - at.at(i)).norm() > (at.at((from + 1) % 3) - at.at(from)).norm())
        from = i;
    const Vector3f& a = at.at(from);
    const Vector3f& b = at.at((from + 1) % 3);
    const Vector3f& c = at.at((from + 2) % 3);
    const Vector3f middle = 0.5F * (a + b);
    work.push_back({a, middle, c});
    work.push_back({middle, b, c});
  }
  return done;
}

}  // namespace

UncertaintyMap uncertainty_map(const SurfacePatches& patches,
                               const Mesh& reference,
                               const Run& run) {
  inspect::PatchGrid grid(patches.diameter_mm);
  for (const Vector3f& center : patches.center_mm)
    grid.add(center);
  const auto value_at = [&](const Vector3f& point, const Vector3f& normal) {
    float nearest = std::numeric_limits<float>::infinity();
    float value = kMissing;
    grid.within(point, patches.diameter_mm, [&](std::uint32_t patch, float squared) {
      if (squared >= nearest || normal.dot(patches.normal[patch]) < kMapFace) return;
      nearest = squared;
      value = patches.is_measured(patch) ? static_cast<float>(kNormal95 * patches.u_mm(patch))
                                         : kMissing;
    });
    return value;
  };
  UncertaintyMap map;
  for (const Corners& at : divided(reference, static_cast<float>(patches.diameter_mm))) {
    run.check();
    const Vector3f normal = (at[1] - at[0]).cross(at[2] - at[0]).normalized();
    const auto first = static_cast<std::uint32_t>(map.mesh.vertices_mm.size());
    for (const Vector3f& corner : at) {
      map.mesh.vertices_mm.push_back(corner);
      map.u95_mm.push_back(value_at(corner, normal));
    }
    map.mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return map;
}

}  // namespace frangia
