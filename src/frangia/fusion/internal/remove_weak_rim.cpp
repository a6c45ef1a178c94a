#include "frangia/fusion/internal/remove_weak_rim.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "frangia/core/median.h"
#include "frangia/geometry/boundary_vertices.h"
#include "frangia/geometry/one_rings.h"

namespace frangia {
namespace {

/// The vertices of the boundary that fewer views than a share of the most of all observed.
std::vector<std::uint32_t> rim_of_few_views(const Mesh& mesh, double share) {
  const double most = *std::max_element(mesh.views.begin(), mesh.views.end());
  const std::vector<bool> boundary = boundary_vertices(mesh);
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < mesh.views.size(); ++i) {
    if (boundary[i] && mesh.views[i] < share * most) out.push_back(i);
  }
  return out;
}

}  // namespace

void remove_weak_rim(Mesh& mesh, const CleanupParameters& parameters) {
  if (mesh.views.empty()) return;
  const double share = parameters.rim_views_share;
  const std::vector<std::uint32_t> rim = rim_of_few_views(mesh, share);
  if (rim.empty()) return;
  const OneRings rings(mesh, rim);
  std::vector<bool> weak(mesh.views.size());
  for (const std::uint32_t vertex : rim) {
    std::vector<float> views;
    for (const std::uint32_t neighbor : one_ring_neighbors(mesh, rings, vertex))
      views.push_back(mesh.views[neighbor]);
    weak[vertex] = mesh.views[vertex] < share * static_cast<double>(median(std::move(views)));
  }
  std::erase_if(mesh.triangles, [&](const Mesh::Triangle& triangle) {
    return std::any_of(triangle.begin(), triangle.end(), [&](auto i) { return weak[i]; });
  });
}

}  // namespace frangia
