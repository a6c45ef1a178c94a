#include "frangia/surface/place_vertices.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

#include "frangia/core/parallel.h"
#include "frangia/surface/cell_loops.h"

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

struct Plane {
  Eigen::Vector3f point;
  Eigen::Vector3f normal;
};

Plane plane_at(const Eigen::Vector3f& point, const Evidence::Face& face) {
  const Eigen::Vector3f unit = face.normal.normalized();
  return {point - unit * face.distance_mm(), unit};
}

/// The crossings of a loop that hold, and the planes through them.
struct Loop {
  std::array<Plane, 24> planes;  ///< first the main faces, then those beside
  std::size_t count = 0;         ///< of crossings
  std::size_t all = 0;           ///< of planes
  std::array<const Evidence*, 12> evidence{};

  void add(const Eigen::Vector3f& point, const Evidence& found) {
    evidence[count] = &found;
    planes[count++] = plane_at(point, found.main());
    all = count;
  }
  /// Planes of other faces that run through the cell, too.
  void add_sides(const Cell& cell) {
    constexpr float kSpeaks = 0.1F;  // of the main face's weight
    all = count;
    for (std::size_t i = 0; i < count; ++i) {
      const Evidence::Face& side = evidence[i]->side();
      const Evidence::Face& face = evidence[i]->main();
      if (side.weight < kSpeaks * face.weight || side.views == 0) continue;
      const Eigen::Vector3f origin = planes[i].point + planes[i].normal * face.distance_mm();
      const Plane plane = plane_at(origin, side);
      if (cell.holds(plane.point)) planes[all++] = plane;
    }
  }
  [[nodiscard]] Eigen::Vector3f normal() const {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (std::size_t i = 0; i < count; ++i)
      sum += planes[i].normal;
    return sum.normalized();
  }
  [[nodiscard]] float views() const {
    float sum = 0.0F;
    for (std::size_t i = 0; i < count; ++i)
      sum += static_cast<float>(evidence[i]->main().views);
    return sum / static_cast<float>(count);
  }
  /// Of where the surface runs between planes that differ by an angle over a cell: when all the
  /// bend is at one end it stays on the chord, in the middle it rises a quarter of angle times edge
  /// above. The planes do not tell which: even odds have the variance of range^2 / 12.
  [[nodiscard]] float bend_variance(float edge_mm) const {
    float square = 0.0F;  // of the largest angle
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < i; ++j)
        square = std::max(square, (planes[i].normal - planes[j].normal).squaredNorm());
    }
    return square * edge_mm * edge_mm / (16.0F * 12.0F);
  }
  /// Of the mean of the crossings: pixels that two of them share do not average away.
  [[nodiscard]] float variance() const {
    float sum = 0.0F;
    float common = 0.0F;
    std::array<float, 12> noise{};
    for (std::size_t i = 0; i < count; ++i) {
      const Evidence::Face& face = evidence[i]->main();
      common += evidence[i]->common;
      noise[i] = std::sqrt(face.noise_squared) / face.weight;
      sum += noise[i] * noise[i];
      for (std::size_t j = 0; j < i; ++j) {
        const float distance = (planes[i].point - planes[j].point).norm();
        sum += 2.0F * noise[i] * noise[j] * correlation(distance, face.spacing_mm());
      }
    }
    const auto n = static_cast<float>(count);
    return sum / (n * n) + common / n;
  }
};

/// Where the planes meet, within the unit of freedom that `rank` leaves: the middle of the points,
/// moved along the `rank` best determined directions only.
struct Meeting {
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  Eigen::Matrix3f directions = Eigen::Matrix3f::Identity();  ///< worst first
  Eigen::Vector3f strengths = Eigen::Vector3f::Zero();
  Eigen::Vector3f moves = Eigen::Vector3f::Zero();

  Meeting(const Loop& loop, std::size_t count) {
    for (std::size_t i = 0; i < loop.count; ++i)
      middle += loop.planes[i].point;
    middle /= static_cast<float>(loop.count);
    Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
    Eigen::Vector3f pull = Eigen::Vector3f::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      const Plane& plane = loop.planes[i];
      spread += plane.normal * plane.normal.transpose();
      pull += plane.normal * plane.normal.dot(plane.point - middle);
    }
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

/// Whether the planes through the crossings are as good as parallel.
bool is_flat(const Loop& loop) {
  constexpr float kParallel = 0.97F;  // cosine: the second eigenvalue would be below kFlat
  const Eigen::Vector3f normal = loop.normal();
  return std::all_of(loop.planes.begin(),
                     loop.planes.begin() + static_cast<std::ptrdiff_t>(loop.count),
                     [&](const Plane& plane) { return plane.normal.dot(normal) > kParallel; });
}

/// The middle of planes that are as good as parallel, moved onto them.
///
/// The plane through a point of a curved surface leaves it on one side, the point itself lies on
/// the other side of the plane here: the mean of both normals makes up for the curvature.
Eigen::Vector3f flat_place(const Loop& loop) {
  const Eigen::Vector3f normal = loop.normal();
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < loop.count; ++i)
    middle += loop.planes[i].point;
  middle /= static_cast<float>(loop.count);
  float offset = 0.0F;
  for (std::size_t i = 0; i < loop.count; ++i) {
    const Plane& plane = loop.planes[i];
    offset += 0.5F * (plane.normal + normal).dot(plane.point - middle);
  }
  return middle + normal * (offset / static_cast<float>(loop.count));
}

