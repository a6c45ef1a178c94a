#include "frangia/views/fit_windows.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"

namespace frangia {
namespace {

/// The fits of one row, each figure in a row of its own: loops over them become vector code.
struct RowOfFits {
  explicit RowOfFits(int width)
      : mean(static_cast<std::size_t>(width)),
        slope_x(mean),
        slope_y(mean),
        variance(mean),
        middle(mean),
        rest(mean),
        explained(mean) {}
  std::vector<float> mean;
  std::vector<float> slope_x;
  std::vector<float> slope_y;
  std::vector<float> variance;
  std::vector<float> middle;
  std::vector<float> rest;
  std::vector<float> explained;  ///< of the squares about the plane, by the paraboloid
};

/// Sums over one side of a window of the powers of the place, which make its fits orthogonal.
template <int kRadius>
struct Moments {
  static constexpr int kSide = 2 * kRadius + 1;
  static constexpr float kSquare = kRadius * (kRadius + 1) / 3.0F;  ///< mean of x^2
  /// Of x^2 less its mean.
  static constexpr float bend(int i) {
    return static_cast<float>((i - kRadius) * (i - kRadius)) - kSquare;
  }
  static constexpr float spread() {  ///< sum of bend^2 over a side
    float sum = 0.0F;
    for (int i = 0; i < kSide; ++i)
      sum += bend(i) * bend(i);
    return sum;
  }
  static constexpr float kPerCount = 1.0F / (kSide * kSide);
  static constexpr float kPerSpread = 1.0F / (kSide * kSide * kSquare);
  static constexpr float kPerBend = 1.0F / (kSide * spread());
  static constexpr float kPerTwist = 1.0F / (kSide * kSquare * kSide * kSquare);
};

template <int kRadius>
[[gnu::always_inline]] inline void fit_row_of(const float* top,
                                              std::ptrdiff_t width,
                                              RowOfFits& fits) {
  using M = Moments<kRadius>;
  constexpr int kSide = M::kSide;
  float* mean = fits.mean.data();
  float* slope_x = fits.slope_x.data();
  float* slope_y = fits.slope_y.data();
  float* variance = fits.variance.data();
  float* middle = fits.middle.data();
  float* rest = fits.rest.data();
  float* explained = fits.explained.data();
  const std::ptrdiff_t inner = width - 2 * kRadius;
  for (std::ptrdiff_t x = 0; x < inner; ++x) {
    float sum = 0.0F;
    float along_x = 0.0F;
    float along_y = 0.0F;
    float bend_x = 0.0F;
    float bend_y = 0.0F;
    float twist = 0.0F;
    for (int j = 0; j < kSide; ++j) {
      float of_row = 0.0F;
      float x_of_row = 0.0F;
      for (int i = 0; i < kSide; ++i) {
        const float value = top[j * width + x + i];
        of_row += value;
        x_of_row += static_cast<float>(i - kRadius) * value;
        bend_x += M::bend(i) * value;
      }
      sum += of_row;
      along_x += x_of_row;
      along_y += static_cast<float>(j - kRadius) * of_row;
      bend_y += M::bend(j) * of_row;
      twist += static_cast<float>(j - kRadius) * x_of_row;
    }
    mean[x] = sum * M::kPerCount;
    slope_x[x] = along_x * M::kPerSpread;
    slope_y[x] = along_y * M::kPerSpread;
    middle[x] = mean[x] - (bend_x + bend_y) * M::kPerBend * M::kSquare;
    explained[x] = (bend_x * bend_x + bend_y * bend_y) * M::kPerBend + twist * twist * M::kPerTwist;
  }
  // About the plane rather than from the sum of squares, which would cancel all digits.
  for (std::ptrdiff_t x = 0; x < inner; ++x) {
    float squares = 0.0F;
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        const float plane = mean[x] + static_cast<float>(j - kRadius) * slope_y[x] +
                            static_cast<float>(i - kRadius) * slope_x[x];
        const float off = top[j * width + x + i] - plane;
        squares += off * off;
      }
    }
    variance[x] = squares * (1.0F / (kSide * kSide - 3));
    rest[x] = std::max(0.0F, squares - explained[x]) * (1.0F / (kSide * kSide - 6));
  }
}

/// One body for each instruction set: without contraction they give the same bytes.
[[gnu::target_clones("avx512f", "avx2", "default")]] void fit_row(const float* top,
                                                                  std::ptrdiff_t width,
                                                                  int radius,
                                                                  RowOfFits& fits) {
  if (radius == 1) fit_row_of<1>(top, width, fits);
  if (radius == 2) fit_row_of<2>(top, width, fits);
  if (radius == 3) fit_row_of<3>(top, width, fits);
}

}  // namespace

void fit_windows(const Image<float>& image, int radius, int first, Image<WindowFit>& fits) {
  require(radius >= 1 && radius <= 3, "fit_windows: the radius is 1, 2 or 3 pixels");
  const int width = image.width();
  RowOfFits found(width);
  for (int row = 0; row < fits.height(); ++row) {
    const int top = first + row - radius;
    const bool within = top >= 0 && top + 2 * radius < image.height() && width > 2 * radius;
    if (within) fit_row(&image(0, top), width, radius, found);
    for (int x = 0; x < width; ++x) {
      const auto from = static_cast<std::size_t>(x - radius);
      const bool inner = within && x >= radius && x + radius < width;
      fits(x, row) = inner ? WindowFit{found.mean[from],
                                       found.slope_x[from],
                                       found.slope_y[from],
                                       found.variance[from],
                                       found.middle[from],
                                       found.rest[from]}
                           : kNoFit;
    }
  }
}

}  // namespace frangia
