#include "frangia/features/internal/filtered_range.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/core/symmetric_eigen.h"

namespace frangia {
namespace {

/// What the blocks add up to.
struct RangeSums {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  double largest_u = 0.0;  ///< of the fitted value at a corner of a block
};

/// Fits a linear function to a block and extends the range by its values at the points.
void add_block(std::span<const SurfaceValue> block, RangeSums& sums) {
  const auto count = static_cast<double>(block.size());
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double mean = 0.0;
  for (const SurfaceValue& one : block) {
    center += one.point_mm / count;
    mean += one.value / count;
  }
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const SurfaceValue& one : block) {
    const Eigen::Vector3d offset = one.point_mm - center;
    spread += offset * offset.transpose();
    moment += (one.value - mean) * offset;
  }
  // Across a nearly flat block the slope is not determined; it stays 0.
  const auto eigen = symmetric_eigen(spread);
  Eigen::Vector3d inverse = Eigen::Vector3d::Zero();
  int parameters = 1;
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (!(eigen.values[i] > 0.02 * eigen.values[2])) continue;
    inverse[i] = 1.0 / eigen.values[i];
    ++parameters;
  }
  const Eigen::Vector3d slope =
      eigen.vectors * (inverse.cwiseProduct(eigen.vectors.transpose() * moment));
  double squares = 0.0;
  for (const SurfaceValue& one : block) {
    const double fitted = mean + slope.dot(one.point_mm - center);
    sums.low = std::min(sums.low, fitted);
    sums.high = std::max(sums.high, fitted);
    squares += (one.value - fitted) * (one.value - fitted);
  }
  if (count <= parameters) return;
  const double sigma = std::sqrt(squares / (count - parameters));
  constexpr double kCorner = 2.0;  // of a fitted value at a corner over that of the mean
  sums.largest_u = std::max(sums.largest_u, kCorner * sigma / std::sqrt(count));
}

void split(std::span<SurfaceValue> values, RangeSums& sums) {
  constexpr std::size_t kLeast = 48;
  if (values.size() < 2 * kLeast) {
    add_block(values, sums);
    return;
  }
  Eigen::AlignedBox3d box;
  for (const SurfaceValue& one : values)
    box.extend(one.point_mm);
  Eigen::Index side = 0;
  box.sizes().maxCoeff(&side);
  const std::size_t middle = values.size() / 2;
  std::nth_element(
      values.begin(),
      values.begin() + static_cast<std::ptrdiff_t>(middle),
      values.end(),
      [&](const auto& a, const auto& b) { return a.point_mm[side] < b.point_mm[side]; });
  split(values.first(middle), sums);
  split(values.subspan(middle), sums);
}

}  // namespace

FilteredRange filtered_range(std::vector<SurfaceValue> values) {
  require(!values.empty(), "the feature has no points to measure a form by");
  RangeSums sums;
  split(values, sums);
  constexpr double k95 = 1.959964;
  return {sums.low, sums.high, k95 * std::sqrt(2.0) * sums.largest_u};
}

}  // namespace frangia
