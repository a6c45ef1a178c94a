#include "frangia/views/fit_patch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>

namespace frangia {
namespace {

using Vector6 = Eigen::Matrix<float, 6, 1>;
using Matrix6 = Eigen::Matrix<float, 6, 6>;

constexpr int kRadius = kPatchRadius;
constexpr int kSide = 2 * kRadius + 1;
constexpr int kFewest = 12;            // pixels: six unknowns and as many to judge them by
constexpr float kMostVariance = 0.8F;  // less than that is not worth it
constexpr PatchFit kNone{kNoFit, kMissing};

/// The pixels about one, less its value: small numbers keep their digits.
using Patch = std::array<float, kSide * kSide>;

Patch patch_at(const Image<float>& image, const Eigen::Vector2i& at, float less) {
  Patch patch{};
  for (int i = 0; i < kSide * kSide; ++i) {
    const int x = at.x() + i % kSide - kRadius;
    const int y = at.y() + i / kSide - kRadius;
    const bool within = x >= 0 && y >= 0 && x < image.width() && y < image.height();
    patch[static_cast<std::size_t>(i)] = within ? image(x, y) - less : kMissing;
  }
  return patch;
}

/// Where a pixel of the patch lies from its middle.
struct Beside {
  float x;
  float y;
};
Beside beside(int i) {
  const int down = i / kSide;
  return {static_cast<float>(i - down * kSide - kRadius), static_cast<float>(down - kRadius)};
}

Vector6 powers(int i) {
  const auto [x, y] = beside(i);
  Vector6 row;
  row << 1.0F, x, y, x * x, x * y, y * y;
  return row;
}

PatchFit fit_pixels(const Patch& patch, float here) {
  Matrix6 normal = Matrix6::Zero();
  Vector6 pull = Vector6::Zero();
  for (int i = 0; i < kSide * kSide; ++i) {
    const float value = patch[static_cast<std::size_t>(i)];
    if (std::isnan(value)) continue;
    const Vector6 row = powers(i);
    normal += row * row.transpose();
    pull += value * row;
  }
  const Eigen::LDLT<Matrix6> solver(normal);
  const Vector6 fit = solver.solve(pull);
  const Vector6 column = solver.solve(Vector6::Unit(0));
  if (!fit.allFinite() || !(column[0] > 0.0F && column[0] < kMostVariance)) return kNone;
  PatchFit out;
  out.variance = column[0];
  out.window.middle = out.window.mean = here + fit[0];
  out.window.slope_x = fit[1];
  out.window.slope_y = fit[2];
  out.window.bend_x = fit[3];
  out.window.twist = fit[4];
  out.window.bend_y = fit[5];
  return out;
}

/// What the fit leaves over at each pixel.
Patch left_over(const Patch& patch, const WindowFit& fit, float here) {
  Patch off{};
  for (int i = 0; i < kSide * kSide; ++i) {
    const auto [x, y] = beside(i);
    const float fitted = (fit.middle - here) + x * fit.slope_x + y * fit.slope_y +
                         x * x * fit.bend_x + x * y * fit.twist + y * y * fit.bend_y;
    off[static_cast<std::size_t>(i)] = patch[static_cast<std::size_t>(i)] - fitted;
  }
  return off;
}

}  // namespace

PatchFit fit_patch(const Image<float>& image, const Eigen::Vector2i& at) {
  const float here = image(at.x(), at.y());
  const Patch patch = patch_at(image, at, here);
  const auto count =
      std::count_if(patch.begin(), patch.end(), [](float value) { return !std::isnan(value); });
  if (count < kFewest) return kNone;
  PatchFit fit = fit_pixels(patch, here);
  float squares = 0.0F;
  for (const float off : left_over(patch, fit.window, here)) {
    if (!std::isnan(off)) squares += off * off;
  }
  fit.window.variance = fit.window.rest = squares / static_cast<float>(count - 6);
  return std::isnan(fit.variance) ? kNone : fit;
}

float structure_of(const Image<float>& image, const Eigen::Vector2i& at, const WindowFit& patch) {
  const float here = image(at.x(), at.y());
  const Patch off = left_over(patch_at(image, at, here), patch, here);
  float products = 0.0F;
  float squares = 0.0F;
  const auto add = [&](float a, float b) {
    if (std::isnan(a) || std::isnan(b)) return;
    products += a * b;
    squares += 0.5F * (a * a + b * b);
  };
  for (std::size_t i = 0; i < off.size(); ++i) {
    if (i % kSide + 1 < kSide) add(off[i], off[i + 1]);
    if (i + kSide < off.size()) add(off[i], off[i + kSide]);
  }
  return squares > 0.0F ? products / squares : 0.0F;
}

}  // namespace frangia
