#include "frangia/phase/waveform/fringe_response.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/core/parallel.h"
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

namespace {

constexpr double kMinContrast =
    0.15;  ///< least contrast between the darkest and the brightest frame, as a fraction of white
constexpr std::size_t kMinIlluminated = 100;  ///< least number of pixels

/// Adds the counts of one view's illuminated pixels to the sum of each level; returns the number of
/// these pixels.
std::size_t add_illuminated(const FrameStack& ramp, std::vector<double>& sums) {
  const Frame& dark = ramp.frames.front();
  const Frame& full = ramp.frames.back();
  std::size_t illuminated = 0;
  for (int y = 0; y < height_of(full); ++y) {
    for (int x = 0; x < width_of(full); ++x) {
      const int brightest = counts_at(full, x, y);
      const int contrast = brightest - counts_at(dark, x, y);
      if (brightest >= ramp.white_level || contrast < kMinContrast * ramp.white_level) continue;
      ++illuminated;
      for (std::size_t k = 0; k < sums.size(); ++k)
        sums[k] += counts_at(ramp.frames[k], x, y);
    }
  }
  return illuminated;
}

}  // namespace

ResponseCurve measure_response(std::span<const FrameStack> ramps) {
  require(!ramps.empty(),
          "the scan has no pattern of kind \"ramp\", from which the response is measured");
  const std::vector<double>& levels = ramps.front().pattern.levels;
  std::vector<double> sums(levels.size(), 0.0);
  std::size_t illuminated = 0;
  for (const FrameStack& ramp : ramps) {
    require(ramp.pattern.levels == levels && ramp.frames.size() == levels.size(),
            "measure_response: the ramps differ in their levels or have another number of frames "
            "than levels");
    illuminated += add_illuminated(ramp, sums);
  }
  require(illuminated >= kMinIlluminated,
          "the ramp illuminates too few unsaturated pixels; check the exposure");
  return make_response_curve(levels, sums);
}

namespace {

constexpr std::size_t kProjectedPhases =
    2880;  ///< projected phases per fringe at which the error is computed
constexpr std::size_t kTableIntervals = 1024;  ///< intervals of the table

/// The table for fringes whose light over the phase is `light_of`; empty where two phases measure
/// alike.
template <typename Light>
std::optional<ResponseTable> table_of(const Light& light_of,
                                      const PhaseAlgorithm& algorithm,
                                      const std::vector<double>& shifts_rad,
                                      std::span<const double> gains) {
  std::vector<double> light(shifts_rad.size());
  const auto measured_phase = [&](double phase) {
    for (std::size_t k = 0; k < light.size(); ++k)
      light[k] = light_of(phase + shifts_rad[k]) * (gains.empty() ? 1.0 : 1.0 + gains[k]);
    return phase_of(algorithm, light);
  };
  // The measured phase is unwrapped, so that it rises over the whole fringe.
  std::vector<double> true_phase;
  std::vector<double> found;
  for (std::size_t i = 0; i <= kProjectedPhases; ++i) {
    const double phase = -kPi + kTwoPi * static_cast<double>(i) / kProjectedPhases;
    const double seen = measured_phase(phase);
    true_phase.push_back(phase);
    found.push_back(found.empty() ? phase + wrap_rad(seen - phase)
                                  : found.back() + wrap_rad(seen - found.back()));
    if (found.size() > 1 && !(found.back() > found[found.size() - 2])) return {};
  }
  ResponseTable table;
  for (std::size_t i = 0; i <= kTableIntervals; ++i) {
    double seen = -kPi + kTwoPi * static_cast<double>(i) / kTableIntervals;
    while (seen < found.front())
      seen += kTwoPi;
    while (seen > found.back())
      seen -= kTwoPi;
    const auto above = std::lower_bound(found.begin() + 1, found.end() - 1, seen);
    const auto k = static_cast<std::size_t>(above - found.begin());
    const double within = (seen - found[k - 1]) / (found[k] - found[k - 1]);
    table.correction_rad.push_back(
        static_cast<float>(std::lerp(true_phase[k - 1], true_phase[k], within) - seen));
  }
  return table;
}

ResponseTable required(std::optional<ResponseTable> table) {
  require(table.has_value(),
          "the projector's response is too nonlinear for its fringes to determine the phase; "
          "correct the projected patterns instead");
  return *std::move(table);
}

}  // namespace

ResponseTable response_table(const ResponseCurve& response,
                             const PhaseAlgorithm& algorithm,
                             const std::vector<double>& shifts_rad,
                             std::span<const double> gains) {
  const auto light_of = [&](double phase) {
    return response.light_of(0.5 + 0.5 * std::cos(phase));
  };
  double mean = 0.0;  // gains act on a part of the mean light, which no algorithm measures
  for (std::size_t i = 0; i < kProjectedPhases; ++i)
    mean += light_of(kTwoPi * static_cast<double>(i) / kProjectedPhases) / kProjectedPhases;
  return required(
      table_of([&](double phase) { return light_of(phase) - mean; }, algorithm, shifts_rad, gains));
}

ResponseTable response_table(const FringeWaveform& waveform,
                             const PhaseAlgorithm& algorithm,
                             const std::vector<double>& shifts_rad,
                             std::span<const double> gains) {
  return required(find_response_table(waveform, algorithm, shifts_rad, gains));
}

std::optional<ResponseTable> find_response_table(const FringeWaveform& waveform,
                                                 const PhaseAlgorithm& algorithm,
                                                 const std::vector<double>& shifts_rad,
                                                 std::span<const double> gains) {
  return table_of(
      [&](double phase) { return waveform.light_at(phase); }, algorithm, shifts_rad, gains);
}

double correction_at(const ResponseTable& table, double phase_rad) {
  const auto intervals = static_cast<double>(table.correction_rad.size() - 1);
  const double position =
      std::clamp((wrap_rad(phase_rad) + kPi) / kTwoPi * intervals, 0.0, intervals - 0.5);
  const auto k = static_cast<std::size_t>(position);
  return std::lerp(static_cast<double>(table.correction_rad[k]),
                   static_cast<double>(table.correction_rad[k + 1]),
                   position - static_cast<double>(k));
}

void correct_response(const ResponseTable& table, WrappedPhase& phase) {
  const auto intervals = static_cast<float>(table.correction_rad.size() - 1);
  const auto step = static_cast<float>(kTwoPi) / intervals;
  parallel_rows(phase.phase_rad.height(), [&](int y) {
    for (int x = 0; x < phase.phase_rad.width(); ++x) {
      float& value = phase.phase_rad(x, y);
      if (std::isnan(value)) continue;
      const float position =
          std::clamp((value + static_cast<float>(kPi)) / step, 0.0F, intervals - 0.5F);
      const auto k = static_cast<std::size_t>(position);
      const float rise = table.correction_rad[k + 1] - table.correction_rad[k];
      value = static_cast<float>(wrap_rad(static_cast<double>(
          value + table.correction_rad[k] + rise * (position - static_cast<float>(k)))));
      phase.sigma_rad(x, y) *= 1.0F + rise / step;
      if (!phase.systematic_rad.empty()) phase.systematic_rad(x, y) *= 1.0F + rise / step;
    }
  });
}

}  // namespace frangia
