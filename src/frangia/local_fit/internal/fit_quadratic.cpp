#include "frangia/local_fit/internal/fit_quadratic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Cholesky>

namespace frangia {
namespace {

using Vector6 = Eigen::Matrix<float, 6, 1>;
using Matrix6 = Eigen::Matrix<float, 6, 6>;

constexpr int kQuadraticSide = 2 * kQuadraticRadius + 1;
constexpr std::size_t kPixels = static_cast<std::size_t>(kQuadraticSide) * kQuadraticSide;
constexpr std::size_t kFewest = 12;    // pixels: six unknowns and as many degrees of freedom
constexpr float kMostVariance = 0.8F;  // of the value, per pixel variance: above, the pixel itself
                                       // is about as good
constexpr QuadraticFit kNone{kNoFit, kMissing};

/// The values of the pixels around one, relative to `less` to keep precision.
struct Patch {
  std::array<float, kPixels> off{};   ///< 0 where missing
  std::array<float, kPixels> seen{};  ///< 1, or 0 where missing
};

Patch patch_at(const Image<float>& image, const Eigen::Vector2i& at, float less) {
  Patch patch;
  const int left = at.x() - kQuadraticRadius;
  const int from = std::max(0, -left);
  const int to = std::min(kQuadraticSide, image.width() - left);
  for (int down = 0; down < kQuadraticSide; ++down) {
    const int y = at.y() + down - kQuadraticRadius;
    if (y < 0 || y >= image.height()) continue;
    const std::size_t row = static_cast<std::size_t>(down) * kQuadraticSide;
    for (int right = from; right < to; ++right) {
      const float value = image(left + right, y);
      if (std::isnan(value)) continue;
      const std::size_t i = row + static_cast<std::size_t>(right);
      patch.off[i] = value - less;
      patch.seen[i] = 1.0F;
    }
  }
  return patch;
}

/// Monomials of the position in a patch up to the fourth degree: 1, x, y, xx, xy, yy, xxx, ...
/// yyyy. The first six belong to the unknowns. Padded to sixteen, so that sums over them vectorize.
using Powers = std::array<float, 16>;
constexpr std::array<Powers, kPixels> make_powers() {
  std::array<Powers, kPixels> all{};
  for (std::size_t i = 0; i < kPixels; ++i) {
    const int right = static_cast<int>(i) % kQuadraticSide;
    const int down = static_cast<int>(i) / kQuadraticSide;
    const auto x = static_cast<float>(right - kQuadraticRadius);
    const auto y = static_cast<float>(down - kQuadraticRadius);
    all[i] = {1.0F,
              x,
              y,
              x * x,
              x * y,
              y * y,
              x * x * x,
              x * x * y,
              x * y * y,
              y * y * y,
              x * x * x * x,
              x * x * x * y,
              x * x * y * y,
              x * y * y * y,
              y * y * y * y,
              0.0F};
  }
  return all;
}
constexpr std::array<Powers, kPixels> kPowers = make_powers();

/// Index into `Powers` of each element of the normal matrix on and below its diagonal.
constexpr std::array<std::array<std::size_t, 6>, 6> kNormalMatrixTerms{
    {{0}, {1, 3}, {2, 4, 5}, {3, 6, 7, 10}, {4, 7, 8, 11, 12}, {5, 8, 9, 12, 13, 14}}};

QuadraticFit fit_pixels(const Patch& patch, float here) {
  Powers sums{};
  Powers right_side{};
  for (std::size_t i = 0; i < kPixels; ++i) {
    for (std::size_t k = 0; k < sums.size(); ++k) {
      sums[k] += patch.seen[i] * kPowers[i][k];
      right_side[k] += patch.off[i] * kPowers[i][k];
    }
  }
  Matrix6 normal;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column <= row; ++column) {
      normal(row, column) =
          sums[kNormalMatrixTerms[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)]];
    }
  }
  const Eigen::LLT<Eigen::Ref<Matrix6>> solver(normal);
  if (solver.info() != Eigen::Success) return kNone;
  const Vector6 fit = solver.solve(Eigen::Map<const Vector6>(right_side.data()));
  const Vector6 column = solver.solve(Vector6::Unit(0));
  if (!fit.allFinite() || !(column[0] > 0.0F && column[0] < kMostVariance)) return kNone;
  QuadraticFit out;
  out.variance = column[0];
  out.window.value = out.window.mean = here + fit[0];
  out.window.slope_x = fit[1];
  out.window.slope_y = fit[2];
  out.window.curvature_xx = fit[3];
  out.window.curvature_xy = fit[4];
  out.window.curvature_yy = fit[5];
  return out;
}

/// The residual of the fit at each pixel, 0 where the pixel is missing.
std::array<float, kPixels> residuals_of(const Patch& patch, const WindowFit& fit, float here) {
  std::array<float, kPixels> off{};
  const float value = fit.value - here;
  for (std::size_t i = 0; i < kPixels; ++i) {
    const Powers& of = kPowers[i];
    const float fitted = value + of[1] * fit.slope_x + of[2] * fit.slope_y +
                         of[3] * fit.curvature_xx + of[4] * fit.curvature_xy +
                         of[5] * fit.curvature_yy;
    off[i] = patch.seen[i] * (patch.off[i] - fitted);
  }
  return off;
}

}  // namespace

QuadraticFit fit_quadratic(const Image<float>& image, const Eigen::Vector2i& at) {
  const float here = image(at.x(), at.y());
  const Patch patch = patch_at(image, at, here);
  const auto count =
      static_cast<std::size_t>(std::count(patch.seen.begin(), patch.seen.end(), 1.0F));
  if (count < kFewest) return kNone;
  QuadraticFit fit = fit_pixels(patch, here);
  if (std::isnan(fit.variance)) return kNone;
  float squares = 0.0F;
  for (const float off : residuals_of(patch, fit.window, here))
    squares += off * off;
  fit.window.variance = fit.window.residual_variance = squares / static_cast<float>(count - 6);
  return fit;
}

float residual_autocorrelation(const Image<float>& image,
                               const Eigen::Vector2i& at,
                               const WindowFit& patch) {
  const float here = image(at.x(), at.y());
  const Patch pixels = patch_at(image, at, here);
  const std::array<float, kPixels> off = residuals_of(pixels, patch, here);
  float products = 0.0F;
  float squares = 0.0F;
  const auto add = [&](std::size_t a, std::size_t b) {
    products += off[a] * off[b];
    squares += 0.5F * (pixels.seen[b] * off[a] * off[a] + pixels.seen[a] * off[b] * off[b]);
  };
  for (std::size_t i = 0; i < kPixels; ++i) {
    if (i % kQuadraticSide + 1 < kQuadraticSide) add(i, i + 1);
    if (i + kQuadraticSide < kPixels) add(i, i + kQuadraticSide);
  }
  return squares > 0.0F ? products / squares : 0.0F;
}

}  // namespace frangia
