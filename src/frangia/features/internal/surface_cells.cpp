#include "frangia/features/internal/surface_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "frangia/features/fit_shape.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

/// Place of a cell in the grid and the coordinate axis of its normals, as one number.
class CellKeys {
 public:
  CellKeys(const FeaturePoints& points, double edge_mm) : edge_mm_(edge_mm) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& point : points.points_mm)
      box.extend(point);
    origin_ = box.min() - Vector3d::Constant(edge_mm);
    for (int i = 0; i < 3; ++i)
      size_[static_cast<std::size_t>(i)] =
          static_cast<std::uint64_t>(box.sizes()[i] / edge_mm) + 3U;
  }
  [[nodiscard]] std::uint64_t of(const Vector3d& point, const Vector3d& normal) const {
    Eigen::Index side = 0;
    normal.cwiseAbs().maxCoeff(&side);
    const std::uint64_t side6 =
        2U * static_cast<std::uint64_t>(side) + (normal[side] < 0.0 ? 1U : 0U);
    const Vector3d place = (point - origin_) / edge_mm_;
    const auto x = static_cast<std::uint64_t>(place.x());
    const auto y = static_cast<std::uint64_t>(place.y());
    const auto z = static_cast<std::uint64_t>(place.z());
    return ((z * size_[1] + y) * size_[0] + x) * 6U + side6;
  }
  /// The key of the first of the six cells at a place near that of `key`.
  [[nodiscard]] std::uint64_t beside(std::uint64_t key, int dx, int dy, int dz) const {
    const auto sx = static_cast<std::int64_t>(size_[0]);
    const auto sy = static_cast<std::int64_t>(size_[1]);
    return (key / 6U + static_cast<std::uint64_t>((dz * sy + dy) * sx + dx)) * 6U;
  }

 private:
  double edge_mm_;
  Vector3d origin_;
  std::array<std::uint64_t, 3> size_{};
};

void add_means(SurfaceCells& cells, const FeaturePoints& points) {
  for (std::uint32_t cell = 0; cell + 1 < cells.first_point.size(); ++cell) {
    Vector3d mean = Vector3d::Zero();
    Vector3d normal = Vector3d::Zero();
    const auto own = cells.points_of(cell);
    for (const std::uint32_t point : own) {
      mean += points.points_mm[point];
      normal += points.normals[point];
    }
    mean /= static_cast<double>(own.size());
    std::uint32_t nearest = own.front();
    for (const std::uint32_t point : own) {
      if ((points.points_mm[point] - mean).squaredNorm() <
          (points.points_mm[nearest] - mean).squaredNorm())
        nearest = point;
    }
    cells.points_mm.push_back(points.points_mm[nearest]);
    cells.normals.push_back(normal.squaredNorm() > 0.0 ? normal.normalized()
                                                       : points.normals[nearest]);
  }
}

}  // namespace

SurfaceCells surface_cells(const FeaturePoints& points, std::size_t count, const Run& run) {
  SurfaceCells cells;
  cells.edge_mm = std::sqrt(points.area_mm2 / static_cast<double>(std::max<std::size_t>(1, count)));
  const CellKeys keys(points, cells.edge_mm);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i)
    sorted[i] = {keys.of(points.points_mm[i], points.normals[i]), i};
  run.check();
  std::sort(sorted.begin(), sorted.end());
  run.check();
  std::vector<std::uint64_t> own_keys;
  for (std::uint32_t i = 0; i < sorted.size(); ++i) {
    if (i == 0 || sorted[i].first != sorted[i - 1].first) {
      own_keys.push_back(sorted[i].first);
      cells.first_point.push_back(i);
    }
    cells.point_numbers.push_back(sorted[i].second);
  }
  cells.first_point.push_back(static_cast<std::uint32_t>(sorted.size()));
  add_means(cells, points);
  run.check();

  constexpr double kLeastCosine = 0.5;  // between the normals of neighbours
  for (std::uint32_t cell = 0; cell < cells.size(); ++cell) {
    cells.first_neighbor.push_back(static_cast<std::uint32_t>(cells.neighbors.size()));
    for (int place = 0; place < 9; ++place) {
      // Cells that follow each other along x have keys that follow each other.
      const std::uint64_t from = keys.beside(own_keys[cell], -1, place % 3 - 1, place / 3 - 1);
      auto at = std::lower_bound(own_keys.begin(), own_keys.end(), from);
      for (; at != own_keys.end() && *at < from + 18U; ++at) {
        const auto other = static_cast<std::uint32_t>(at - own_keys.begin());
        if (other != cell && cells.normals[cell].dot(cells.normals[other]) > kLeastCosine)
          cells.neighbors.push_back(other);
      }
    }
  }
  cells.first_neighbor.push_back(static_cast<std::uint32_t>(cells.neighbors.size()));
  return cells;
}

