#include "frangia/features/filtered_range.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/core/statistics.h"

namespace frangia {
namespace {

/// What the blocks add up to.
struct RangeSums {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  double largest_mean_u = 0.0;  ///< of the mean of a block, for independent errors
  std::size_t blocks = 0;
  /// Of the means of the parts of the blocks, from the fit, and what independent errors would give.
  std::array<double, 2> part_squares{};
  std::array<double, 2> independent_squares{};
};

/// Adds the means of 2^levels parts of a block, whose points are in compact order.
void add_parts(const std::vector<double>& residuals,
               unsigned levels,
               double variance,
               double parameters,
               RangeSums& sums) {
  const std::size_t parts = std::size_t{1} << levels;
  const double free = static_cast<double>(parts) - parameters;
  if (free < 1.0) return;
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t begin = part * residuals.size() / parts;
    const std::size_t end = (part + 1) * residuals.size() / parts;
    const auto count = static_cast<double>(end - begin);
    double mean = 0.0;
    for (std::size_t i = begin; i < end; ++i)
      mean += residuals[i] / count;
    // The fit takes some of the degrees of freedom of the means.
    sums.part_squares.at(levels - 2) += mean * mean * static_cast<double>(parts) / free;
    sums.independent_squares.at(levels - 2) += variance / count;
  }
}

/// How much more the variance of a mean is than for independent errors, from parts of two sizes.
double inflation_of(const RangeSums& sums) {
  double inflation = 1.0;
  for (std::size_t i = 0; i < sums.part_squares.size(); ++i) {
    if (sums.independent_squares.at(i) > 0.0)
      inflation = std::max(inflation, sums.part_squares.at(i) / sums.independent_squares.at(i));
  }
  return inflation;
}

/// Orders points by medians along the widest side, so that equal parts are compact.
void order_compactly(std::span<SurfaceValue> values, int levels) {
  if (levels == 0 || values.size() < 2) return;
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
  order_compactly(values.first(middle), levels - 1);
  order_compactly(values.subspan(middle), levels - 1);
}

/// Fits a linear function to a block and extends the range by its values at the points.
void add_block(std::span<SurfaceValue> block, RangeSums& sums) {
  constexpr int kLevels = 3;
  order_compactly(block, kLevels);
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
  std::vector<double> residuals;
  for (const SurfaceValue& one : block) {
    const double fitted = mean + slope.dot(one.point_mm - center);
    sums.low = std::min(sums.low, fitted);
    sums.high = std::max(sums.high, fitted);
    residuals.push_back(one.value - fitted);
    squares += residuals.back() * residuals.back();
  }
  for (std::size_t i = 0; i < block.size(); ++i)
    block[i].value -= residuals[i];
  ++sums.blocks;
  if (count <= parameters) return;
  const double variance = squares / (count - parameters);
  for (const unsigned levels : {2U, 3U})
    if (residuals.size() >= 32) add_parts(residuals, levels, variance, parameters, sums);
  sums.largest_mean_u = std::max(sums.largest_mean_u, std::sqrt(variance / count));
}

void split(std::span<SurfaceValue> values, RangeSums& sums) {
  constexpr std::size_t kLeast = 48;
  if (values.size() < 2 * kLeast) {
    add_block(values, sums);
    return;
  }
  order_compactly(values, 1);
  const std::size_t middle = values.size() / 2;
  split(values.first(middle), sums);
  split(values.subspan(middle), sums);
}

}  // namespace

FilteredRange filtered_range(std::vector<SurfaceValue> values) {
  require(!values.empty(), "the feature has no points to measure a form by");
  RangeSums sums;
  split(values, sums);
  const double corner = std::sqrt(7.0);  // of a fitted value at a corner over that of the mean
  const double u = corner * sums.largest_mean_u * std::sqrt(inflation_of(sums));
  // The extremes of many blocks lie apart by chance, too.
  const double apart = 2.0 * u * std::sqrt(2.0 * std::log(4.0 * static_cast<double>(sums.blocks)));
  return {
      sums.low, sums.high, std::hypot(kNormal95 * std::sqrt(2.0) * u, apart), std::move(values)};
}

}  // namespace frangia
