#include "frangia/local_fit/internal/plane_row.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "frangia/core/missing.h"
#include "frangia/core/vectorized.h"
#include "frangia/local_fit/internal/estimate_lateral_noise.h"

namespace frangia {
namespace {

/// Maximum change of the pixel's value, per standard deviation of its noise: about 2.5 standard
/// deviations of the difference between both fits.
constexpr float kMaxChange = 0.7F;

/// Variance of a pixel next to an edge, per variance that its fit predicts: neither slope nor
/// position are as accurate there as in the middle of a face.
constexpr float kOffCenterVarianceFactor = 9.0F;

/// A row of window fits and of the pixels' noise.
struct WindowRow {
  const float* noise;
  const float* slope_x;
  const float* slope_y;
  const float* scatter;
  float lateral_variance;
  float central_variance;  ///< variance of a window's central value, per pixel variance
  float max_flat_ratio;    ///< see `WindowChoiceOptions`
};

/// Computes the variances of the central values, and 1 where the window is flat to within the
/// noise.
FRANGIA_VECTORIZED_WIDE void test_windows(const WindowRow& row,
                                          std::ptrdiff_t count,
                                          float* variance,
                                          std::int32_t* fits) {
  const WindowRow from = row;
#pragma GCC ivdep
  for (std::ptrdiff_t x = 0; x < count; ++x) {
    const float square = from.slope_x[x] * from.slope_x[x] + from.slope_y[x] * from.slope_y[x];
    const float expected = from.noise[x] * from.noise[x] + from.lateral_variance * square;
    variance[x] = from.central_variance * expected;
    fits[x] = from.scatter[x] < from.max_flat_ratio * expected ? 1 : 0;  // 0 for NaN
  }
}

struct PlaneRowData {
  const float* value;
  const float* variance;
  const float* mean;
  const float* slope_x;
  const float* slope_y;
  float* normal_x;
  float* normal_y;
  float* normal_z;
  float* distance;
  float* tangent_distance;
  float* weight;
};

/// `kExtended` is that of the camera.
template <bool kExtended>
[[gnu::always_inline]] inline void fit_planes_of(const PlaneRowData& rows,
                                                 const Eigen::Vector2f* rays,
                                                 const FastCameraModel& camera,
                                                 std::ptrdiff_t count) {
  const PlaneRowData row = rows;
  const FastCameraModel model = camera;
  const float* ray = rays->data();
#pragma GCC ivdep
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const float x = ray[2 * i];
    const float y = ray[2 * i + 1];
    const Distortion<float>::Jacobian moves = model.jacobian<kExtended>(x, y);
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
    row.tangent_distance[i] = distance * (row.mean[i] / q);
    row.weight[i] = squares * squares / row.variance[i];
  }
}

FRANGIA_VECTORIZED_WIDE void fit_planes(const PlaneRowData& rows,
                                        const Eigen::Vector2f* rays,
                                        const FastCameraModel& camera,
                                        std::ptrdiff_t count) {
  fit_planes_of<false>(rows, rays, camera, count);
}

void fit_planes_extended(const PlaneRowData& rows,
                         const Eigen::Vector2f* rays,
                         const FastCameraModel& camera,
                         std::ptrdiff_t count) {
  fit_planes_of<true>(rows, rays, camera, count);
}

}  // namespace

PlaneRow::PlaneRow(int left, int width, const LocalPlanesOptions& options)
    : options_(options),
      left_(left),
      width_(width),
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
      tangent_distance_(measured_),
      weight_(measured_) {}

