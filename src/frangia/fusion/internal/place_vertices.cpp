#include "frangia/fusion/internal/place_vertices.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <Eigen/Eigenvalues>

#include "frangia/core/parallel.h"
#include "frangia/fusion/internal/cell_loops.h"
#include "frangia/fusion/internal/hermite_samples.h"

namespace frangia {
namespace {

/// Eigenvalues of sum n n^T below this part of the largest are noise: two faces that meet at less
/// than 25 degrees are taken for one.
constexpr float kFlat = 0.05F;

constexpr float kMaxExcursion = 0.5F;  // voxels that a vertex may leave its cell by
constexpr float kCellMargin = 1e-3F;   // voxels that keep those within apart from their neighbours

/// A cell, or one grown by `margin` on every side.
struct Cell {
  Cell(const Eigen::Vector3f& low_mm, float edge_mm, float margin_mm)
      : low(low_mm.array() - margin_mm), high(low_mm.array() + edge_mm + margin_mm) {}

  [[nodiscard]] bool contains(const Eigen::Vector3f& point) const {
    return (point.array() >= low).all() && (point.array() <= high).all();
  }
  Eigen::Array3f low;
  Eigen::Array3f high;
};

/// What there is to place vertices by.
struct PlacementInput {
  const EdgeCrossings& crossings;
  const HermiteAccumulators& hermite;
  HermiteSamples samples;
};

/// The facets around a loop whose crossings hold.
struct Loop {
  std::array<const HermiteSample*, 12> samples;  ///< `count` of them
  std::array<std::uint32_t, 12> crossings;
  std::size_t count = 0;
  bool any_lesser = false;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< their mean, a unit vector
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();

  void add(const HermiteSample& sample, std::uint32_t crossing) {
    samples[count] = &sample;
    crossings[count++] = crossing;
    any_lesser = any_lesser || sample.has_lesser;
    normal += sample.normal;
    middle += sample.point;
  }
  void close() {
    normal.normalize();
    middle /= static_cast<float>(count);
  }
  [[nodiscard]] std::span<const HermiteSample* const> all() const {
    return std::span(samples).first(count);
  }

  [[nodiscard]] float views() const {
    float sum = 0.0F;
    for (const HermiteSample* sample : all())
      sum += static_cast<float>(sample->views);
    return sum / static_cast<float>(count);
  }
  /// Whether the planes are as good as parallel.
  [[nodiscard]] bool is_flat() const {
    constexpr float kParallel = 0.97F;  // cosine: the second eigenvalue would be below kFlat
    const auto agrees = [&](const HermiteSample* sample) {
      return sample->normal.dot(normal) > kParallel;
    };
    return std::all_of(
        samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(count), agrees);
  }
  /// Of the mean of the crossings, where pixels that two of them share do not average away; and of
  /// where the surface runs between planes that differ by an angle over a cell: when all the bend
  /// is at one end it stays on the chord, in the middle it rises a quarter of angle times edge
  /// above. The planes do not tell which: even odds have the variance of range^2 / 12.
  [[nodiscard]] float variance(float edge_mm) const {
    float sum = 0.0F;
    float common_variance = 0.0F;
    float turn2 = 0.0F;  // square of the largest angle
    for (std::size_t i = 0; i < count; ++i) {
      const HermiteSample& one = *samples[i];
      common_variance += one.common_variance;
      sum += one.noise_mm * one.noise_mm;
      for (std::size_t j = 0; j < i; ++j) {
        const HermiteSample& other = *samples[j];
        const float distance = (one.point - other.point).norm();
        sum += 2.0F * one.noise_mm * other.noise_mm * correlation(distance, one.spacing_mm);
        turn2 = std::max(turn2, (one.normal - other.normal).squaredNorm());
      }
    }
    const auto n = static_cast<float>(count);
    return sum / (n * n) + common_variance / n + turn2 * edge_mm * edge_mm / (16.0F * 12.0F);
  }
};

/// Where the planes meet, within the unit of freedom that `rank` leaves: the middle of the points,
/// moved along the `rank` best determined eigenvectors only.
struct Qef {
  Eigen::Vector3f middle;
  Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
  Eigen::Vector3f gradient = Eigen::Vector3f::Zero();
  Eigen::Matrix3f eigenvectors = Eigen::Matrix3f::Identity();  ///< worst first
  Eigen::Vector3f eigenvalues = Eigen::Vector3f::Zero();
  Eigen::Vector3f projections = Eigen::Vector3f::Zero();

