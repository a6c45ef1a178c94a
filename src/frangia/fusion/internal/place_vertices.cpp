#include "frangia/fusion/internal/place_vertices.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

#include "frangia/core/parallel.h"
#include "frangia/fusion/internal/cell_loops.h"
#include "frangia/fusion/internal/hermite_accumulators.h"

namespace frangia {
namespace {

constexpr float kCellMargin = 1e-3F;  // voxels between the positions in neighbouring cells

struct PlacementInput {
  const EdgeCrossings& crossings;
  const HermiteAccumulators& hermite;
  HermiteSamples samples;
  float edge_mm;
  float min_eigenvalue;
  float parallel_cosine;
  float max_excursion_mm;
  float correlation_px;
};

float mean_views(const LoopSamples& loop) {
  float sum = 0.0F;
  for (const HermiteSample* sample : loop.all())
    sum += static_cast<float>(sample->views);
  return sum / static_cast<float>(loop.count);
}

/// Variance of a vertex, mm2.
struct VertexVariance {
  float of_samples = 0.0F;
  float of_bend = 0.0F;  ///< see `variance_of`
};

/// Returns the variance of the mean of the samples, and that of the curvature. `flat`: the planes
/// belong to one face; otherwise the vertex was placed where they meet.
///
/// The noise of samples that share pixels is correlated and does not average out. The common
/// variance does not average out either. Between planes that differ by an angle over a cell, the
/// surface bends somewhere: at one end of the cell it stays on the chord, in the middle it rises
/// angle * edge / 4 above. Evenly distributed over that range, its variance is range^2 / 12. Planes
/// of two faces do not bend: there the vertex is off by what the planes do, which the views fit to
/// within `kMostTurn` near an edge.
VertexVariance variance_of(const LoopSamples& loop, bool flat, const PlacementInput& input) {
  // Vertices on the edges of simulated shafts, brackets, blades and blocks are 0.02 to 0.05 voxels
  // off, whatever the angle of the edge.
  constexpr float kMostTurn = 0.6F;
  float sum = 0.0F;
  float common_variance = 0.0F;
  float largest_turn2 = 0.0F;
  for (std::size_t i = 0; i < loop.count; ++i) {
    const HermiteSample& one = *loop.samples[i];
    common_variance += one.common_variance;
    sum += one.noise_mm * one.noise_mm;
    for (std::size_t j = 0; j < i; ++j) {
      const HermiteSample& other = *loop.samples[j];
      const float distance = (one.point - other.point).norm();
      sum += 2.0F * one.noise_mm * other.noise_mm *
             correlation(distance, input.correlation_px * one.spacing_mm);
      largest_turn2 = std::max(largest_turn2, (one.normal - other.normal).squaredNorm());
    }
  }
  if (!flat) largest_turn2 = std::min(largest_turn2, kMostTurn * kMostTurn);
  const auto n = static_cast<float>(loop.count);
  return {sum / (n * n) + common_variance / n,
          largest_turn2 * input.edge_mm * input.edge_mm / (16.0F * 12.0F)};
}

Eigen::Vector3i corner_offset(int corner) {
  return {corner & 1, corner >> 1 & 1, corner >> 2 & 1};
}

std::array<LoopSamples, 4> loops_at(const PlacementInput& input,
                                    const EdgeCrossings::Neighborhood& around,
                                    const Eigen::Vector3i& voxel,
                                    const CellLoops& shape) {
  std::array<LoopSamples, 4> loops;
  for (int edge = 0; edge < 12; ++edge) {
    const std::uint8_t loop = shape.loop_of_edge[static_cast<std::size_t>(edge)];
    if (loop == CellLoops::kNone) continue;
    const std::uint32_t i = around.crossing(voxel + corner_offset(edge_corners(edge)[0]), edge / 4);
    const HermiteSample& sample = input.samples[i];
    if (!sample.supported) continue;
    loops[loop].add(sample);
    if (input.hermite.has_systematic()) loops[loop].systematic_mm += input.hermite.systematic_mm(i);
    if (sample.has_lesser) {
      loops[loop].lesser[loops[loop].lesser_count++] =
          lesser_sample(input.crossings, input.hermite, i);
    }
  }
  return loops;
}

void place_vertex(PlacedVertices& placed,
                  std::size_t vertex,
                  LoopSamples& loop,
                  const PlacementInput& input,
                  const Eigen::Vector3f& low_mm) {
  loop.close();
  const bool flat = is_flat(loop, input.parallel_cosine);
  Mesh& mesh = placed.mesh;
  const Eigen::Vector3f point = solve_position(
      loop, flat, input.min_eigenvalue, CellBox(low_mm, input.edge_mm, input.max_excursion_mm));
  const CellBox cell(low_mm, input.edge_mm, -kCellMargin * input.edge_mm);
  mesh.vertices_mm[vertex] = point;
  placed.sharp[vertex] = flat ? 0 : 1;
  placed.in_cell_mm[vertex] =
      cell.contains(point) ? point : solve_position(loop, flat, input.min_eigenvalue, cell);
  mesh.normals[vertex] = loop.normal;
  const VertexVariance variance = variance_of(loop, flat, input);
  mesh.sigma_mm[vertex] = std::sqrt(variance.of_samples + variance.of_bend);
  placed.bend_mm[vertex] = std::sqrt(variance.of_bend);
  if (input.hermite.has_systematic())
    mesh.sigma_systematic_mm[vertex] = loop.systematic_mm / static_cast<float>(loop.count);
  mesh.views[vertex] = static_cast<std::uint16_t>(std::lround(mean_views(loop)));
}

/// Initializes a range of vertices. Those without a supported crossing stay zero; `clean_mesh`
/// removes them later as unused.
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
    const Eigen::Vector3i voxel =
        crossings.block_coords[block] * kBlockEdge + Eigen::Vector3i(i & 7, i >> 3 & 7, i >> 6);
    auto loops = loops_at(input, around, voxel, shape);
    const Eigen::Vector3f low_mm = voxel.cast<float>() * static_cast<float>(crossings.voxel_mm);
    for (std::uint32_t loop = 0; loop < shape.count; ++loop) {
      if (loops[loop].count != 0)
        place_vertex(placed, cells.first_vertex(cell) + loop, loops[loop], input, low_mm);
    }
  }
}

}  // namespace

