#pragma once

#include <cstddef>
#include <memory>

#include "frangia/core/missing.h"

namespace frangia {

/// Least-squares fits of an image over a square window: the plane
/// `mean + slope_x * dx + slope_y * dy`, and the quadratic with the same slopes.
struct WindowFit {
  float mean = 0.0F;      ///< mean of the pixels; value of the plane at the window's centre
  float slope_x = 0.0F;   ///< per pixel
  float slope_y = 0.0F;   ///< per pixel
  float variance = 0.0F;  ///< residual variance of the plane
  float value = 0.0F;     ///< value of the quadratic at the window's centre
  float residual_variance = 0.0F;  ///< residual variance of the quadratic
  float curvature_xx = 0.0F;       ///< coefficient of dx^2, per pixel^2
  float curvature_yy = 0.0F;       ///< coefficient of dy^2
  float curvature_xy = 0.0F;       ///< coefficient of dx dy
};

/// The fit of a window that holds a missing pixel or leaves the image.
inline constexpr WindowFit kNoFit{
    kMissing, kMissing, kMissing, kMissing, kMissing, kMissing, kMissing, kMissing, kMissing};

/// Variance of `WindowFit::value` per pixel variance, for windows without missing pixels.
[[nodiscard]] constexpr float value_variance(int radius) {
  return radius == 1 ? 5.0F / 9.0F : radius == 2 ? 27.0F / 175.0F : 11.0F / 147.0F;
}

/// Variance of the plane's value at a corner of its window per pixel variance:
/// 1/n + 2 r^2 / sum(dx^2).
[[nodiscard]] constexpr float corner_variance(int radius) {
  const auto r = static_cast<float>(radius);
  return (1.0F + 6.0F * r / (r + 1.0F)) / ((2.0F * r + 1.0F) * (2.0F * r + 1.0F));
}

/// The fits around the pixels of some rows. Each quantity is stored in rows of its own, so that
/// loops over them vectorize.
class WindowFits {
 public:
  /// The quantities of a fit, in the order of the members of WindowFit.
  enum Quantity : int {
    Mean,
    SlopeX,
    SlopeY,
    Variance,
    Value,
    ResidualVariance,
    CurvatureXX,
    CurvatureYY,
    CurvatureXY,
    QuantityCount
  };

  /// Allocates uninitialized fits of `rows` rows with `width` pixels each.
  WindowFits(int width, int rows);

  [[nodiscard]] int width() const { return width_; }  ///< number of pixels in a row
  /// Returns one quantity of the fits around a row's pixels: `width()` values.
  [[nodiscard]] float* row(Quantity quantity, int row) {
    return values_.get() + offset(quantity, row);
  }
  /// Returns one quantity of the fits around a row's pixels, read-only.
  [[nodiscard]] const float* row(Quantity quantity, int row) const {
    return values_.get() + offset(quantity, row);
  }
  [[nodiscard]] WindowFit at(int x, int row) const;  ///< fit around pixel `x` of a row
  /// Sets all quantities of a row to NaN except for the windows [begin, end).
  void set_missing_outside(int begin, int end, int row);

 private:
  [[nodiscard]] std::size_t offset(Quantity quantity, int row) const {
    return static_cast<std::size_t>(width_) *
           static_cast<std::size_t>(row * QuantityCount + quantity);
  }

  int width_;
  // NOLINTNEXTLINE(*-avoid-c-arrays): a vector would be initialized twice
  std::unique_ptr<float[]> values_;
};

}  // namespace frangia