  explicit Qef(const Loop& loop) : middle(loop.middle) {
    for (const HermiteSample* sample : loop.all())
      add(*sample);
  }
  void add(const HermiteSample& sample) {
    spread += sample.normal * sample.normal.transpose();
    gradient += sample.normal * sample.normal.dot(sample.point - middle);
  }
  void solve() {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
    solver.computeDirect(spread);
    eigenvectors = solver.eigenvectors();
    eigenvalues = solver.eigenvalues();
    projections = eigenvectors.transpose() * gradient;
  }

  [[nodiscard]] int rank() const {
    const auto counts = [&](int i) { return eigenvalues[i] > kFlat * eigenvalues[2] ? 1 : 0; };
    return 1 + counts(1) + counts(0);
  }
  [[nodiscard]] Eigen::Vector3f at(int rank) const {
    Eigen::Vector3f point = middle;
    for (int i = 3 - rank; i < 3; ++i)
      point += eigenvectors.col(i) * (projections[i] / eigenvalues[i]);
    return point;
  }
};

/// The middle of planes that are as good as parallel, moved onto them.
///
/// The plane through a point of a curved surface leaves it on one side, the point itself lies on
/// the other side of the plane here: the mean of both normals makes up for the curvature.
Eigen::Vector3f flat_position(const Loop& loop) {
  float offset = 0.0F;
  for (const HermiteSample* sample : loop.all())
    offset += 0.5F * (sample->normal + loop.normal).dot(sample->point - loop.middle);
  return loop.middle + loop.normal * (offset / static_cast<float>(loop.count));
}

/// Adds planes of other faces that run through the cell, too; false when there is none.
bool add_lesser_planes(Qef& qef, const Loop& loop, const PlacementInput& input, const Cell& cell) {
  bool any = false;
  for (std::size_t i = 0; i < loop.count; ++i) {
    if (!loop.samples[i]->has_lesser) continue;
    const std::uint32_t crossing = loop.crossings[i];
    const HermiteSample side = lesser_sample(input.crossings, input.hermite, crossing);
    if (!cell.contains(side.point)) continue;
    qef.add(side);
    any = true;
  }
  return any;
}

/// The qef point, or one that fewer planes or eigenvectors determine, so that it lies in the
/// cell.
Eigen::Vector3f solve_position(const Loop& loop,
                               bool flat,
                               const PlacementInput& input,
                               const Cell& cell) {
  if (loop.any_lesser) {
    Qef qef(loop);
    if (add_lesser_planes(qef, loop, input, cell)) {
      qef.solve();
      Eigen::Vector3f point = qef.at(qef.rank());
      if (cell.contains(point)) return point;
    }
  }
  if (flat) {
    Eigen::Vector3f point = flat_position(loop);
    if (cell.contains(point)) return point;
  }
  Qef qef(loop);
  qef.solve();
  for (int rank = qef.rank(); rank > 0; --rank) {
    Eigen::Vector3f point = qef.at(rank);
    if (cell.contains(point)) return point;
  }
  return qef.at(1).array().max(cell.low).min(cell.high);
}

Eigen::Vector3i corner_offset(int corner) {
  return {corner & 1, corner >> 1 & 1, corner >> 2 & 1};
}

std::array<Loop, 4> loops_at(const PlacementInput& input,
                             const EdgeCrossings::Neighborhood& around,
                             const Eigen::Vector3i& voxel,
                             const CellLoops& shape) {
  std::array<Loop, 4> loops;
  for (int edge = 0; edge < 12; ++edge) {
    const std::uint8_t loop = shape.loop_of_edge[static_cast<std::size_t>(edge)];
    if (loop == CellLoops::kNone) continue;
    const std::uint32_t i = around.crossing(voxel + corner_offset(edge_corners(edge)[0]), edge / 4);
    if (input.samples[i].supported) loops[loop].add(input.samples[i], i);
  }
  return loops;
}

void place_vertex(PlacedVertices& placed,
                  std::size_t vertex,
                  Loop& loop,
                  const PlacementInput& input,
                  const Eigen::Vector3f& low_mm) {
  loop.close();
  const auto edge_mm = static_cast<float>(input.crossings.voxel_mm);
  const bool flat = loop.is_flat();
  Mesh& mesh = placed.mesh;
  const Eigen::Vector3f point =
      solve_position(loop, flat, input, Cell(low_mm, edge_mm, kMaxExcursion * edge_mm));
  const Cell strict(low_mm, edge_mm, -kCellMargin * edge_mm);
  mesh.vertices_mm[vertex] = point;
  placed.sharp[vertex] = flat ? 0 : 1;
  placed.in_cell_mm[vertex] =
      strict.contains(point) ? point : solve_position(loop, flat, input, strict);
  mesh.normals[vertex] = loop.normal;
  mesh.sigma_mm[vertex] = std::sqrt(loop.variance(edge_mm));
  mesh.views[vertex] = static_cast<std::uint16_t>(std::lround(loop.views()));
}

/// Those that no facet holds are dropped in the end, but not before all have been looked at.
void clear_vertices(PlacedVertices& placed, std::size_t begin, std::size_t end) {
  for (Eigen::Vector3f* points :
       {placed.mesh.vertices_mm.data(), placed.mesh.normals.data(), placed.in_cell_mm.data()})
    std::fill(points + begin, points + end, Eigen::Vector3f::Zero());
}

void place_in_block(PlacedVertices& placed, const PlacementInput& input, std::size_t block) {
  const EdgeCrossings& crossings = input.crossings;
  clear_vertices(placed, crossings.first_vertex_of(block), crossings.first_vertex_of(block + 1));
  const EdgeCrossings::Block& cells = *crossings.blocks[block];
  const EdgeCrossings::Neighborhood around = crossings.neighborhood(block);
  const auto& shapes = cell_loops();
  for (int i = 0; i < static_cast<int>(DistanceField::kVoxels); ++i) {
    const auto cell = static_cast<std::size_t>(i);
    const CellLoops& shape = shapes[cells.inside[cell]];
    if (shape.count == 0) continue;
    const Eigen::Vector3i voxel = crossings.block_coords[block] * DistanceField::kEdge +
                                  Eigen::Vector3i(i & 7, i >> 3 & 7, i >> 6);
    auto loops = loops_at(input, around, voxel, shape);
    const Eigen::Vector3f low_mm = voxel.cast<float>() * static_cast<float>(crossings.voxel_mm);
    for (std::uint32_t loop = 0; loop < shape.count; ++loop) {
      if (loops[loop].count != 0)
        place_vertex(placed, cells.first_vertex(cell) + loop, loops[loop], input, low_mm);
    }
  }
}

}  // namespace

PlacedVertices place_vertices(const EdgeCrossings& crossings, const HermiteAccumulators& hermite) {
  const PlacementInput input{crossings, hermite, make_hermite_samples(crossings, hermite)};
  PlacedVertices placed;
  // Eigen's vectors are made unfilled: memory is first touched by the thread that fills it.
  placed.mesh.vertices_mm.resize(crossings.vertices);
  placed.mesh.normals.resize(crossings.vertices);
  placed.in_cell_mm.resize(crossings.vertices);
  placed.mesh.sigma_mm.resize(crossings.vertices);
  placed.mesh.views.resize(crossings.vertices);
  placed.sharp.resize(crossings.vertices);
  parallel_chunks(crossings.blocks.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block)
      place_in_block(placed, input, block);
  });
  return placed;
}

}  // namespace frangia
