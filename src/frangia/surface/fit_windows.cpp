#include "frangia/surface/fit_windows.h"

#include <cstddef>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

using Row = std::vector<float>;

/// The fits of one row, as separate rows: loops over them become vector code.
struct RowOfFits {
  explicit RowOfFits(std::size_t width)
      : mean(width), slope_x(width), slope_y(width), variance(width) {}
  Row mean;
  Row slope_x;
  Row slope_y;
  Row variance;
};

template <int kRadius>
void fit_row(const Image<float>& image, int y, RowOfFits& fits) {
  constexpr int kSide = 2 * kRadius + 1;
  constexpr float kPerCount = 1.0F / (kSide * kSide);
  constexpr float kPerSpread = 3.0F / (kSide * kSide * kRadius * (kRadius + 1));
  const std::size_t inner = fits.mean.size();
  const auto width = static_cast<std::size_t>(image.width());
  const float* top = image.pixels().data() + static_cast<std::size_t>(y - kRadius) * width;
  for (std::size_t x = 0; x < inner; ++x) {
    float sum = 0.0F;
    float along_x = 0.0F;
    float along_y = 0.0F;
    for (int j = 0; j < kSide; ++j) {
      const float* row = top + static_cast<std::size_t>(j) * width + x;
      float of_row = 0.0F;
      for (int i = 0; i < kSide; ++i) {
        of_row += row[i];
        along_x += static_cast<float>(i - kRadius) * row[i];
      }
      sum += of_row;
      along_y += static_cast<float>(j - kRadius) * of_row;
    }
    fits.mean[x] = sum * kPerCount;
    fits.slope_x[x] = along_x * kPerSpread;
    fits.slope_y[x] = along_y * kPerSpread;
  }
  // About the plane rather than from the sum of squares, which would cancel all digits.
  for (std::size_t x = 0; x < inner; ++x) {
    float squares = 0.0F;
    for (int j = 0; j < kSide; ++j) {
      const float* row = top + static_cast<std::size_t>(j) * width + x;
      const float start = fits.mean[x] + static_cast<float>(j - kRadius) * fits.slope_y[x];
      for (int i = 0; i < kSide; ++i) {
        const float rest = row[i] - start - static_cast<float>(i - kRadius) * fits.slope_x[x];
        squares += rest * rest;
      }
    }
    fits.variance[x] = squares * (1.0F / (kSide * kSide - 3));
  }
}

template <int kRadius>
Image<WindowFit> fit_all(const Image<float>& image) {
  const int width = image.width();
  Image<WindowFit> fits(width, image.height(), {kMissing, kMissing, kMissing, kMissing});
  if (width <= 2 * kRadius || image.height() <= 2 * kRadius) return fits;
  parallel_rows(image.height() - 2 * kRadius, [&](int row) {
    RowOfFits found(static_cast<std::size_t>(width - 2 * kRadius));
    fit_row<kRadius>(image, row + kRadius, found);
    for (std::size_t x = 0; x < found.mean.size(); ++x) {
      fits(static_cast<int>(x) + kRadius, row + kRadius) = {
          found.mean[x], found.slope_x[x], found.slope_y[x], found.variance[x]};
    }
  });
  return fits;
}

}  // namespace

Image<WindowFit> fit_windows(const Image<float>& image, int radius) {
  require(radius >= 1 && radius <= 3, "fit_windows: the radius is 1, 2 or 3 pixels");
  if (radius == 1) return fit_all<1>(image);
  return radius == 2 ? fit_all<2>(image) : fit_all<3>(image);
}

}  // namespace frangia
