#include "frangia/views/fit_windows.h"

#include <algorithm>
#include <array>
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
        structure(mean),
        bend_x(mean),
        bend_y(mean),
        twist(mean) {}
  std::vector<float> mean;
  std::vector<float> slope_x;
  std::vector<float> slope_y;
  std::vector<float> variance;
  std::vector<float> middle;
  std::vector<float> rest;
  std::vector<float> structure;
  std::vector<float> bend_x;  ///< of the paraboloid, about its plane
  std::vector<float> bend_y;
  std::vector<float> twist;
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
  /// In how many pairs of neighbours along a side a place is.
  static constexpr float pairs(int i) { return i == 0 || i == 2 * kRadius ? 1.0F : 2.0F; }
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
  float* middle = fits.middle.data();
  float* bent_x = fits.bend_x.data();
  float* bent_y = fits.bend_y.data();
  float* twisted = fits.twist.data();
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
    bent_x[x] = bend_x * M::kPerBend;
    bent_y[x] = bend_y * M::kPerBend;
    twisted[x] = twist * M::kPerTwist;
  }
}

/// What the fits leave over; about them rather than from sums of squares, which would cancel all
/// digits.
template <int kRadius>
[[gnu::always_inline]] inline void judge_row_of(const float* top,
                                                std::ptrdiff_t width,
                                                RowOfFits& fits) {
  using M = Moments<kRadius>;
  constexpr int kSide = M::kSide;
  const float* mean = fits.mean.data();
  const float* slope_x = fits.slope_x.data();
  const float* slope_y = fits.slope_y.data();
  const float* bend_x = fits.bend_x.data();
  const float* bend_y = fits.bend_y.data();
  const float* twist = fits.twist.data();
  float* variance = fits.variance.data();
  float* rest = fits.rest.data();
  float* structure = fits.structure.data();
  const std::ptrdiff_t inner = width - 2 * kRadius;
  for (std::ptrdiff_t x = 0; x < inner; ++x) {
    float squares = 0.0F;
    float products = 0.0F;
    float paired = 0.0F;
    std::array<float, static_cast<std::size_t>(kSide)> above{};
    for (int j = 0; j < kSide; ++j) {
      const auto down = static_cast<float>(j - kRadius);
      const float of_row = mean[x] + down * slope_y[x] + M::bend(j) * bend_y[x];
      const float along = slope_x[x] + down * twist[x];
      float before = 0.0F;
      for (int i = 0; i < kSide; ++i) {
        const float fit = of_row + static_cast<float>(i - kRadius) * along + M::bend(i) * bend_x[x];
        const float off = top[j * width + x + i] - fit;
        squares += off * off;
        paired += (M::pairs(i) + M::pairs(j)) * off * off;
        const auto column = static_cast<std::size_t>(i);
        products += off * (before + above[column]);
        above[column] = before = off;
      }
    }
    const float bends = bend_x[x] * bend_x[x] + bend_y[x] * bend_y[x];
    const float explained = bends / M::kPerBend + twist[x] * twist[x] / M::kPerTwist;
    variance[x] = (squares + explained) * (1.0F / (kSide * kSide - 3));
    rest[x] = squares * (1.0F / std::max(1, kSide * kSide - 6));
    structure[x] = paired > 0.0F ? 2.0F * products / paired : 0.0F;
  }
}

template <int kRadius>
[[gnu::always_inline]] inline void fit_and_judge(const float* top,
                                                 std::ptrdiff_t width,
                                                 RowOfFits& fits) {
  fit_row_of<kRadius>(top, width, fits);
  judge_row_of<kRadius>(top, width, fits);
}

/// One body for each instruction set: without contraction they give the same bytes.
[[gnu::target_clones("avx512f", "avx2", "default")]] void fit_row(const float* top,
                                                                  std::ptrdiff_t width,
                                                                  int radius,
                                                                  RowOfFits& fits) {
  if (radius == 1) fit_and_judge<1>(top, width, fits);
  if (radius == 2) fit_and_judge<2>(top, width, fits);
  if (radius == 3) fit_and_judge<3>(top, width, fits);
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
                                       found.rest[from],
                                       found.structure[from]}
                           : kNoFit;
    }
  }
}

}  // namespace frangia
