#include "frangia/surface/place_vertices.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <Eigen/Eigenvalues>

#include "frangia/core/parallel.h"
#include "frangia/surface/cell_loops.h"
#include "frangia/surface/facets.h"

namespace frangia {
namespace {

/// Eigenvalues of sum n n^T below this part of the largest are noise: two faces that meet at less
/// than 25 degrees are taken for one.
constexpr float kFlat = 0.05F;

constexpr float kRoam = 0.5F;  // voxels that a vertex may leave its cell by
constexpr float kRim = 1e-3F;  // voxels that keep those within apart from their neighbours

/// A cell, or one grown by `margin` on every side.
struct Cell {
  Cell(const Eigen::Vector3f& low_mm, float edge_mm, float margin_mm)
      : low(low_mm.array() - margin_mm), high(low_mm.array() + edge_mm + margin_mm) {}

  [[nodiscard]] bool holds(const Eigen::Vector3f& point) const {
    return (point.array() >= low).all() && (point.array() <= high).all();
  }
  Eigen::Array3f low;
  Eigen::Array3f high;
};

/// What there is to place vertices by.
struct Ground {
  const Crossings& crossings;
  const Evidences& evidence;
  Facets facets;
};

/// The facets around a loop whose crossings hold.
struct Loop {
  std::array<const Facet*, 12> facets;  ///< `count` of them
  std::array<std::uint32_t, 12> crossings;
  std::size_t count = 0;
  bool has_sides = false;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< their mean, a unit vector
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();

  void add(const Facet& facet, std::uint32_t crossing) {
    facets[count] = &facet;
    crossings[count++] = crossing;
    has_sides = has_sides || facet.has_side;
    normal += facet.normal;
    middle += facet.point;
  }
  void close() {
    normal.normalize();
    middle /= static_cast<float>(count);
  }
  [[nodiscard]] std::span<const Facet* const> all() const { return std::span(facets).first(count); }

  [[nodiscard]] float views() const {
    float sum = 0.0F;
    for (const Facet* facet : all())
      sum += static_cast<float>(facet->views);
    return sum / static_cast<float>(count);
  }
  /// Whether the planes are as good as parallel.
  [[nodiscard]] bool is_flat() const {
    constexpr float kParallel = 0.97F;  // cosine: the second eigenvalue would be below kFlat
    const auto agrees = [&](const Facet* facet) { return facet->normal.dot(normal) > kParallel; };
    return std::all_of(facets.begin(), facets.begin() + static_cast<std::ptrdiff_t>(count), agrees);
  }
  /// Of the mean of the crossings, where pixels that two of them share do not average away; and of
  /// where the surface runs between planes that differ by an angle over a cell: when all the bend
  /// is at one end it stays on the chord, in the middle it rises a quarter of angle times edge
  /// above. The planes do not tell which: even odds have the variance of range^2 / 12.
  [[nodiscard]] float variance(float edge_mm) const {
    float sum = 0.0F;
    float common = 0.0F;
    float bend = 0.0F;  // square of the largest angle
    for (std::size_t i = 0; i < count; ++i) {
      const Facet& one = *facets[i];
      common += one.common;
      sum += one.noise_mm * one.noise_mm;
      for (std::size_t j = 0; j < i; ++j) {
        const Facet& other = *facets[j];
        const float distance = (one.point - other.point).norm();
        sum += 2.0F * one.noise_mm * other.noise_mm * correlation(distance, one.spacing_mm);
        bend = std::max(bend, (one.normal - other.normal).squaredNorm());
      }
    }
    const auto n = static_cast<float>(count);
    return sum / (n * n) + common / n + bend * edge_mm * edge_mm / (16.0F * 12.0F);
  }
};

/// Where the planes meet, within the unit of freedom that `rank` leaves: the middle of the points,
/// moved along the `rank` best determined directions only.
struct Meeting {
  Eigen::Vector3f middle;
  Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
  Eigen::Vector3f pull = Eigen::Vector3f::Zero();
  Eigen::Matrix3f directions = Eigen::Matrix3f::Identity();  ///< worst first
  Eigen::Vector3f strengths = Eigen::Vector3f::Zero();
  Eigen::Vector3f moves = Eigen::Vector3f::Zero();

  explicit Meeting(const Loop& loop) : middle(loop.middle) {
    for (const Facet* facet : loop.all())
      add(*facet);
  }
  void add(const Facet& facet) {
    spread += facet.normal * facet.normal.transpose();
    pull += facet.normal * facet.normal.dot(facet.point - middle);
  }
  void solve() {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
    solver.computeDirect(spread);
    directions = solver.eigenvectors();
    strengths = solver.eigenvalues();
    moves = directions.transpose() * pull;
  }

