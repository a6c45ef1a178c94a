#include "frangia/views/plane_row.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "frangia/core/missing.h"
#include "frangia/core/vectorised.h"
#include "frangia/views/window_structure.h"

namespace frangia {
namespace {

/// Variance that beside a rim or an edge neither slope nor pixel has in the middle of a face.
constexpr float kDoubt = 9.0F;

/// What a row of windows says, and of the pixels' noise.
struct WindowRow {
  const float* noise;
  const float* slope_x;
  const float* slope_y;
  const float* scatter;
  float jitter2;
  float left;  ///< of a pixel's variance in the middle of a window
};

/// Variances of the middles, and 1 where the window fits as well as noise allows.
FRANGIA_VECTORISED_WIDELY void judge(const WindowRow& row,
                                     std::ptrdiff_t count,
                                     float* variance,
                                     std::int32_t* fits) {
  const WindowRow from = row;
#pragma GCC ivdep
  for (std::ptrdiff_t x = 0; x < count; ++x) {
    const float square = from.slope_x[x] * from.slope_x[x] + from.slope_y[x] * from.slope_y[x];
    const float expected = from.noise[x] * from.noise[x] + from.jitter2 * square;
    variance[x] = from.left * expected;
    fits[x] = from.scatter[x] < kFits * expected ? 1 : 0;  // 0 for NaN
  }
}

struct PlaneFigures {
  const float* value;
  const float* variance;
  const float* mean;
  const float* slope_x;
  const float* slope_y;
  float* normal_x;
  float* normal_y;
  float* normal_z;
  float* distance;
  float* through;
  float* weight;
};

FRANGIA_VECTORISED_WIDELY void fit_planes(const PlaneFigures& figures,
                                          const Eigen::Vector2f* rays,
                                          const FastLens& camera,
                                          std::ptrdiff_t count) {
  const PlaneFigures row = figures;
  const FastLens lens = camera;
  const float* ray = rays->data();
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const float x = ray[2 * i];
    const float y = ray[2 * i + 1];
    const FastLens::Jacobian moves = lens.jacobian(x, y);
    const float a = moves.ux * row.slope_x[i] + moves.vx * row.slope_y[i];
    const float b = moves.uy * row.slope_x[i] + moves.vy * row.slope_y[i];
    const float c = row.mean[i] - (a * x + b * y);
    const float distance = 1.0F / std::sqrt(a * a + b * b + c * c);
    const float q = row.value[i];
    const float cosine = distance * q;
    const float squares = cosine * q * q;
    row.normal_x[i] = -distance * a;
    row.normal_y[i] = -distance * b;
    row.normal_z[i] = -distance * c;
    row.distance[i] = distance;
    row.through[i] = distance * (row.mean[i] / q);
    row.weight[i] = squares * squares / row.variance[i];
  }
}

}  // namespace

PlaneRow::PlaneRow(int width)
    : width_(width),
      kind_(static_cast<std::size_t>(width)),
      wide_(kind_.size()),
      measured_(kind_.size()),
      value_(measured_),
      variance_(measured_),
      mean_(measured_),
      slope_x_(measured_),
      slope_y_(measured_),
      normal_x_(measured_),
      normal_y_(measured_),
      normal_z_(measured_),
      distance_(measured_),
      through_(measured_),
      weight_(measured_) {}

void PlaneRow::widen(const LinkedPixels& grid, const WindowRows& wider, int y, float jitter_px) {
  constexpr float kUneven = 2.5F;  // in variance: pixels differ in their noise
  constexpr float kSame = 0.7F;    // of a pixel's noise: two and a half times what chance does
  constexpr float kStructure = 0.05F;
  const float left = middle_variance(wider.radius);
  Row structure(kind_.size());
  window_structure(grid.q, wider, y, structure);
  const int row = y - wider.first;
  const float* middle = wider.fits.row(WindowFits::Middle, row);
  const float* rest = wider.fits.row(WindowFits::Rest, row);
  const float* noise = &grid.noise(0, y);
  for (std::size_t i = begin_; i < end_; ++i) {
    const float square = slope_x_[i] * slope_x_[i] + slope_y_[i] * slope_y_[i];
    const float expected = noise[i] * noise[i] + jitter_px * jitter_px * square;
    const float off = middle[i] - value_[i];
    wide_[i] = structure[i] < kStructure && rest[i] < kUneven * expected &&
                       off * off < kSame * kSame * expected
                   ? 1
                   : 0;
    if (wide_[i] == 0) continue;
    if (kind_[i] == WindowKind::None) mean_[i] = value_[i];
    kind_[i] = WindowKind::Centred;
    value_[i] = middle[i];
    variance_[i] = left * expected;
  }
}

