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

struct Plane {
  Eigen::Vector3f point;
  Eigen::Vector3f normal;
};

/// The planes through a loop's crossings, and what they know of their noise.
struct Loop {
  std::array<Plane, 12> planes;
  std::size_t count = 0;
  float variance = 0.0F;
  float views = 0.0F;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();

  void add(const Eigen::Vector3f& point, const Evidence& evidence) {
    const Eigen::Vector3f unit = evidence.normal.normalized();
    planes[count++] = {point + unit * evidence.shift_mm(), unit};
    variance += evidence.vertex_variance();
    views += static_cast<float>(evidence.views);
    normal += unit;
  }
};

/// Where the planes meet, within the unit of freedom that `rank` leaves: the middle of the points,
/// moved along the `rank` best determined directions only.
struct Meeting {
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  Eigen::Matrix3f directions = Eigen::Matrix3f::Identity();  ///< worst first
  Eigen::Vector3f strengths = Eigen::Vector3f::Zero();
  Eigen::Vector3f moves = Eigen::Vector3f::Zero();

  explicit Meeting(const Loop& loop) {
    for (std::size_t i = 0; i < loop.count; ++i)
      middle += loop.planes[i].point;
    middle /= static_cast<float>(loop.count);
    Eigen::Matrix3f spread = Eigen::Matrix3f::Zero();
    Eigen::Vector3f pull = Eigen::Vector3f::Zero();
    for (std::size_t i = 0; i < loop.count; ++i) {
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
    return 1 + (strengths[1] > kFlat * strengths[2]) + (strengths[0] > kFlat * strengths[2]);
  }
  [[nodiscard]] Eigen::Vector3f at(int rank) const {
    Eigen::Vector3f point = middle;
    for (int i = 3 - rank; i < 3; ++i)
      point += directions.col(i) * (moves[i] / strengths[i]);
    return point;
  }
};

/// The meeting point, or one that fewer directions determine, so that it stays in its cell: then
/// no triangle about an edge of the grid can turn over.
Eigen::Vector3f place(const Loop& loop, const Eigen::Vector3f& low_mm, float edge_mm) {
  const Meeting meeting(loop);
  constexpr float kRim = 0.02F;  // keeps vertices of neighbouring cells apart
  const Eigen::Array3f low = low_mm.array() + kRim * edge_mm;
  const Eigen::Array3f high = low_mm.array() + (1.0F - kRim) * edge_mm;
  for (int rank = meeting.rank(); rank > 0; --rank) {
    const Eigen::Vector3f point = meeting.at(rank);
    if ((point.array() >= low).all() && (point.array() <= high).all()) return point;
  }
  return meeting.at(1).array().max(low).min(high);
}

Eigen::Vector3i corner_offset(int corner) {
  return {corner & 1, corner >> 1 & 1, corner >> 2 & 1};
}

std::array<Loop, 4> loops_at(const Crossings& crossings,
                             std::span<const Evidence> evidence,
                             const Eigen::Vector3i& voxel,
                             const CellLoops& shape) {
  std::array<Loop, 4> loops;
  for (int edge = 0; edge < 12; ++edge) {
    const std::uint8_t loop = shape.loop_of_edge[static_cast<std::size_t>(edge)];
    if (loop == CellLoops::kNone) continue;
    const std::uint32_t i =
        crossings.crossing(voxel + corner_offset(edge_corners(edge)[0]), edge / 4);
    if (evidence[i].holds()) loops[loop].add(crossings.points_mm[i], evidence[i]);
  }
  return loops;
}

void place_in_block(Mesh& mesh,
                    const Crossings& crossings,
                    std::span<const Evidence> evidence,
                    std::size_t block) {
  const Crossings::Block& cells = crossings.blocks[block];
  const auto edge_mm = static_cast<float>(crossings.voxel_mm);
  for (int i = 0; i < static_cast<int>(DistanceField::kVoxels); ++i) {
    const auto cell = static_cast<std::size_t>(i);
    const CellLoops& shape = cell_loops()[cells.inside[cell]];
    if (shape.count == 0) continue;
    const Eigen::Vector3i voxel =
        crossings.places[block] * DistanceField::kEdge + Eigen::Vector3i(i & 7, i >> 3 & 7, i >> 6);
    const auto loops = loops_at(crossings, evidence, voxel, shape);
    for (std::uint32_t loop = 0; loop < shape.count; ++loop) {
      const Loop& found = loops[loop];
      if (found.count == 0) continue;
      const std::size_t vertex = cells.first_vertex[cell] + loop;
      const auto count = static_cast<float>(found.count);
      mesh.vertices_mm[vertex] = place(found, voxel.cast<float>() * edge_mm, edge_mm);
      mesh.normals[vertex] = found.normal.normalized();
      mesh.sigma_mm[vertex] = std::sqrt(found.variance / count);
      mesh.views[vertex] = static_cast<std::uint16_t>(std::lround(found.views / count));
    }
  }
}

}  // namespace

Mesh place_vertices(const Crossings& crossings, std::span<const Evidence> evidence) {
  Mesh mesh;
  mesh.vertices_mm.assign(crossings.vertices, Eigen::Vector3f::Zero());
  mesh.normals.assign(crossings.vertices, Eigen::Vector3f::Zero());
  mesh.sigma_mm.assign(crossings.vertices, 0.0F);
  mesh.views.assign(crossings.vertices, 0);
  parallel_chunks(crossings.blocks.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      place_in_block(mesh, crossings, evidence, block);
    }
  });
  return mesh;
}

}  // namespace frangia