  [[nodiscard]] int rank() const {
    const auto counts = [&](int i) { return strengths[i] > kFlat * strengths[2] ? 1 : 0; };
    return 1 + counts(1) + counts(0);
  }
  [[nodiscard]] Eigen::Vector3f at(int rank) const {
    Eigen::Vector3f point = middle;
    for (int i = 3 - rank; i < 3; ++i)
      point += directions.col(i) * (moves[i] / strengths[i]);
    return point;
  }
};

/// The middle of planes that are as good as parallel, moved onto them.
///
/// The plane through a point of a curved surface leaves it on one side, the point itself lies on
/// the other side of the plane here: the mean of both normals makes up for the curvature.
Eigen::Vector3f flat_place(const Loop& loop) {
  float offset = 0.0F;
  for (const Facet* facet : loop.all())
    offset += 0.5F * (facet->normal + loop.normal).dot(facet->point - loop.middle);
  return loop.middle + loop.normal * (offset / static_cast<float>(loop.count));
}

/// Adds planes of other faces that run through the cell, too; false when there is none.
bool add_sides(Meeting& meeting, const Loop& loop, const Ground& ground, const Cell& cell) {
  bool any = false;
  for (std::size_t i = 0; i < loop.count; ++i) {
    if (!loop.facets[i]->has_side) continue;
    const std::uint32_t crossing = loop.crossings[i];
    const Facet side = side_facet(ground.crossings, ground.evidence, crossing);
    if (!cell.holds(side.point)) continue;
    meeting.add(side);
    any = true;
  }
  return any;
}

/// The meeting point, or one that fewer planes or directions determine, so that it lies in the
/// cell.
Eigen::Vector3f place(const Loop& loop, bool flat, const Ground& ground, const Cell& cell) {
  if (loop.has_sides) {
    Meeting meeting(loop);
    if (add_sides(meeting, loop, ground, cell)) {
      meeting.solve();
      Eigen::Vector3f point = meeting.at(meeting.rank());
      if (cell.holds(point)) return point;
    }
  }
  if (flat) {
    Eigen::Vector3f point = flat_place(loop);
    if (cell.holds(point)) return point;
  }
  Meeting meeting(loop);
  meeting.solve();
  for (int rank = meeting.rank(); rank > 0; --rank) {
    Eigen::Vector3f point = meeting.at(rank);
    if (cell.holds(point)) return point;
  }
  return meeting.at(1).array().max(cell.low).min(cell.high);
}

Eigen::Vector3i corner_offset(int corner) {
  return {corner & 1, corner >> 1 & 1, corner >> 2 & 1};
}

std::array<Loop, 4> loops_at(const Ground& ground,
                             const Crossings::Around& around,
                             const Eigen::Vector3i& voxel,
                             const CellLoops& shape) {
  std::array<Loop, 4> loops;
  for (int edge = 0; edge < 12; ++edge) {
    const std::uint8_t loop = shape.loop_of_edge[static_cast<std::size_t>(edge)];
    if (loop == CellLoops::kNone) continue;
    const std::uint32_t i = around.crossing(voxel + corner_offset(edge_corners(edge)[0]), edge / 4);
    if (ground.facets[i].holds) loops[loop].add(ground.facets[i], i);
  }
  return loops;
}

void place_vertex(PlacedVertices& placed,
                  std::size_t vertex,
                  Loop& loop,
                  const Ground& ground,
                  const Eigen::Vector3f& low_mm) {
  loop.close();
  const auto edge_mm = static_cast<float>(ground.crossings.voxel_mm);
  const bool flat = loop.is_flat();
  Mesh& mesh = placed.mesh;
  const Eigen::Vector3f point = place(loop, flat, ground, Cell(low_mm, edge_mm, kRoam * edge_mm));
  const Cell strict(low_mm, edge_mm, -kRim * edge_mm);
  mesh.vertices_mm[vertex] = point;
  placed.sharp[vertex] = flat ? 0 : 1;
  placed.within_mm[vertex] = strict.holds(point) ? point : place(loop, flat, ground, strict);
  mesh.normals[vertex] = loop.normal;
  mesh.sigma_mm[vertex] = std::sqrt(loop.variance(edge_mm));
  mesh.views[vertex] = static_cast<std::uint16_t>(std::lround(loop.views()));
}

/// Those that no facet holds are dropped in the end, but not before all have been looked at.
void clear_vertices(PlacedVertices& placed, std::size_t begin, std::size_t end) {
  for (Eigen::Vector3f* points :
       {placed.mesh.vertices_mm.data(), placed.mesh.normals.data(), placed.within_mm.data()})
    std::fill(points + begin, points + end, Eigen::Vector3f::Zero());
}

void place_in_block(PlacedVertices& placed, const Ground& ground, std::size_t block) {
  const Crossings& crossings = ground.crossings;
  clear_vertices(placed, crossings.first_vertex_of(block), crossings.first_vertex_of(block + 1));
  const Crossings::Block& cells = *crossings.blocks[block];
  const Crossings::Around around = crossings.around(block);
  const auto& shapes = cell_loops();
  for (int i = 0; i < static_cast<int>(DistanceField::kVoxels); ++i) {
    const auto cell = static_cast<std::size_t>(i);
    const CellLoops& shape = shapes[cells.inside[cell]];
    if (shape.count == 0) continue;
    const Eigen::Vector3i voxel =
        crossings.places[block] * DistanceField::kEdge + Eigen::Vector3i(i & 7, i >> 3 & 7, i >> 6);
    auto loops = loops_at(ground, around, voxel, shape);
    const Eigen::Vector3f low_mm = voxel.cast<float>() * static_cast<float>(crossings.voxel_mm);
    for (std::uint32_t loop = 0; loop < shape.count; ++loop) {
      if (loops[loop].count != 0)
        place_vertex(placed, cells.first_vertex(cell) + loop, loops[loop], ground, low_mm);
    }
  }
}

}  // namespace

PlacedVertices place_vertices(const Crossings& crossings, const Evidences& evidence) {
  const Ground ground{crossings, evidence, make_facets(crossings, evidence)};
  PlacedVertices placed;
  // Eigen's vectors are made unfilled: memory is first touched by the thread that fills it.
  placed.mesh.vertices_mm.resize(crossings.vertices);
  placed.mesh.normals.resize(crossings.vertices);
  placed.within_mm.resize(crossings.vertices);
  placed.mesh.sigma_mm.resize(crossings.vertices);
  placed.mesh.views.resize(crossings.vertices);
  placed.sharp.resize(crossings.vertices);
  parallel_chunks(crossings.blocks.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block)
      place_in_block(placed, ground, block);
  });
  return placed;
}

}  // namespace frangia