void PlaneRow::widen(const LinkedPixels& grid,
                     const WindowRows& wider,
                     int y,
                     float lateral_noise_px) {
  const WideningOptions& options = options_.widening;
  const float central_variance = value_variance(wider.radius);
  Row autocorrelation(kind_.size());
  window_autocorrelation(grid.q, wider, y, autocorrelation);
  const int row = y - wider.first;
  const float* wide_value = wider.fits.row(WindowFits::Value, row);
  const float* residual_variance = wider.fits.row(WindowFits::ResidualVariance, row);
  const float* noise = &grid.noise(0, y);
  for (std::size_t i = begin_; i < end_; ++i) {
    const float square = slope_x_[i] * slope_x_[i] + slope_y_[i] * slope_y_[i];
    const float expected = noise[i] * noise[i] + lateral_noise_px * lateral_noise_px * square;
    const float off = wide_value[i] - value_[i];
    const bool is_noise = autocorrelation[i] < options.max_autocorrelation &&
                          residual_variance[i] < options.max_residual_ratio * expected &&
                          off * off < kMaxChange * kMaxChange * expected;
    wide_[i] = is_noise ? 1 : 0;
    if (wide_[i] == 0) continue;
    if (kind_[i] == WindowKind::None) mean_[i] = value_[i];
    kind_[i] = WindowKind::Centered;
    value_[i] = wide_value[i];
    variance_[i] = central_variance * expected;
  }
}

void PlaneRow::choose(const LinkedPixels& grid,
                      const WindowRows& windows,
                      const WindowRows* wider,
                      int y,
                      float lateral_noise_px) {
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
  const auto copy = [&](WindowFits::Quantity quantity, Row& to) {
    std::copy_n(fits.row(quantity, row) + from, count, to.begin() + from);
  };
  copy(WindowFits::Mean, mean_);
  copy(WindowFits::SlopeX, slope_x_);
  copy(WindowFits::SlopeY, slope_y_);
  copy(WindowFits::Value, value_);
  std::copy_n(q + from, count, measured_.begin() + from);
  const float* noise = &grid.noise(0, y);
  std::vector<std::int32_t> good(kind_.size());
  test_windows({noise + from,
                slope_x_.data() + from,
                slope_y_.data() + from,
                fits.row(WindowFits::Variance, row) + from,
                lateral_noise_px * lateral_noise_px,
                value_variance(windows.radius),
                options_.windows.max_flat_ratio},
               count,
               variance_.data() + from,
               good.data() + from);
  for (std::size_t i = begin_; i < end_; ++i)
    kind_[i] = good[i] != 0 ? WindowKind::Centered : WindowKind::None;
  std::fill(wide_.begin(), wide_.end(), char{0});
  if (wider != nullptr) widen(grid, *wider, y, lateral_noise_px);
  for (std::size_t i = begin_; i < end_; ++i) {
    const auto x = static_cast<int>(i);
    if (good[i] != 0 || wide_[i] != 0 || std::isnan(measured_[i])) continue;
    if (!is_corner_of_needed_quad(left_ + x, options_.every)) continue;
    const ChosenWindow chosen =
        choose_window(grid.q, windows, {x, y}, {noise[x], lateral_noise_px}, options_.windows);
    kind_[i] = chosen.kind;
    mean_[i] = chosen.fit.mean;
    slope_x_[i] = chosen.fit.slope_x;
    slope_y_[i] = chosen.fit.slope_y;
    value_[i] = chosen.value;
    const bool centered = chosen.kind == WindowKind::Centered;
    variance_[i] = (centered ? 1.0F : kOffCenterVarianceFactor) * chosen.variance;
  }
}

void PlaneRow::fit(const Eigen::Vector2f* rays, const FastCameraModel& model) {
  const auto from = static_cast<std::ptrdiff_t>(begin_);
  const auto at = [&](Row& row) { return row.data() + from; };
  const PlaneRowData row{at(value_),
                         at(variance_),
                         at(mean_),
                         at(slope_x_),
                         at(slope_y_),
                         at(normal_x_),
                         at(normal_y_),
                         at(normal_z_),
                         at(distance_),
                         at(tangent_distance_),
                         at(weight_)};
  const auto count = static_cast<std::ptrdiff_t>(end_ - begin_);
  if (model.lens.extended) {
    fit_planes_extended(row, rays + from, model, count);
  } else {
    fit_planes(row, rays + from, model, count);
  }
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
                 tangent_distance_[i],
                 weight_[i],
                 kind_[i]};
    inverse_depth[i] = value_[i];
  }
}

}  // namespace frangia
