#include "frangia/features/internal/grow_region.h"

#include <algorithm>
#include <cmath>

#include "frangia/features/fit_shape.h"

namespace frangia {
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
