#include "frangia/fusion/internal/remove_weak_rim.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "frangia/core/statistics.h"
#include "frangia/geometry/boundary.h"
#include "frangia/geometry/connectivity.h"
#include "frangia/uncertainty/combined_sigma.h"

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

namespace {

/// Marks the vertices of all triangles that have a marked vertex.
std::vector<std::uint8_t> grown(const Mesh& mesh, const std::vector<std::uint8_t>& marked) {
  std::vector<std::uint8_t> out = marked;
  for (const auto& triangle : mesh.triangles) {
    const bool any =
        std::any_of(triangle.begin(), triangle.end(), [&](auto v) { return marked[v] != 0; });
    if (!any) continue;
    for (const std::uint32_t v : triangle)
      out[v] = 1;
  }
  return out;
}

}  // namespace

void widen_sigma_of_strips(Mesh& mesh, float voxel_mm) {
  if (mesh.views.empty()) return;
  // A fit takes 5 x 5 pixels, of 1.5 to a voxel: beyond two triangles from the end of the data, it
  // lies within them.
  constexpr float kOff_voxels = 0.3F;  // RMS of such strips of the simulated shaft
  const std::vector<bool> boundary = boundary_vertices(mesh);
  const std::vector<std::uint8_t> near =
      grown(mesh, std::vector<std::uint8_t>(boundary.begin(), boundary.end()));
  std::vector<std::uint8_t> deep(near.size());
  std::transform(near.begin(), near.end(), deep.begin(), [](auto v) { return v == 0 ? 1 : 0; });
  const std::vector<std::uint8_t> beside = grown(mesh, deep);
  const std::vector<std::uint8_t> within = grown(mesh, beside);
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (mesh.views[i] > 1 || (boundary[i] ? within : beside)[i] != 0) continue;
    mesh.sigma_mm[i] = combined_sigma(mesh.sigma_mm[i], kOff_voxels * voxel_mm);
  }
}

}  // namespace frangia