void PlaneRow::choose(const LinkedPixels& grid,
                      const WindowRows& windows,
                      const WindowRows* wider,
                      int y,
                      float jitter_px) {
  const WindowFits& fits = windows.fits;
  const int row = y - windows.first;
  const float* q = &grid.q(0, y);
  const auto seen = [](float value) { return !std::isnan(value); };
  begin_ = static_cast<std::size_t>(std::find_if(q, q + width_, seen) - q);
  end_ = static_cast<std::size_t>(width_);
  while (end_ > begin_ && std::isnan(q[end_ - 1]))
    --end_;
  const auto from = static_cast<std::ptrdiff_t>(begin_);
  const auto count = static_cast<std::ptrdiff_t>(end_ - begin_);
  const auto copy = [&](WindowFits::Figure figure, Row& to) {
    std::copy_n(fits.row(figure, row) + from, count, to.begin() + from);
  };
  copy(WindowFits::Mean, mean_);
  copy(WindowFits::SlopeX, slope_x_);
  copy(WindowFits::SlopeY, slope_y_);
  copy(WindowFits::Middle, value_);
  std::copy_n(q + from, count, measured_.begin() + from);
  const float* noise = &grid.noise(0, y);
  std::vector<std::int32_t> good(kind_.size());
  judge({noise + from,
         slope_x_.data() + from,
         slope_y_.data() + from,
         fits.row(WindowFits::Variance, row) + from,
         jitter_px * jitter_px,
         middle_variance(windows.radius)},
        count,
        variance_.data() + from,
        good.data() + from);
  for (std::size_t i = begin_; i < end_; ++i)
    kind_[i] = good[i] != 0 ? WindowKind::Centred : WindowKind::None;
  std::fill(wide_.begin(), wide_.end(), char{0});
  if (wider != nullptr) widen(grid, *wider, y, jitter_px);
  for (std::size_t i = begin_; i < end_; ++i) {
    const auto x = static_cast<int>(i);
    if (good[i] != 0 || wide_[i] != 0 || std::isnan(measured_[i])) continue;
    const ChosenWindow chosen = choose_window(grid.q, windows, {x, y}, {noise[x], jitter_px});
    kind_[i] = chosen.kind;
    mean_[i] = chosen.fit.mean;
    slope_x_[i] = chosen.fit.slope_x;
    slope_y_[i] = chosen.fit.slope_y;
    value_[i] = chosen.value;
    variance_[i] = (chosen.kind == WindowKind::Centred ? 1.0F : kDoubt) * chosen.variance;
  }
}

void PlaneRow::fit(const Eigen::Vector2f* rays, const FastLens& lens) {
  const auto from = static_cast<std::ptrdiff_t>(begin_);
  const auto at = [&](Row& row) { return row.data() + from; };
  fit_planes({at(value_),
              at(variance_),
              at(mean_),
              at(slope_x_),
              at(slope_y_),
              at(normal_x_),
              at(normal_y_),
              at(normal_z_),
              at(distance_),
              at(through_),
              at(weight_)},
             rays + from,
             lens,
             static_cast<std::ptrdiff_t>(end_ - begin_));
}

void PlaneRow::write(LocalPlanes::Plane* planes, float* inverse_depth) const {
  std::fill_n(planes, begin_, LocalPlanes::Plane{});
  std::fill(planes + end_, planes + width_, LocalPlanes::Plane{});
  std::fill_n(inverse_depth, begin_, kMissing);
  std::fill(inverse_depth + end_, inverse_depth + width_, kMissing);
  for (std::size_t i = begin_; i < end_; ++i) {
    if (kind_[i] == WindowKind::None) {
      planes[i] = {};
      inverse_depth[i] = measured_[i];
      continue;
    }
    planes[i] = {{normal_x_[i], normal_y_[i], normal_z_[i]},
                 distance_[i],
                 through_[i],
                 weight_[i],
                 kind_[i]};
    inverse_depth[i] = value_[i];
  }
}

}  // namespace frangia
