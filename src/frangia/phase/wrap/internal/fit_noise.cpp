#include "frangia/phase/wrap/internal/fit_noise.h"

#include <algorithm>
#include <optional>
#include <span>

#include <Eigen/LU>

namespace frangia::phase {
namespace {

/// floor + factor * shape(brightness), neither below what it can be.
struct Curve {
  double floor = 0.0;
  double factor = 0.0;
  double misfit = 0.0;  ///< sum of the weighted squares
};

/// The variance of a bin is off by chance, and by rounding and texture: otherwise the many pixels
/// of a dark background alone would decide.
double weight_of(const VarianceAt& one) {
  constexpr double kModelError = 0.1;  // relative
  return 1.0 / (one.variance_counts2 * one.variance_counts2 *
                (2.0 / one.samples + kModelError * kModelError));
}

template <typename Shape>
Curve fit(std::span<const VarianceAt> variances, const Shape& shape) {
  const double least = NoiseModel{}.floor_counts2;
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (const VarianceAt& one : variances) {
    const Eigen::Vector2d row(1.0, shape(one.counts));
    normal += weight_of(one) * row * row.transpose();
    right += weight_of(one) * row * one.variance_counts2;
  }
  Eigen::Vector2d both(right(0) / normal(0, 0), 0.0);
  if (normal.determinant() > 1e-9 * normal(0, 0) * normal(1, 1)) both = normal.inverse() * right;
  if (both(1) < 0.0) both = {right(0) / normal(0, 0), 0.0};
  if (both(0) < least)
    both = {least, std::max(0.0, (right(1) - least * normal(0, 1)) / normal(1, 1))};
  Curve curve{.floor = both(0), .factor = both(1)};
  for (const VarianceAt& one : variances) {
    const double off = one.variance_counts2 - curve.floor - curve.factor * shape(one.counts);
    curve.misfit += weight_of(one) * off * off;
  }
  return curve;
}

/// A gain of the weighted squares that chance does not give: three sigma of one more parameter.
constexpr double kLeastGain = 9.0;
/// Shares of the white level that the dark part may reach to: encodings and read noises differ.
constexpr double kRanges[] = {1.0 / 64, 1.0 / 32, 1.0 / 16, 1.0 / 8, 1.0 / 4};

/// The curve of pixels that are not cut off.
NoiseModel fit_lit(std::span<const VarianceAt> variances, int white_level) {
  NoiseModel model;
  const Curve line = fit(variances, [](double counts) { return counts; });
  model.floor_counts2 = line.floor;
  model.slope_counts = line.factor;
  if (line.factor > 0.0) return model;
  double least = line.misfit - kLeastGain;
  for (const double share : kRanges) {
    const double range = share * white_level;
    const Curve dark = fit(variances, [&](double counts) {
      const double left = range / (counts + range);
      return left * left;
    });
    if (dark.misfit >= least) continue;
    least = dark.misfit;
    model = {.floor_counts2 = dark.floor, .dark_counts2 = dark.factor, .dark_range_counts = range};
  }
  return model;
}

}  // namespace

NoiseModel fit_noise(std::span<const VarianceAt> variances,
                     const std::optional<VarianceAt>& cut_off,
                     int white_level) {
  if (variances.empty()) return {};
  NoiseModel model = fit_lit(variances, white_level);
  constexpr double kLeft = 0.341;  // of the variance of Gaussian noise about 0 counts
  constexpr double kSure = 2.0;    // rounding alone is less
  if (!cut_off || cut_off->variance_counts2 < kSure * model.variance(cut_off->counts)) return model;
  constexpr double kRange = 1.0 / 32;  // of the white level; they tell the dark end alone
  const double range = kRange * white_level;
  const double left = range / (cut_off->counts + range);
  model.dark_range_counts = range;
  model.dark_counts2 = 0.0;
  model.dark_counts2 =
      (cut_off->variance_counts2 / kLeft - model.variance(cut_off->counts)) / (left * left);
  return model;
}

}  // namespace frangia::phase
