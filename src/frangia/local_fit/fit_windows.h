#pragma once

#include <cstddef>
#include <memory>

#include "frangia/core/image.h"
#include "frangia/core/missing.h"

namespace frangia {

/// The plane `mean + slope_x * dx + slope_y * dy` that fits an image best over a square window.
struct WindowFit {
  float mean = 0.0F;
  float slope_x = 0.0F;  ///< per pixel
  float slope_y = 0.0F;
  float variance = 0.0F;           ///< of the values about the plane
  float value = 0.0F;              ///< what the best paraboloid has at the window's centre
  float residual_variance = 0.0F;  ///< variance of the values about that paraboloid
  float curvature_xx = 0.0F;       ///< of the paraboloid: of x^2, per pixel^2
  float curvature_yy = 0.0F;       ///< of y^2
  float curvature_xy = 0.0F;       ///< of x y
};

/// What a window has that cannot be fitted.
inline constexpr WindowFit kNoFit{
    kMissing, kMissing, kMissing, kMissing, kMissing, kMissing, kMissing, kMissing, kMissing};

/// What is left in `value` of a pixel's noise, in variance.
[[nodiscard]] constexpr float value_variance(int radius) {
  return radius == 1 ? 5.0F / 9.0F : radius == 2 ? 27.0F / 175.0F : 11.0F / 147.0F;
}

/// The fits about some pixels, each quantity in rows of its own: loops over them become vector
/// code.
class WindowFits {
 public:
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

  WindowFits(int width, int rows);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] float* row(Quantity quantity, int row) {
    return values_.get() + offset(quantity, row);
  }
  [[nodiscard]] const float* row(Quantity quantity, int row) const {
    return values_.get() + offset(quantity, row);
  }
  [[nodiscard]] WindowFit at(int x, int row) const;
  /// Windows [begin, end) of a row are yet to be written; all others have no fit.
  void set_missing_outside(int begin, int end, int row);

 private:
  [[nodiscard]] std::size_t offset(Quantity quantity, int row) const {
    return static_cast<std::size_t>(width_) *
           static_cast<std::size_t>(row * QuantityCount + quantity);
  }

  int width_;
  std::unique_ptr<float[]> values_;  // NOLINT(*-avoid-c-arrays): not written twice, as a vector's
};

/// Least-squares planes over the (2 radius + 1)^2 window about each pixel of `rows` rows from
/// `first` on.
///
/// missing  NaN in the image; a window that holds one, or leaves the image, has NaN everywhere
/// errors   Error(Input) unless the radius is 1, 2 or 3
/// source   `value`: Savitzky & Golay 1964, in two dimensions
[[nodiscard]] WindowFits fit_windows(const Image<float>& image, int radius, int first, int rows);

}  // namespace frangia
