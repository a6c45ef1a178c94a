#include "frangia/geometry/connected_components.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/disjoint_sets.h"
#include "frangia/core/error.h"
#include "frangia/geometry/vertex_data.h"

namespace frangia {
namespace {

/// Returns the components by area, the largest first; of equal ones the earlier.
std::vector<std::size_t> by_area(const std::vector<MeshComponent>& components) {
  std::vector<std::size_t> order(components.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return components[a].area_mm2 > components[b].area_mm2;
  });
  return order;
}

Mesh keep_components(Mesh mesh,
                     const ConnectedComponents& parts,
                     const std::vector<std::uint8_t>& keep) {
  Selection kept(mesh.triangles.size());
  for (std::size_t i = 0; i < kept.size(); ++i)
    kept[i] = keep[parts.component_of[i]];
  if (count_selected(kept) < kept.size()) keep_triangles(mesh, kept);
  return mesh;
}

}  // namespace

ConnectedComponents connected_components(const Mesh& mesh) {
  constexpr std::uint32_t kUnnumbered = 0xFFFFFFFF;
  DisjointSets sets(mesh.vertices_mm.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.join(a, b);
    sets.join(a, c);
  }
  ConnectedComponents found;
  found.component_of.resize(mesh.triangles.size());
  std::vector<std::uint32_t> number(mesh.vertices_mm.size(), kUnnumbered);
  std::vector<Eigen::AlignedBox3f> boxes;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    std::uint32_t& part = number[sets.find(a)];
    if (part == kUnnumbered) {
      part = static_cast<std::uint32_t>(found.components.size());
      found.components.emplace_back();
      boxes.emplace_back();
    }
    found.component_of[i] = part;
    MeshComponent& known = found.components[part];
    ++known.triangles;
    const Eigen::Vector3f& p = mesh.vertices_mm[a];
    const Eigen::Vector3f cross = (mesh.vertices_mm[b] - p).cross(mesh.vertices_mm[c] - p);
    known.area_mm2 += 0.5 * static_cast<double>(cross.norm());
    boxes[part].extend(p);
    boxes[part].extend(mesh.vertices_mm[b]);
    boxes[part].extend(mesh.vertices_mm[c]);
  }
  for (std::size_t part = 0; part < boxes.size(); ++part)
    found.components[part].size_mm = static_cast<double>(boxes[part].diagonal().norm());
  return found;
}

Selection select_component(const Mesh& mesh, std::size_t triangle) {
  require(triangle < mesh.triangles.size(), "select_component: the mesh has no such triangle");
  const ConnectedComponents parts = connected_components(mesh);
  Selection selection(mesh.triangles.size());
  for (std::size_t i = 0; i < selection.size(); ++i)
    selection[i] = parts.component_of[i] == parts.component_of[triangle] ? 1 : 0;
  return selection;
}

Mesh keep_largest_components(Mesh mesh, std::size_t count) {
  require(count > 0, "keep_largest_components: at least one component must be kept");
  const ConnectedComponents parts = connected_components(mesh);
  std::vector<std::size_t> order = by_area(parts.components);
  order.resize(std::min(order.size(), count));
  std::vector<std::uint8_t> keep(parts.components.size());
  for (const std::size_t part : order)
    keep[part] = 1;
  return keep_components(std::move(mesh), parts, keep);
}

Mesh remove_islands(Mesh mesh, double up_to_mm, const Run& run) {
  if (mesh.empty()) return mesh;
  const ConnectedComponents parts = connected_components(mesh);
  std::vector<std::uint8_t> keep(parts.components.size());
  for (std::size_t part = 0; part < keep.size(); ++part)
    keep[part] = parts.components[part].size_mm > up_to_mm ? 1 : 0;
  const std::size_t largest = by_area(parts.components).front();
  if (keep[largest] == 0) {
    run.warn(
        fmt::format("islands of up to {:.4g} mm are all components; the one of the largest area, "
                    "of {:.4g} mm, stays: choose a smaller size",
                    up_to_mm,
                    parts.components[largest].size_mm));
  }
  keep[largest] = 1;
  const std::size_t before = mesh.triangles.size();
  mesh = keep_components(std::move(mesh), parts, keep);
  const auto removed = std::count(keep.begin(), keep.end(), 0);
  if (removed > 0) {
    run.note(fmt::format("{} of {} components removed, {} triangles in total",
                         removed,
                         keep.size(),
                         before - mesh.triangles.size()));
  }
  return mesh;
}

}  // namespace frangia
