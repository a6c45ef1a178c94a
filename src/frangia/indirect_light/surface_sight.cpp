#include "frangia/indirect_light/surface_sight.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/geometry/cosine_cells.h"

namespace frangia {
namespace {

constexpr int kCells = 24;           // along the longest side of the surface
constexpr std::size_t kLookers = 6;  // triangles of a cell
constexpr int kSightRings = 6;
constexpr int kSightSectors = 8;

/// A cubic grid about a mesh.
struct CellGrid {
  Eigen::Vector3f low;
  float size_mm = 1.0F;
  Eigen::Array3i counts;

  explicit CellGrid(const Mesh& mesh) {
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& vertex : mesh.vertices_mm)
      box.extend(vertex);
    low = box.min();
    size_mm = std::max(box.sizes().maxCoeff() / static_cast<float>(kCells), 1e-6F);
    counts = (box.sizes().array() / size_mm).cast<int>() + 1;
  }
  [[nodiscard]] std::size_t number_of(const Eigen::Array3i& at) const {
    return static_cast<std::size_t>((at.z() * counts.y() + at.y()) * counts.x() + at.x());
  }
  [[nodiscard]] Eigen::Array3i cell_of(const Eigen::Vector3f& point) const {
    const Eigen::Array3i at = ((point - low).array() / size_mm).cast<int>();
    return at.max(0).min(counts - 1);
  }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(counts.prod()); }
};

/// Whether a ray from the middle of a triangle meets the surface.
bool looks_at_surface(const RayScene& scene, std::size_t triangle, double step_off_mm) {
  const Mesh& mesh = scene.mesh();
  const auto& corners = mesh.triangles[triangle];
  const Eigen::Vector3d a = mesh.vertices_mm[corners[0]].cast<double>();
  const Eigen::Vector3d b = mesh.vertices_mm[corners[1]].cast<double>();
  const Eigen::Vector3d c = mesh.vertices_mm[corners[2]].cast<double>();
  const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
  if (!normal.allFinite()) return false;
  const Eigen::Vector3d origin = (a + b + c) / 3.0 + step_off_mm * normal;
  const auto cells = cosine_cells(normal, kSightRings, kSightSectors, 0.5);
  return std::any_of(cells.begin(), cells.end(), [&](const CosineCell& cell) {
    return scene.first_hit(origin, cell.center).has_value();
  });
}

/// A triangle that is longer than a cell lies in several, which its corner does not know.
float longest_edge_mm(const Mesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return std::max({(mesh.vertices_mm[a] - mesh.vertices_mm[b]).norm(),
                   (mesh.vertices_mm[b] - mesh.vertices_mm[c]).norm(),
                   (mesh.vertices_mm[c] - mesh.vertices_mm[a]).norm()});
}

}  // namespace

SurfaceSight::SurfaceSight(const RayScene& scene, double step_off_mm) {
  const Mesh& mesh = scene.mesh();
  sees_.assign(mesh.triangles.size(), 0);
  if (mesh.triangles.empty()) return;
  const CellGrid grid(mesh);
  std::vector<std::vector<std::size_t>> members(grid.size());
  std::vector<std::size_t> cell_of(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    cell_of[i] = grid.number_of(grid.cell_of(mesh.vertices_mm[mesh.triangles[i][0]]));
    members[cell_of[i]].push_back(i);
  }
  std::vector<char> looks(grid.size(), 0);
  parallel_chunks(grid.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t cell = begin; cell < end; ++cell) {
      const std::vector<std::size_t>& own = members[cell];
      const std::size_t every = own.size() / kLookers + 1;
      for (std::size_t k = every / 2; k < own.size() && looks[cell] == 0; k += every)
        looks[cell] = looks_at_surface(scene, own[k], step_off_mm) ? 1 : 0;
    }
  });
  std::vector<char> near(grid.size(), 0);
  for (int z = 0; z < grid.counts.z(); ++z) {
    for (int y = 0; y < grid.counts.y(); ++y) {
      for (int x = 0; x < grid.counts.x(); ++x) {
        const Eigen::Array3i at(x, y, z);
        if (looks[grid.number_of(at)] == 0) continue;
        const Eigen::Array3i first = (at - 1).max(0);
        const Eigen::Array3i last = (at + 1).min(grid.counts - 1);
        for (int w = first.z(); w <= last.z(); ++w) {
          for (int v = first.y(); v <= last.y(); ++v) {
            for (int u = first.x(); u <= last.x(); ++u)
              near[grid.number_of({u, v, w})] = 1;
          }
        }
      }
    }
  }
  for (std::size_t i = 0; i < sees_.size(); ++i)
    sees_[i] = near[cell_of[i]] != 0 || longest_edge_mm(mesh, i) > grid.size_mm ? 1 : 0;
}

}  // namespace frangia
