#include "frangia/simulate/internal/polygonize_field.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// The field at the corners of cubic cells, x fastest.
struct Grid {
  Eigen::Vector3d origin_mm;
  double cell_mm = 0.0;
  std::array<std::size_t, 3> size{};  ///< corners along x, y, z
  std::vector<float> values;

  [[nodiscard]] std::size_t index(std::size_t x, std::size_t y, std::size_t z) const {
    return (z * size[1] + y) * size[0] + x;
  }
  [[nodiscard]] std::size_t stride(std::size_t axis) const {
    return axis == 0 ? 1 : axis == 1 ? size[0] : size[0] * size[1];
  }
  [[nodiscard]] Eigen::Vector3d corner(std::size_t x, std::size_t y, std::size_t z) const {
    return origin_mm + cell_mm * Eigen::Vector3d(static_cast<double>(x),
                                                 static_cast<double>(y),
                                                 static_cast<double>(z));
  }
};

Grid sample(const Field& field, const Eigen::AlignedBox3d& box, double cell_mm, const Run& run) {
  Grid grid{box.min(), cell_mm, {}, {}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double length = box.sizes()[static_cast<Eigen::Index>(axis)];
    grid.size[axis] = static_cast<std::size_t>(std::ceil(length / cell_mm)) + 1;
  }
  grid.values.resize(grid.size[0] * grid.size[1] * grid.size[2]);
  parallel_chunks(grid.size[2], 1, [&](std::size_t z, std::size_t) {
    if (run.stop.stop_requested()) return;
    for (std::size_t y = 0; y < grid.size[1]; ++y) {
      for (std::size_t x = 0; x < grid.size[0]; ++x) {
        grid.values[grid.index(x, y, z)] = static_cast<float>(field(grid.corner(x, y, z)));
      }
    }
  });
  run.check();
  return grid;
}

/// Mean of the surface's intersections with the cell's twelve edges; empty if there are none.
bool crossing_of(const Grid& grid, std::size_t base, Eigen::Vector3d& mean) {
  std::array<float, 8> value{};
  for (std::size_t i = 0; i < 8; ++i) {
    value[i] = grid.values[base + (i & 1U) * grid.stride(0) + ((i >> 1U) & 1U) * grid.stride(1) +
                           (i >> 2U) * grid.stride(2)];
  }
  mean.setZero();
  int count = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t j = i | (std::size_t{1} << axis);
      if (j == i || (value[i] < 0.0F) == (value[j] < 0.0F)) continue;
      Eigen::Vector3d crossing(static_cast<double>(i & 1U),
                               static_cast<double>((i >> 1U) & 1U),
                               static_cast<double>(i >> 2U));
      crossing[static_cast<Eigen::Index>(axis)] =
          static_cast<double>(value[i]) / static_cast<double>(value[i] - value[j]);
      mean += crossing;
      ++count;
    }
  }
  if (count > 0) mean /= count;
  return count > 0;
}

/// Moves a point along the gradient to the zero level, by at most half a cell.
Eigen::Vector3d project_to_surface(const Field& field,
                                   const Eigen::Vector3d& start,
                                   double cell_mm) {
  const double h = 1e-3 * cell_mm;
  Eigen::Vector3d p = start;
  for (int step = 0; step < 4; ++step) {
    const double value = field(p);
    Eigen::Vector3d gradient;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d d = h * Eigen::Vector3d::Unit(axis);
      gradient[axis] = (field(p + d) - field(p - d)) / (2.0 * h);
    }
    if (!(gradient.squaredNorm() > 0.01)) return start;
    p -= gradient * (value / gradient.squaredNorm());
    if ((p - start).norm() > 0.5 * cell_mm) return start;
  }
  return p;
}

/// The two triangles of the four cells around an edge, cut along the shorter diagonal.
void add_quad(Mesh& mesh, const std::array<std::uint32_t, 4>& quad) {
  const auto length = [&](std::size_t a, std::size_t b) {
    return (mesh.vertices_mm[quad[a]] - mesh.vertices_mm[quad[b]]).squaredNorm();
  };
  if (length(0, 2) <= length(1, 3)) {
    mesh.triangles.push_back({quad[0], quad[1], quad[2]});
    mesh.triangles.push_back({quad[0], quad[2], quad[3]});
  } else {
    mesh.triangles.push_back({quad[0], quad[1], quad[3]});
    mesh.triangles.push_back({quad[1], quad[2], quad[3]});
  }
}

void add_quads_of(Mesh& mesh,
                  const Grid& grid,
                  const std::vector<std::uint32_t>& vertex_of,
                  std::size_t corner) {
  const bool inside = grid.values[corner] < 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if ((grid.values[corner + grid.stride(axis)] < 0.0F) == inside) continue;
    const std::size_t u = grid.stride((axis + 1) % 3);
    const std::size_t v = grid.stride((axis + 2) % 3);
    std::array<std::uint32_t, 4> quad{
        vertex_of[corner - u - v], vertex_of[corner - v], vertex_of[corner], vertex_of[corner - u]};
    if (!inside) std::swap(quad[1], quad[3]);
    add_quad(mesh, quad);
  }
}

}  // namespace

Mesh polygonize_field(const Field& field,
                      const Eigen::AlignedBox3d& box_mm,
                      double cell_mm,
                      const Run& run) {
  const Grid grid = sample(field, box_mm, cell_mm, run);
  const auto on_border = [&](std::size_t x, std::size_t y, std::size_t z) {
    return x == 0 || y == 0 || z == 0 || x + 1 == grid.size[0] || y + 1 == grid.size[1] ||
           z + 1 == grid.size[2];
  };
  Mesh mesh;
  std::vector<std::uint32_t> vertex_of(grid.values.size(), kNone);
  std::vector<Eigen::Vector3d> starts;
  for (std::size_t z = 0; z + 1 < grid.size[2]; ++z) {
    run.check();
    for (std::size_t y = 0; y + 1 < grid.size[1]; ++y) {
      for (std::size_t x = 0; x + 1 < grid.size[0]; ++x) {
        Eigen::Vector3d mean;
        if (!crossing_of(grid, grid.index(x, y, z), mean)) continue;
        vertex_of[grid.index(x, y, z)] = static_cast<std::uint32_t>(starts.size());
        starts.emplace_back(grid.corner(x, y, z) + cell_mm * mean);
      }
    }
  }
  mesh.vertices_mm.resize(starts.size());
  parallel_chunks(starts.size(), 256, [&](std::size_t begin, std::size_t end) {
    if (run.stop.stop_requested()) return;
    for (std::size_t i = begin; i < end; ++i)
      mesh.vertices_mm[i] = project_to_surface(field, starts[i], cell_mm).cast<float>();
  });
  for (std::size_t z = 0; z < grid.size[2]; ++z) {
    run.check();
    for (std::size_t y = 0; y < grid.size[1]; ++y) {
      for (std::size_t x = 0; x < grid.size[0]; ++x) {
        const std::size_t corner = grid.index(x, y, z);
        if (on_border(x, y, z)) {
          require(!(grid.values[corner] < 0.0F),
                  "polygonize_field: the solid reaches the border of the box; make the box larger");
          continue;
        }
        add_quads_of(mesh, grid, vertex_of, corner);
      }
    }
  }
  return mesh;
}

}  // namespace frangia
