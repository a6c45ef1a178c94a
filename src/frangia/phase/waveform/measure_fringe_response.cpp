#include "frangia/phase/waveform/measure_fringe_response.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/phase/algorithm/phase_algorithm.h"

namespace frangia {
namespace {

constexpr int kKnots = 17;  ///< evenly spaced levels; as `frangia simulate --ramp 17`
constexpr double kMinAmplitude =
    0.075;                        ///< of white: half the least contrast of `measure_response`
constexpr int kMinPixels = 1000;  ///< least number of pixels

/// Least-squares fit of a piecewise linear curve.
class CurveFit {
 public:
  void add(double level, double light, double weight) {
    const double place = std::clamp(level, 0.0, 1.0) * (kKnots - 1);
    const int k = std::min(static_cast<int>(place), kKnots - 2);
    const double b = place - k;
    const double a = 1.0 - b;
    matrix_(k, k) += weight * a * a;
    matrix_(k + 1, k + 1) += weight * b * b;
    matrix_(k, k + 1) += weight * a * b;
    matrix_(k + 1, k) += weight * a * b;
    right_(k) += weight * a * light;
    right_(k + 1) += weight * b * light;
  }
  [[nodiscard]] Eigen::VectorXd solve() const { return solve_symmetric(matrix_, right_); }

 private:
  Eigen::MatrixXd matrix_ = Eigen::MatrixXd::Zero(kKnots, kKnots);
  Eigen::VectorXd right_ = Eigen::VectorXd::Zero(kKnots);
};

/// Adds the pixels of one stack; returns their number.
int add_pixels(const FrameStack& stack, CurveFit& fit) {
  const std::vector<double>& shifts = stack.pattern.shifts_rad;
  const PhaseAlgorithm algorithm = least_squares(shifts);
  const Frame& first = stack.frames.front();
  std::vector<double> counts(shifts.size());
  int used = 0;
  for (int y = 0; y < height_of(first); ++y) {
    for (int x = 0; x < width_of(first); ++x) {
      for (std::size_t k = 0; k < counts.size(); ++k)
        counts[k] = counts_at(stack.frames[k], x, y);
      if (*std::max_element(counts.begin(), counts.end()) >= stack.white_level) continue;
      const auto sum = [&](const std::vector<double>& weights) {
        return std::inner_product(weights.begin(), weights.end(), counts.begin(), 0.0);
      };
      const double size = std::hypot(sum(algorithm.sine), sum(algorithm.cosine));
      if (size < kMinAmplitude * stack.white_level) continue;
      const double phase = std::atan2(sum(algorithm.sine), sum(algorithm.cosine));
      const double mean = sum(algorithm.mean);
      ++used;
      for (std::size_t k = 0; k < counts.size(); ++k) {
        // Light is in units of the fringe amplitude, so noise is inversely proportional to the
        // amplitude.
        fit.add(0.5 + 0.5 * std::cos(phase + shifts[k]), (counts[k] - mean) / size, size * size);
      }
    }
  }
  return used;
}

}  // namespace

bool determines_response(const Pattern& pattern) {
  if (pattern.kind != PatternKind::Fringe || pattern.shifts_rad.size() < kMinResponseFrames)
    return false;
  const double step = kTwoPi / static_cast<double>(pattern.shifts_rad.size());
  for (std::size_t k = 0; k < pattern.shifts_rad.size(); ++k) {
    const double apart = pattern.shifts_rad[k] - pattern.shifts_rad.front();
    if (std::abs(wrap_rad(apart - step * static_cast<double>(k))) > 1e-6 &&
        std::abs(wrap_rad(apart + step * static_cast<double>(k))) > 1e-6)
      return false;
  }
  return true;
}

ResponseCurve response_of_waveform(const FringeWaveform& waveform) {
  std::vector<double> levels;
  std::vector<double> light;
  for (int k = 0; k < kKnots; ++k) {
    const double level = static_cast<double>(k) / (kKnots - 1);
    levels.push_back(level);
    light.push_back(waveform.light_at(std::acos(2.0 * level - 1.0)));
  }
  return make_response_curve(levels, light);
}

ResponseCurve measure_fringe_response(std::span<const FrameStack> stacks) {
  require(
      !stacks.empty(),
      "the scan has neither a pattern of kind \"ramp\" nor fringes of six or more frames evenly "
      "spaced over a turn; the response is measured from one of them");
  CurveFit fit;
  int used = 0;
  for (const FrameStack& stack : stacks) {
    require(determines_response(stack.pattern) &&
                stack.frames.size() == stack.pattern.shifts_rad.size(),
            "measure_fringe_response: needs six or more frames evenly spaced over a turn");
    used += add_pixels(stack, fit);
  }
  require(used >= kMinPixels,
          "the fringes illuminate too few unsaturated pixels; check the exposure");
  const Eigen::VectorXd light = fit.solve();
  std::vector<double> levels;
  levels.reserve(kKnots);
  for (int k = 0; k < kKnots; ++k)
    levels.push_back(static_cast<double>(k) / (kKnots - 1));
  return make_response_curve(levels, {light.begin(), light.end()});
}

}  // namespace frangia