/// The meeting point, or one that fewer planes or directions determine, so that it lies in the
/// cell.
Eigen::Vector3f place(Loop& loop, const Cell& cell) {
  loop.add_sides(cell);
  if (loop.all > loop.count) {
    const Meeting meeting(loop, loop.all);
    Eigen::Vector3f point = meeting.at(meeting.rank());
    if (cell.holds(point)) return point;
  }
  if (is_flat(loop)) {
    Eigen::Vector3f point = flat_place(loop);
    if (cell.holds(point)) return point;
  }
  const Meeting meeting(loop, loop.count);
  for (int rank = meeting.rank(); rank > 0; --rank) {
    Eigen::Vector3f point = meeting.at(rank);
    if (cell.holds(point)) return point;
  }
  return meeting.at(1).array().max(cell.low).min(cell.high);
}

Eigen::Vector3i corner_offset(int corner) {
  return {corner & 1, corner >> 1 & 1, corner >> 2 & 1};
}

std::array<Loop, 4> loops_at(const Crossings& crossings,
                             const Crossings::Around& around,
                             std::span<const Evidence> evidence,
                             const Eigen::Vector3i& voxel,
                             const CellLoops& shape) {
  std::array<Loop, 4> loops;
  for (int edge = 0; edge < 12; ++edge) {
    const std::uint8_t loop = shape.loop_of_edge[static_cast<std::size_t>(edge)];
    if (loop == CellLoops::kNone) continue;
    const std::uint32_t i = around.crossing(voxel + corner_offset(edge_corners(edge)[0]), edge / 4);
    if (evidence[i].holds()) loops[loop].add(crossings.points_mm[i], evidence[i]);
  }
  return loops;
}

void place_in_block(PlacedVertices& placed,
                    const Crossings& crossings,
                    std::span<const Evidence> evidence,
                    std::size_t block) {
  Mesh& mesh = placed.mesh;
  const Crossings::Block& cells = *crossings.blocks[block];
  const Crossings::Around around = crossings.around(block);
  const auto edge_mm = static_cast<float>(crossings.voxel_mm);
  for (int i = 0; i < static_cast<int>(DistanceField::kVoxels); ++i) {
    const auto cell = static_cast<std::size_t>(i);
    const CellLoops& shape = cell_loops()[cells.inside[cell]];
    if (shape.count == 0) continue;
    const Eigen::Vector3i voxel =
        crossings.places[block] * DistanceField::kEdge + Eigen::Vector3i(i & 7, i >> 3 & 7, i >> 6);
    auto loops = loops_at(crossings, around, evidence, voxel, shape);
    for (std::uint32_t loop = 0; loop < shape.count; ++loop) {
      Loop& found = loops[loop];
      if (found.count == 0) continue;
      const std::size_t vertex = cells.first_vertex[cell] + loop;
      const Eigen::Vector3f low = voxel.cast<float>() * edge_mm;
      mesh.vertices_mm[vertex] = place(found, Cell(low, edge_mm, kRoam * edge_mm));
      placed.sharp[vertex] = is_flat(found) ? 0 : 1;
      const Cell strict(low, edge_mm, -kRim * edge_mm);
      const bool within = strict.holds(mesh.vertices_mm[vertex]);
      placed.within_mm[vertex] = within ? mesh.vertices_mm[vertex] : place(found, strict);
      mesh.normals[vertex] = found.normal();
      mesh.sigma_mm[vertex] = std::sqrt(found.variance() + found.bend_variance(edge_mm));
      mesh.views[vertex] = static_cast<std::uint16_t>(std::lround(found.views()));
    }
  }
}

}  // namespace

PlacedVertices place_vertices(const Crossings& crossings, std::span<const Evidence> evidence) {
  PlacedVertices placed;
  placed.mesh.vertices_mm.assign(crossings.vertices, Eigen::Vector3f::Zero());
  placed.mesh.normals.assign(crossings.vertices, Eigen::Vector3f::Zero());
  placed.mesh.sigma_mm.assign(crossings.vertices, 0.0F);
  placed.mesh.views.assign(crossings.vertices, 0);
  placed.sharp.assign(crossings.vertices, 0);
  placed.within_mm = placed.mesh.vertices_mm;
  parallel_chunks(crossings.blocks.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      place_in_block(placed, crossings, evidence, block);
    }
  });
  return placed;
}

}  // namespace frangia
