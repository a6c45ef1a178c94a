#include "frangia/simulate/internal/polygonize_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
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

/// A cube of corners. Each corner of the grid is in one block.
struct Block {
  std::array<std::size_t, 3> first{}, last{};  ///< corners; the last one is not its own
};

/// The blocks of a grid, x fastest, and which of them the surface may pass.
class Blocks {
 public:
  explicit Blocks(const Grid& grid) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      count_[axis] = (grid.size[axis] + kSide - 1) / kSide;
    reached_.resize(count_[0] * count_[1] * count_[2]);
  }
  [[nodiscard]] std::size_t size() const { return reached_.size(); }
  [[nodiscard]] Block block(const Grid& grid, std::size_t index) const {
    const std::array<std::size_t, 3> at{
        index % count_[0], index / count_[0] % count_[1], index / count_[0] / count_[1]};
    Block block;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      block.first[axis] = kSide * at[axis];
      block.last[axis] = std::min(kSide * (at[axis] + 1), grid.size[axis]);
    }
    return block;
  }
  [[nodiscard]] std::size_t of_corner(const std::array<std::size_t, 3>& corner) const {
    return (corner[2] / kSide * count_[1] + corner[1] / kSide) * count_[0] + corner[0] / kSide;
  }
  /// Adds a block to a list unless it was reached before.
  void reach(std::size_t index, std::vector<std::size_t>& list) {
    if (reached_[index] != 0) return;
    reached_[index] = 1;
    list.push_back(index);
  }

 private:
  static constexpr std::size_t kSide = 4;
  std::array<std::size_t, 3> count_{};
  std::vector<char> reached_;
};

/// Calls `visit` with each corner of a block.
template <typename Visit>
void for_each_corner(const Block& block, const Visit& visit) {
  std::array<std::size_t, 3> at{};
  for (at[2] = block.first[2]; at[2] < block.last[2]; ++at[2])
    for (at[1] = block.first[1]; at[1] < block.last[1]; ++at[1])
      for (at[0] = block.first[0]; at[0] < block.last[0]; ++at[0])
        visit(at);
}

/// Reaches the blocks at both ends of each edge of a block that the surface crosses.
void follow(const Grid& grid, const Block& from, Blocks& blocks, std::vector<std::size_t>& list) {
  for_each_corner(from, [&](const std::array<std::size_t, 3>& at) {
    const std::size_t corner = grid.index(at[0], at[1], at[2]);
    const bool inside = grid.values[corner] < 0.0F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::array<std::size_t, 3> next = at;
      if (at[axis] > 0 && (grid.values[corner - grid.stride(axis)] < 0.0F) != inside) {
        --next[axis];
        blocks.reach(blocks.of_corner(next), list);
        blocks.reach(blocks.of_corner(at), list);
        next = at;
      }
      if (at[axis] + 1 < grid.size[axis] &&
          (grid.values[corner + grid.stride(axis)] < 0.0F) != inside) {
        ++next[axis];
        blocks.reach(blocks.of_corner(next), list);
        blocks.reach(blocks.of_corner(at), list);
      }
    }
  });
}

/// Samples the field where its surface passes: every block has the value of its first corner until
/// a change of sign reaches it. A piece of the surface between those corners is not found.
Grid sample(const Field& field, const Eigen::AlignedBox3d& box, double cell_mm, const Run& run) {
  Grid grid{box.min(), cell_mm, {}, {}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double length = box.sizes()[static_cast<Eigen::Index>(axis)];
    grid.size[axis] = static_cast<std::size_t>(std::ceil(length / cell_mm)) + 1;
  }
  grid.values.resize(grid.size[0] * grid.size[1] * grid.size[2]);
  Blocks blocks(grid);
  const auto value = [&](const std::array<std::size_t, 3>& at) {
    return static_cast<float>(field(grid.corner(at[0], at[1], at[2])));
  };
  parallel_chunks(blocks.size(), 64, [&](std::size_t begin, std::size_t end) {
    if (run.stop.stop_requested()) return;
    for (std::size_t i = begin; i < end; ++i) {
      const Block block = blocks.block(grid, i);
      const float first = value(block.first);
      for_each_corner(block, [&](const std::array<std::size_t, 3>& at) {
        grid.values[grid.index(at[0], at[1], at[2])] = first;
      });
    }
  });
  run.check();
  std::vector<std::size_t> reached;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    follow(grid, blocks.block(grid, i), blocks, reached);
  while (!reached.empty()) {
    parallel_chunks(reached.size(), 16, [&](std::size_t begin, std::size_t end) {
      if (run.stop.stop_requested()) return;
      for (std::size_t i = begin; i < end; ++i) {
        for_each_corner(blocks.block(grid, reached[i]), [&](const std::array<std::size_t, 3>& at) {
          grid.values[grid.index(at[0], at[1], at[2])] = value(at);
        });
      }
    });
    run.check();
    std::vector<std::size_t> next;
    for (const std::size_t block : reached)
      follow(grid, blocks.block(grid, block), blocks, next);
    reached = std::move(next);
  }
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

/// Moves a point along the gradient to the zero level, by at most half a cell. The gradient of the
/// second step is used for the later ones, which are about a thousandth of a cell long.
Eigen::Vector3d project_to_surface(const Field& field,
                                   const Eigen::Vector3d& start,
                                   double cell_mm) {
  const double h = 1e-3 * cell_mm;
  Eigen::Vector3d p = start;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (int step = 0; step < 4; ++step) {
    const double value = field(p);
    if (step < 2) {
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        gradient[axis] = (field(p + h * Eigen::Vector3d::Unit(axis)) - value) / h;
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