PlacedVertices place_vertices(const EdgeCrossings& crossings,
                              const HermiteAccumulators& hermite,
                              const FusionParameters& parameters) {
  const VertexParameters& vertices = parameters.vertices;
  const auto edge_mm = static_cast<float>(crossings.voxel_mm);
  const PlacementInput input{crossings,
                             hermite,
                             make_hermite_samples(crossings, hermite, parameters.hermite),
                             edge_mm,
                             static_cast<float>(vertices.min_eigenvalue),
                             static_cast<float>(std::cos(vertices.parallel_rad)),
                             static_cast<float>(vertices.max_excursion_voxels) * edge_mm,
                             static_cast<float>(vertices.correlation_px)};
  PlacedVertices placed;
  // The vectors of Eigen types stay uninitialized, so that the thread that fills them touches
  // their memory first.
  placed.mesh.vertices_mm.resize(crossings.vertices);
  placed.mesh.normals.resize(crossings.vertices);
  placed.in_cell_mm.resize(crossings.vertices);
  placed.mesh.sigma_mm.resize(crossings.vertices);
  if (hermite.has_systematic()) placed.mesh.sigma_systematic_mm.resize(crossings.vertices);
  placed.mesh.views.resize(crossings.vertices);
  placed.sharp.resize(crossings.vertices);
  placed.bend_mm.resize(crossings.vertices);
  parallel_chunks(crossings.blocks.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block)
      place_in_block(placed, input, block);
  });
  return placed;
}

namespace {

/// Quadratic error function: the sum of squared distances from planes, about the mean of their
/// points.
struct Qef {
  Eigen::Vector3f middle;
  Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
  Eigen::Vector3f gradient = Eigen::Vector3f::Zero();
  Eigen::Matrix3f eigenvectors = Eigen::Matrix3f::Identity();  ///< ascending by eigenvalue
  Eigen::Vector3f eigenvalues = Eigen::Vector3f::Zero();
  Eigen::Vector3f projections = Eigen::Vector3f::Zero();

  explicit Qef(const LoopSamples& loop) : middle(loop.middle) {
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

  /// The number of eigenvalues above the noise.
  [[nodiscard]] int rank(float min_eigenvalue) const {
    const auto counts = [&](int i) {
      return eigenvalues[i] > min_eigenvalue * eigenvalues[2] ? 1 : 0;
    };
    return 1 + counts(1) + counts(0);
  }
  /// The minimum in the directions of the `rank` largest eigenvalues.
  [[nodiscard]] Eigen::Vector3f minimum(int rank) const {
    Eigen::Vector3f point = middle;
    for (int i = 3 - rank; i < 3; ++i)
      point += eigenvectors.col(i) * (projections[i] / eigenvalues[i]);
    return point;
  }
};

/// Returns the mean point, moved onto the mean of parallel planes.
///
/// A tangent plane of a curved surface lies on one side of the surface; a point of the surface lies
/// on the other side of the tangent plane at the mean point. The mean of both normals cancels the
/// curvature to second order.
Eigen::Vector3f flat_position(const LoopSamples& loop) {
  float offset = 0.0F;
  for (const HermiteSample* sample : loop.all())
    offset += 0.5F * (sample->normal + loop.normal).dot(sample->point - loop.middle);
  return loop.middle + loop.normal * (offset / static_cast<float>(loop.count));
}

/// Adds the planes of second faces that run through the cell; returns false without any.
bool add_lesser_planes(Qef& qef, const LoopSamples& loop, const CellBox& cell) {
  bool any = false;
  for (const HermiteSample& sample : std::span(loop.lesser).first(loop.lesser_count)) {
    if (!cell.contains(sample.point)) continue;
    qef.add(sample);
    any = true;
  }
  return any;
}

}  // namespace

bool is_flat(const LoopSamples& loop, float parallel_cosine) {
  const auto samples = loop.all();
  return std::all_of(samples.begin(), samples.end(), [&](const HermiteSample* sample) {
    return sample->normal.dot(loop.normal) > parallel_cosine;
  });
}

Eigen::Vector3f solve_position(const LoopSamples& loop,
                               bool flat,
                               float min_eigenvalue,
                               const CellBox& cell) {
  if (loop.lesser_count != 0) {
    Qef qef(loop);
    if (add_lesser_planes(qef, loop, cell)) {
      qef.solve();
      Eigen::Vector3f point = qef.minimum(qef.rank(min_eigenvalue));
      if (cell.contains(point)) return point;
    }
  }
  if (flat) {
    Eigen::Vector3f point = flat_position(loop);
    if (cell.contains(point)) return point;
  }
  Qef qef(loop);
  qef.solve();
  for (int rank = qef.rank(min_eigenvalue); rank > 0; --rank) {
    Eigen::Vector3f point = qef.minimum(rank);
    if (cell.contains(point)) return point;
  }
  return qef.minimum(1).array().max(cell.low).min(cell.high);
}

}  // namespace frangia