namespace {

constexpr double kPatchCosine = 0.94;   ///< between neighbours in a patch: 20 degrees
constexpr std::size_t kFitCells = 500;  ///< of a region that a fit uses
constexpr int kRounds = 8;              ///< of growing and fitting
constexpr double kSettled = 0.02;       ///< relative growth that ends the rounds

}  // namespace

std::vector<std::uint32_t> thinned(const std::vector<std::uint32_t>& cells, std::size_t most) {
  if (cells.size() <= most) return cells;
  std::vector<std::uint32_t> some;
  some.reserve(most);
  for (std::size_t i = 0; i < most; ++i)
    some.push_back(cells[i * cells.size() / most]);
  return some;
}

double side_of(const Shape& shape,
               const SurfaceCells& cells,
               std::span<const std::uint32_t> chosen) {
  double sum = 0.0;
  for (const std::uint32_t cell : chosen) {
    const double cosine = distance_to(shape, cells.points_mm[cell]).normal.dot(cells.normals[cell]);
    if (std::isfinite(cosine)) sum += cosine;
  }
  return sum < 0.0 ? -1.0 : 1.0;
}

RegionGrower::RegionGrower(const SurfaceCells& cells, const FeaturePoints& cell_points)
    : cells_(cells), cell_points_(cell_points), marks_(cells.size(), 0) {}

std::vector<std::uint32_t> RegionGrower::patch(std::uint32_t seed,
                                               std::size_t count,
                                               std::span<const std::uint8_t> available) {
  ++mark_;
  std::vector<std::uint32_t> found{seed};
  marks_[seed] = mark_;
  for (std::size_t i = 0; i < found.size() && found.size() < count; ++i) {
    const std::uint32_t cell = found[i];
    for (const std::uint32_t other : cells_.neighbors_of(cell)) {
      if (marks_[other] == mark_ || available[other] == 0) continue;
      if (cells_.normals[cell].dot(cells_.normals[other]) < kPatchCosine) continue;
      marks_[other] = mark_;
      found.push_back(other);
    }
  }
  return found;
}

bool RegionGrower::lies_on(std::uint32_t cell,
                           const ShapeRegion& region,
                           const GrowLimits& limits) const {
  const ShapeDistance at = distance_to(region.shape, cells_.points_mm[cell]);
  return std::abs(at.distance_mm) < limits.gate_mm &&
         region.side * at.normal.dot(cells_.normals[cell]) > limits.least_normal_cosine;
}

ShapeRegion RegionGrower::grow(const ShapeRegion& start,
                               const GrowLimits& limits,
                               std::span<const std::uint8_t> available,
                               bool largest_only) {
  ShapeRegion grown{start.shape, start.side, 0.0, {}};
  ++mark_;
  const auto take = [&](std::uint32_t cell, std::vector<std::uint32_t>& into) {
    if (marks_[cell] == mark_ || available[cell] == 0) return;
    marks_[cell] = mark_;
    if (lies_on(cell, start, limits)) into.push_back(cell);
  };
  std::vector<std::uint32_t> set;
  const auto spread = [&] {
    for (std::size_t i = 0; i < set.size(); ++i) {
      const std::uint32_t cell = set[i];
      for (const std::uint32_t other : cells_.neighbors_of(cell))
        take(other, set);
    }
  };
  for (const std::uint32_t cell : start.cells) {
    take(cell, set);
    if (!largest_only) continue;
    spread();
    if (set.size() > grown.cells.size()) grown.cells.swap(set);
    set.clear();
  }
  if (!largest_only) {
    spread();
    grown.cells.swap(set);
  }
  std::sort(grown.cells.begin(), grown.cells.end());
  double squares = 0.0;
  for (const std::uint32_t cell : grown.cells) {
    const double distance = distance_to(grown.shape, cells_.points_mm[cell]).distance_mm;
    squares += distance * distance;
  }
  if (!grown.cells.empty())
    grown.rms_mm = std::sqrt(squares / static_cast<double>(grown.cells.size()));
  return grown;
}

ShapeRegion RegionGrower::settle(ShapeRegion region,
                                 const GrowLimits& limits,
                                 std::span<const std::uint8_t> available) {
  for (int round = 0; round < kRounds && region.cells.size() > 8; ++round) {
    const std::vector<std::uint32_t> some = thinned(region.cells, kFitCells);
    const ShapeFit fit = fit_shape(
        cell_points_, some, region.shape, {.gate_mm = 2.0 * limits.gate_mm, .max_iterations = 8});
    if (!fit.converged) break;
    ShapeRegion next = region;
    next.shape = fit.shape;
    next = grow(next, limits, available);
    const double growth =
        static_cast<double>(next.cells.size()) / static_cast<double>(region.cells.size());
    if (growth < 1.0 - kSettled) break;
    region = std::move(next);
    if (growth < 1.0 + kSettled) break;
  }
  return region;
}

}  // namespace frangia
