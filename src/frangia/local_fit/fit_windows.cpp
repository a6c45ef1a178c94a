#include "frangia/local_fit/fit_windows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/vectorized.h"
#include "frangia/local_fit/internal/fit_quadratic.h"

namespace frangia {
namespace {

/// Sums of powers of the position over one side of a window. The basis 1, x, x^2 - mean(x^2) is
/// orthogonal.
template <int kRadius>
struct Moments {
  static constexpr int kSide = 2 * kRadius + 1;
  static constexpr float kSquare = kRadius * (kRadius + 1) / 3.0F;  ///< mean of x^2
  /// x^2 minus its mean.
  static constexpr float quadratic(int i) {
    return static_cast<float>((i - kRadius) * (i - kRadius)) - kSquare;
  }
  static constexpr float spread() {  ///< sum of quadratic^2 over a side
    float sum = 0.0F;
    for (int i = 0; i < kSide; ++i)
      sum += quadratic(i) * quadratic(i);
    return sum;
  }
  static constexpr float kSquares = kSide * kSquare;  ///< sum of x^2 over a side
  static constexpr float kPerCount = 1.0F / kSide;
  static constexpr float kPerSquares = 1.0F / kSquares;
  static constexpr float kPerQuadratic = 1.0F / (kSide * spread());
  static constexpr float kPerProduct = 1.0F / (kSquares * kSquares);
};

/// Line fits over the window rows that lie in one row of the image. Each quantity is stored in a
/// row of its own, so that loops vectorize.
struct Lines {
  float* mean = nullptr;
  float* slope = nullptr;
  float* quadratic = nullptr;  ///< sum of `Moments::quadratic` times the values
  float* squares = nullptr;    ///< sum of squared residuals of the line
};

/// Rows of `WindowFit` quantities.
struct Windows {
  float* mean = nullptr;
  float* slope_x = nullptr;
  float* slope_y = nullptr;
  float* variance = nullptr;
  float* value = nullptr;
  float* residual_variance = nullptr;
  float* curvature_xx = nullptr;
  float* curvature_yy = nullptr;
  float* curvature_xy = nullptr;
};

template <int kRadius>
[[gnu::always_inline]] inline void fit_lines(const float* values,
                                             std::ptrdiff_t count,
                                             const Lines& lines) {
  using M = Moments<kRadius>;
  const Lines to = lines;
#pragma GCC ivdep
  for (std::ptrdiff_t x = 0; x < count; ++x) {
    float sum = 0.0F;
    float along = 0.0F;
    float quadratic = 0.0F;
    for (int i = 0; i < M::kSide; ++i) {
      const float value = values[x + i];
      sum += value;
      along += static_cast<float>(i - kRadius) * value;
      quadratic += M::quadratic(i) * value;
    }
    const float mean = sum * M::kPerCount;
    const float slope = along * M::kPerSquares;
    float squares = 0.0F;
    for (int i = 0; i < M::kSide; ++i) {
      const float off = values[x + i] - (mean + static_cast<float>(i - kRadius) * slope);
      squares += off * off;
    }
    to.mean[x] = mean;
    to.slope[x] = slope;
    to.quadratic[x] = quadratic;
    to.squares[x] = squares;
  }
}

/// Joins the line fits of a window's rows to window fits. The squared residuals of the plane are
/// those of the lines plus those of the lines about the plane, a sum without cancellation.
template <int kRadius>
[[gnu::always_inline]] inline void join_lines(const std::array<Lines, 7>& rows,
                                              std::ptrdiff_t count,
                                              const Windows& windows) {
  using M = Moments<kRadius>;
  constexpr int kSide = M::kSide;
  const std::array<Lines, 7> from = rows;
  const Windows to = windows;
#pragma GCC ivdep
  for (std::ptrdiff_t x = 0; x < count; ++x) {
    float sum = 0.0F;
    float along_x = 0.0F;
    float along_y = 0.0F;
    float curvature_xx = 0.0F;
    float curvature_yy = 0.0F;
    float curvature_xy = 0.0F;
    for (int j = 0; j < kSide; ++j) {
      const Lines& row = from[static_cast<std::size_t>(j)];
      const float down = static_cast<float>(j - kRadius);
      sum += row.mean[x];
      along_x += row.slope[x];
      along_y += down * row.mean[x];
      curvature_xx += row.quadratic[x];
      curvature_yy += M::quadratic(j) * row.mean[x];
      curvature_xy += down * row.slope[x];
    }
    const float mean = sum * M::kPerCount;
    const float slope_x = along_x * M::kPerCount;
    const float slope_y = along_y * M::kPerSquares;
    float squares = 0.0F;
    for (int j = 0; j < kSide; ++j) {
      const Lines& row = from[static_cast<std::size_t>(j)];
      const float off = row.mean[x] - (mean + static_cast<float>(j - kRadius) * slope_y);
      const float turn = row.slope[x] - slope_x;
      squares +=
          row.squares[x] + (static_cast<float>(kSide) * off * off + M::kSquares * turn * turn);
    }
    curvature_xx *= M::kPerQuadratic;
    curvature_yy *= static_cast<float>(kSide) * M::kPerQuadratic;
    curvature_xy *= M::kSquares * M::kPerProduct;
    const float explained =  // part of the squares that the quadratic terms explain
        (curvature_xx * curvature_xx + curvature_yy * curvature_yy) / M::kPerQuadratic +
        curvature_xy * curvature_xy / M::kPerProduct;
    to.mean[x] = mean;
    to.slope_x[x] = slope_x;
    to.slope_y[x] = slope_y;
    to.variance[x] = squares * (1.0F / (kSide * kSide - 3));
    to.value[x] = mean - (curvature_xx + curvature_yy) * M::kSquare;
    to.residual_variance[x] = std::max(0.0F, squares - explained) * (1.0F / (kSide * kSide - 6));
    to.curvature_xx[x] = curvature_xx;
    to.curvature_yy[x] = curvature_yy;
    to.curvature_xy[x] = curvature_xy;
  }
}

FRANGIA_VECTORIZED_WIDE void fit_lines(const float* values,
                                       std::ptrdiff_t count,
                                       int radius,
                                       const Lines& lines) {
  if (radius == 1) fit_lines<1>(values, count, lines);
  if (radius == 2) fit_lines<2>(values, count, lines);
  if (radius == 3) fit_lines<3>(values, count, lines);
}
FRANGIA_VECTORIZED_WIDE void join_lines(const std::array<Lines, 7>& rows,
                                        std::ptrdiff_t count,
                                        int radius,
                                        const Windows& windows) {
  if (radius == 1) join_lines<1>(rows, count, windows);
  if (radius == 2) join_lines<2>(rows, count, windows);
  if (radius == 3) join_lines<3>(rows, count, windows);
}

/// Columns [begin, end) that hold all measured pixels of some rows.
struct Span {
  int begin = 0;
  int end = 0;
};
Span seen_columns(const Image<float>& image, int first_row, int rows) {
  Span span{image.width(), 0};
  for (int y = std::max(0, first_row); y < std::min(image.height(), first_row + rows); ++y) {
    int x = 0;
    while (x < span.begin && std::isnan(image(x, y)))
      ++x;
    span.begin = std::min(span.begin, x);
    x = image.width();
    while (x > span.end && std::isnan(image(x - 1, y)))
      --x;
    span.end = std::max(span.end, x);
  }
  return span;
}

}  // namespace

WindowFits fit_windows(const Image<float>& image, int radius, int first, int rows) {
  require(radius >= 1 && radius <= 3, "fit_windows: the radius must be 1, 2 or 3 pixels");
  WindowFits fits(image.width(), rows);
  const int side = 2 * radius + 1;
  const Span seen = seen_columns(image, first - radius, rows + 2 * radius);
  const int inner = seen.end - seen.begin - 2 * radius;  // windows in a row
  const auto width = static_cast<std::size_t>(std::max(0, inner));
  std::vector<float> kept(width * static_cast<std::size_t>(4 * side));
  const auto lines_of = [&](int y) {
    float* slot = kept.data() + static_cast<std::size_t>(4 * (y % side)) * width;
    return Lines{slot, slot + width, slot + 2 * width, slot + 3 * width};
  };
  int next = std::max(0, first - radius);  // the first row whose lines are not yet fitted
  for (int row = 0; row < rows; ++row) {
    const int top = first + row - radius;
    if (inner <= 0 || top < 0 || top + side > image.height()) {
      fits.set_missing_outside(0, 0, row);
      continue;
    }
    fits.set_missing_outside(seen.begin + radius, seen.begin + radius + inner, row);
    for (; next < top + side; ++next)
      fit_lines(&image(seen.begin, next), inner, radius, lines_of(next));
    std::array<Lines, 7> lines;
    for (int j = 0; j < side; ++j)
      lines[static_cast<std::size_t>(j)] = lines_of(top + j);
    const auto of = [&](WindowFits::Quantity quantity) {
      return fits.row(quantity, row) + seen.begin + radius;
    };
    join_lines(lines,
               inner,
               radius,
               {of(WindowFits::Mean),
                of(WindowFits::SlopeX),
                of(WindowFits::SlopeY),
                of(WindowFits::Variance),
                of(WindowFits::Value),
                of(WindowFits::ResidualVariance),
                of(WindowFits::CurvatureXX),
                of(WindowFits::CurvatureYY),
                of(WindowFits::CurvatureXY)});
  }
  return fits;
}

namespace {

/// Largest ratio of the residual variance of a quadratic to the expected one: the surface is
/// curved.
constexpr float kMaxCurvedRatio = 1.3F;

/// The same where the residuals are noisy: 3 times the known noise.
constexpr float kMaxNoisyRatio = 9.0F;

/// Largest ratio of the residual variance of a shifted window to that of the centered one.
constexpr float kMaxShiftedRatio = 0.5F;

/// Largest distance of a pixel from its plane, in standard deviations.
constexpr float kMaxOffSigmas = 4.0F;

const ChosenWindow kNoWindow{kNoFit, WindowKind::None, kMissing, kMissing};

/// The fit over the 3 x 3 pixels around (x, y); NaN as in `fit_windows`.
WindowFit small_fit(const Image<float>& q, int x, int y) {
  if (x < 1 || y < 1 || x + 1 >= q.width() || y + 1 >= q.height()) {
    return kNoFit;
  }
  WindowFit fit;
  for (const int dy : {-1, 0, 1}) {
    for (const int dx : {-1, 0, 1}) {
      const float value = q(x + dx, y + dy);
      fit.mean += value / 9.0F;
      fit.slope_x += static_cast<float>(dx) * value / 6.0F;
      fit.slope_y += static_cast<float>(dy) * value / 6.0F;
    }
  }
  for (const int dy : {-1, 0, 1}) {
    for (const int dx : {-1, 0, 1}) {
      const float plane =
          fit.mean + static_cast<float>(dx) * fit.slope_x + static_cast<float>(dy) * fit.slope_y;
      fit.variance += (q(x + dx, y + dy) - plane) * (q(x + dx, y + dy) - plane) / 6.0F;
    }
  }
  // The quadratic's value: the mean minus the mean of its second-order terms.
  fit.value = fit.mean;
  for (const int dy : {-1, 0, 1}) {
    for (const int dx : {-1, 0, 1}) {
      fit.value -= (static_cast<float>(dx * dx + dy * dy) - 4.0F / 3.0F) * q(x + dx, y + dy) / 3.0F;
    }
  }
  return fit;
}

/// The best of the centered window and eight windows shifted by `shift`. A shifted window must be
/// better by a margin. `fit_at(x, y)` is the fit around a pixel.
template <typename FitAt>
WindowFit best_window(const Eigen::Vector2i& at, int shift, float max_ratio, const FitAt& fit_at) {
  WindowFit best = fit_at(at.x(), at.y());
  float limit = std::isnan(best.variance) ? std::numeric_limits<float>::infinity()
                                          : max_ratio * best.variance;
  for (const int dy : {-shift, 0, shift}) {
    for (const int dx : {-shift, 0, shift}) {
      const WindowFit shifted = fit_at(at.x() + dx, at.y() + dy);
      if (!(shifted.variance < limit)) continue;
      limit = shifted.variance;
      best = shifted;
      best.mean -=
          static_cast<float>(dx) * shifted.slope_x + static_cast<float>(dy) * shifted.slope_y;
    }
  }
  return best;
}

/// The quadratic fit around a pixel if its residuals are noise: no larger than expected, or, with
/// `noisy`, larger but without structure. The residuals at an edge have structure.
ChosenWindow curved_window(const Image<float>& image,
                           const Eigen::Vector2i& at,
                           const PixelNoise& noise,
                           const QuadraticFit& patch,
                           bool noisy,
                           const WindowChoiceOptions& options) {
  const float expected = noise.variance(patch.window);
  const float residual_variance = patch.window.residual_variance;
  const float max_ratio = noisy ? kMaxNoisyRatio : kMaxCurvedRatio;
  if (!(residual_variance < max_ratio * expected)) return kNoWindow;  // also for NaN
  const bool quiet = residual_variance < kMaxCurvedRatio * expected;
  if (!(noisy && quiet) &&
      !(residual_autocorrelation(image, at, patch.window) < options.max_autocorrelation))
    return kNoWindow;
  return {patch.window,
          WindowKind::Centered,
          patch.window.value,
          patch.variance * std::max(expected, quiet ? 0.0F : residual_variance)};
}

}  // namespace

ChosenWindow choose_window(const Image<float>& image,
                           const WindowRows& fits,
                           const Eigen::Vector2i& at,
                           const PixelNoise& noise,
                           const WindowChoiceOptions& options) {
  const auto centered_on = [&](const WindowFit& fit, int radius) {
    const float variance = value_variance(radius) * noise.variance(fit);
    return ChosenWindow{fit, WindowKind::Centered, fit.value, variance};
  };
  const auto good = [&](const WindowFit& fit) {
    return fit.variance < options.max_flat_ratio * noise.variance(fit);  // false for NaN
  };
  const auto near = [&](const WindowFit& fit) {
    const float off = fit.mean - image(at.x(), at.y());
    return off * off < kMaxOffSigmas * kMaxOffSigmas * noise.variance(fit);
  };
  const WindowFit centered = fits.at(at.x(), at.y());
  const auto patch = [&]() -> QuadraticFit {
    if (fits.radius != kQuadraticRadius || std::isnan(centered.mean))
      return fit_quadratic(image, at);
    QuadraticFit complete{centered, value_variance(kQuadraticRadius)};
    complete.window.mean = centered.value;
    complete.window.variance = centered.residual_variance;
    return complete;
  };
  if (good(centered)) return centered_on(centered, fits.radius);
  if (!std::isnan(centered.mean)) {
    const ChosenWindow curved = curved_window(image, at, noise, patch(), false, options);
    if (curved.kind == WindowKind::Centered) return curved;
  }
  const WindowFit close = small_fit(image, at.x(), at.y());
  if (good(close)) return centered_on(close, 1);
  const WindowFit large =
      best_window(at, fits.radius, kMaxShiftedRatio, [&](int x, int y) { return fits.at(x, y); });
  // Without a flat window to any side there is no edge: the surface is curved, or noisy.
  if (std::isnan(centered.mean) || !good(large)) {
    const ChosenWindow curved = curved_window(image, at, noise, patch(), true, options);
    if (curved.kind == WindowKind::Centered) return curved;
  }
  if (good(large) && near(large)) {
    return {large,
            WindowKind::Shifted,
            large.mean,
            corner_variance(fits.radius) * noise.variance(large)};
  }
  const WindowFit small =
      best_window(at, 1, kMaxShiftedRatio, [&](int x, int y) { return small_fit(image, x, y); });
  if (near(small)) return {small, WindowKind::Small, image(at.x(), at.y()), noise.variance(small)};
  return kNoWindow;
}

}  // namespace frangia
