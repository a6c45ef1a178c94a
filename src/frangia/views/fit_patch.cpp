#include "frangia/views/fit_patch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>

namespace frangia {
namespace {

using Vector6 = Eigen::Matrix<float, 6, 1>;
using Matrix6 = Eigen::Matrix<float, 6, 6>;

constexpr int kRadius = 2;
constexpr int kFewest = 12;            // pixels: six unknowns and as many to judge them by
constexpr float kMostVariance = 0.8F;  // less than that is not worth it

Vector6 powers(int dx, int dy) {
  const auto x = static_cast<float>(dx);
  const auto y = static_cast<float>(dy);
  Vector6 row;
  row << 1.0F, x, y, x * x, x * y, y * y;
  return row;
}

float structure_of(const Image<float>& image,
                   const Eigen::Vector2i& at,
                   const Vector6& fit,
                   float here) {
  constexpr int kSide = 2 * kRadius + 1;
  std::array<float, kSide * kSide> off{};
  for (int i = 0; i < kSide * kSide; ++i) {
    const int dx = i % kSide - kRadius;
    const int dy = i / kSide - kRadius;
    const int x = at.x() + dx;
    const int y = at.y() + dy;
    const bool within = x >= 0 && y >= 0 && x < image.width() && y < image.height();
    off[static_cast<std::size_t>(i)] =
        within ? image(x, y) - here - fit.dot(powers(dx, dy)) : kMissing;
  }
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

}  // namespace

PatchFit fit_patch(const Image<float>& image, const Eigen::Vector2i& at) {
  const float here = image(at.x(), at.y());
  Matrix6 normal = Matrix6::Zero();
  Vector6 pull = Vector6::Zero();
  float squares = 0.0F;
  int count = 0;
  for (int dy = -kRadius; dy <= kRadius; ++dy) {
    for (int dx = -kRadius; dx <= kRadius; ++dx) {
      const int x = at.x() + dx;
      const int y = at.y() + dy;
      if (x < 0 || y < 0 || x >= image.width() || y >= image.height()) continue;
      const float value = image(x, y) - here;  // small numbers keep their digits
      if (std::isnan(value)) continue;
      const Vector6 row = powers(dx, dy);
      normal += row * row.transpose();
      pull += value * row;
      squares += value * value;
      ++count;
    }
  }
  const PatchFit none{kNoFit, kMissing};
  if (count < kFewest) return none;
  const Eigen::LDLT<Matrix6> solver(normal);
  const Vector6 fit = solver.solve(pull);
  const Vector6 column = solver.solve(Vector6::Unit(0));
  if (!fit.allFinite() || !(column[0] > 0.0F && column[0] < kMostVariance)) return none;
  PatchFit out;
  out.variance = column[0];
  out.window.middle = out.window.mean = here + fit[0];
  out.window.slope_x = fit[1];
  out.window.slope_y = fit[2];
  out.window.rest = std::max(0.0F, squares - fit.dot(pull)) / static_cast<float>(count - 6);
  out.window.variance = out.window.rest;
  out.window.structure = structure_of(image, at, fit, here);
  return out;
}

}  // namespace frangia
