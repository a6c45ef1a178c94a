#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/missing.h"
#include "frangia/core/statistics.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// The phase between pixels.
struct PhaseSample {
  double phase_rad = 0.0;                                ///< NaN: not measured
  double sigma_rad = 0.0;                                ///< mean of the four pixels
  bool is_cubic = false;                                 ///< interpolated from 4 x 4 pixels
  double systematic_rad = 0.0;                           ///< mean; 0: none is known
  Eigen::Vector2d rad_per_px = Eigen::Vector2d::Zero();  ///< gradient
};

/// A phase map that is sampled between its pixels: by cubic interpolation (Keys 1981) where all 16
/// pixels around a point are measured, by bilinear interpolation at boundaries.
class PhaseSampler {
 public:
  /// `phase` must outlive the sampler.
  explicit PhaseSampler(const AbsolutePhase& phase) : phase_(phase), jump_rad_(jump_of(phase)) {}

  /// Four pixels whose phases differ by more belong to two surfaces.
  [[nodiscard]] double jump_rad() const { return jump_rad_; }

  /// @missing  NaN unless all four pixels around the point are measured and on one surface
  [[nodiscard]] PhaseSample at(const Eigen::Vector2d& pixel) const {
    const Image<float>& phase = phase_.phase_rad;
    const double u = pixel.x();
    const double v = pixel.y();
    PhaseSample out{.phase_rad = kNone};
    if (!(u >= 0.0 && v >= 0.0 && u < phase.width() - 1.0 && v < phase.height() - 1.0)) return out;
    const int x = static_cast<int>(u);
    const int y = static_cast<int>(v);
    const auto value = [&](const Image<float>& image, int right, int down) {
      return static_cast<double>(image(x + right, y + down));
    };
    const double a = value(phase, 0, 0);
    const double b = value(phase, 1, 0);
    const double c = value(phase, 0, 1);
    const double d = value(phase, 1, 1);
    if (!(std::max({a, b, c, d}) - std::min({a, b, c, d}) < jump_rad_)) return out;
    if (std::isnan(a + b + c + d)) return out;
    const double right = u - x;
    const double down = v - y;
    out.rad_per_px = gradient(x, y);
    out.phase_rad = a + right * (b - a) + down * ((c - a) + right * ((d - c) - (b - a)));
    cubic(x, y, right, down, out);

    const auto mean = [&](const Image<float>& image) {
      return 0.25 *
             (value(image, 0, 0) + value(image, 1, 0) + value(image, 0, 1) + value(image, 1, 1));
    };
    out.sigma_rad = mean(phase_.sigma_rad);
    if (!phase_.systematic_rad.empty()) out.systematic_rad = mean(phase_.systematic_rad);
    return out;
  }

 private:
  static constexpr double kNone = kMissing;

  /// Replaces the interpolated phase by that of 4 x 4 pixels, where they are on one surface.
  void cubic(int x, int y, double right, double down, PhaseSample& out) const {
    const Image<float>& phase = phase_.phase_rad;
    if (x < 1 || y < 1 || x + 2 >= phase.width() || y + 2 >= phase.height()) return;
    const auto weights = [](double t) {
      return std::array<double, 4>{0.5 * t * (-1.0 + t * (2.0 - t)),
                                   1.0 + 0.5 * t * t * (3.0 * t - 5.0),
                                   0.5 * t * (1.0 + t * (4.0 - 3.0 * t)),
                                   0.5 * t * t * (t - 1.0)};
    };
    const auto across = weights(right);
    const auto along = weights(down);
    double sum = 0.0;
    double low = out.phase_rad;
    double high = low;
    for (std::size_t row = 0; row < along.size(); ++row) {
      for (std::size_t column = 0; column < across.size(); ++column) {
        const auto value = static_cast<double>(
            phase(x - 1 + static_cast<int>(column), y - 1 + static_cast<int>(row)));
        sum += along[row] * across[column] * value;
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
    constexpr double kWider = 3.0;  // than the four pixels in the middle
    if (!(high - low < kWider * jump_rad_) || std::isnan(sum)) return;
    out.phase_rad = sum;
    out.is_cubic = true;
  }

  /// The gradient between four pixels, over three pixels where those beyond are measured, which has
  /// a third of the noise.
  [[nodiscard]] Eigen::Vector2d gradient(int x, int y) const {
    const Image<float>& phase = phase_.phase_rad;
    const auto at = [&](int column, int row) { return static_cast<double>(phase(column, row)); };
    Eigen::Vector2d out(0.5 * (at(x + 1, y) - at(x, y) + at(x + 1, y + 1) - at(x, y + 1)),
                        0.5 * (at(x, y + 1) - at(x, y) + at(x + 1, y + 1) - at(x + 1, y)));
    if (x > 0 && x + 2 < phase.width()) {
      const double wide = (at(x + 2, y) - at(x - 1, y) + at(x + 2, y + 1) - at(x - 1, y + 1)) / 6.0;
      if (std::abs(wide) < jump_rad_) out.x() = wide;
    }
    if (y > 0 && y + 2 < phase.height()) {
      const double wide = (at(x, y + 2) - at(x, y - 1) + at(x + 1, y + 2) - at(x + 1, y - 1)) / 6.0;
      if (std::abs(wide) < jump_rad_) out.y() = wide;
    }
    return out;
  }

  /// Several times the median step between pixels that are neighbours along x and y.
  static double jump_of(const AbsolutePhase& map) {
    constexpr int kRows = 8;      // every eighth row is enough
    constexpr double kSteps = 8;  // an oblique surface rises faster than the median
    const Image<float>& phase = map.phase_rad;
    std::vector<float> steps;
    for (int y = 0; y + 1 < phase.height(); y += kRows) {
      for (int x = 0; x + 1 < phase.width(); ++x) {
        const float step =
            std::abs(phase(x + 1, y) - phase(x, y)) + std::abs(phase(x, y + 1) - phase(x, y));
        if (!std::isnan(step)) steps.push_back(step);
      }
    }
    return steps.empty() ? 0.0 : kSteps * static_cast<double>(median_in_place(std::span(steps)));
  }

  const AbsolutePhase& phase_;
  double jump_rad_;
};

/// Replaces missing columns, the nodes of a grid which a changed rig does not measure, by the
/// nearest known one.
///
/// @shape    nodes: any number of rows; counts[0] * counts[1] * counts[2] columns, x fastest
void fill_missing(Eigen::MatrixXd& nodes, const std::array<int, 3>& counts);

/// Replaces the rows of a matrix by the fewest rows whose sums of squares of each column agree with
/// the original ones to within 1e-4 of their mean.
[[nodiscard]] Eigen::MatrixXf principal_components(const Eigen::MatrixXd& rows);

/// The principal components of displacement fields: of three rows, x, y and z, for each change and
/// a column for each node, it makes a row for each component and three columns for each node. A
/// component mixes changes alone.
[[nodiscard]] Eigen::MatrixXf principal_displacements(const Eigen::MatrixXd& nodes);

}  // namespace frangia
