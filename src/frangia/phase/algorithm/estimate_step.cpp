#include "frangia/phase/algorithm/estimate_step.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <Eigen/Core>

#include "frangia/core/angles.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/phase/internal/fit_residuals.h"
#include "frangia/phase/internal/fringe_curve.h"
#include "frangia/phase/waveform/frame_samples.h"

namespace frangia {
namespace {

/// The step of fringes that have harmonics.
struct HarmonicStep {
  /// Harmonics at the nominal step explain the frames better than a sine at the estimated step.
  bool harmonics = false;
  bool found = false;      ///< six frames or more determine the step in spite of the harmonics
  double step_rad = 0.0;   ///< valid if `found`
  double sigma_rad = 0.0;  ///< standard deviation of `step_rad`
};

constexpr std::size_t kStepSamples = 30'000;  ///< pixels for the harmonics
constexpr double kStepRange = 0.25;           ///< largest relative error of the step
constexpr int kScan = 200;                    ///< steps of the first search
constexpr int kRefinements = 60;              ///< golden sections, down to the rounding error

/// Sum of squares of the frames that a mean and `harmonics` free harmonics of this step leave.
class FreeHarmonics {
 public:
  FreeHarmonics(const Eigen::ArrayXXf& counts, int harmonics)
      : products_(products_of(counts)), harmonics_(harmonics) {}

  [[nodiscard]] double operator()(double step_rad) const {
    const Eigen::Index frames = products_.rows();
    Eigen::MatrixXd model(frames, 1 + 2 * harmonics_);
    for (Eigen::Index k = 0; k < frames; ++k) {
      model(k, 0) = 1.0;
      for (int n = 1; n <= harmonics_; ++n) {
        const double angle = n * step_rad * static_cast<double>(k);
        model(k, 2 * n - 1) = std::cos(angle);
        model(k, 2 * n) = std::sin(angle);
      }
    }
    const double explained = congruence(orthonormal_basis(model), products_).trace();
    return std::max(products_.trace() - explained, 0.0);
  }

 private:
  static Eigen::MatrixXd products_of(const Eigen::ArrayXXf& counts) {
    const Eigen::MatrixXd all = counts.matrix().cast<double>();
    return transposed_product(all, all);
  }
  Eigen::MatrixXd products_;
  int harmonics_;
};

/// The sum of squares that coherent harmonics at the nominal step explain, as a share of all
/// residuals of the sampled pixels.
double explained_by_harmonics(const FrameStack& stack) {
  const NoiseModel unit{.floor_counts2 = 1.0};  // squares in counts
  const FringeBins bins = bin_fringes(
      stack, stack.pattern.shifts_rad, unit, kStepSamples, least_squares(stack.pattern.shifts_rad));
  if (bins.pixels == 0) return 0.0;
  return explained_residual(bins, stack.pattern.shifts_rad) / static_cast<double>(bins.pixels);
}

/// Compares the evidence for a wrong step `step_rad` with that for harmonics at the nominal step.
/// With harmonics, it estimates the step for which a mean and several free harmonics of each pixel
/// leave the least residual.
///
/// @shape    `counts` one row per pixel, one column per frame
HarmonicStep find_harmonic_step(const FrameStack& stack,
                                const Eigen::ArrayXXf& counts,
                                double nominal_rad,
                                double step_rad) {
  HarmonicStep out;
  const auto pixels = static_cast<double>(counts.rows());
  const FreeHarmonics sine(counts, 1);
  const double with_harmonics = sine(nominal_rad) / pixels - explained_by_harmonics(stack);
  out.harmonics = with_harmonics < sine(step_rad) / pixels;
  const auto frames = static_cast<int>(counts.cols());
  if (!out.harmonics || frames < 6) return out;

  const FreeHarmonics free(counts, std::min(4, (frames - 2) / 2));
  const double range = kStepRange * std::abs(nominal_rad);
  double best = nominal_rad;
  double least = free(best);
  for (int i = 0; i <= kScan; ++i) {
    const double trial = nominal_rad + range * (2.0 * i / kScan - 1.0);
    const double cost = free(trial);
    if (cost >= least) continue;
    best = trial;
    least = cost;
  }
  const double spacing = 2.0 * range / kScan;
  double low = best - spacing;
  double high = best + spacing;
  constexpr double kGolden = 0.6180339887498949;
  for (int i = 0; i < kRefinements; ++i) {
    const double a = high - kGolden * (high - low);
    const double b = low + kGolden * (high - low);
    (free(a) < free(b) ? high : low) = free(a) < free(b) ? b : a;
  }
  out.step_rad = 0.5 * (low + high);
  least = free(out.step_rad);
  const double probe = 0.1 * spacing;
  const double curvature =
      (free(out.step_rad + probe) - 2.0 * least + free(out.step_rad - probe)) / (probe * probe);
  const double freedom = pixels * (frames - 1 - 2 * std::min(4, (frames - 2) / 2));
  out.sigma_rad = std::sqrt(2.0 * least / freedom / curvature);
  const bool inside = std::abs(out.step_rad - nominal_rad) < range - spacing;
  out.found = curvature > 0.0 && inside && std::isfinite(out.sigma_rad);
  return out;
}

/// Sampled pixels of up to 16 frames. At 1 % noise the standard error of a step is then below 1e-4
/// rad. With more frames, fewer pixels suffice: each window of four frames adds to the estimate.
constexpr std::size_t kSampledPixels = 400'000;
constexpr std::size_t kMaxCounts = 16 * kSampledPixels;  ///< pixels times frames: 26 MB
constexpr Eigen::Index kMinStepSamples = 100;            ///< fewer pixels do not determine the step

/// Least ratio of the variance along the fitted line to the variance across it.
constexpr double kMinSignal = 4.0;

/// Least |sine| of a step, and of 1.5 steps for the jitter; below it the equations are nearly
/// singular.
constexpr double kMinSine = 0.1;

/// Least significance of a jitter, in sigmas; smaller ones are noise.
constexpr double kJitterSigmas = 4.0;

/// Largest plausible gain error of a phase shifter. A larger estimate is rejected.
constexpr double kMaxGainError = 0.25;

/// The nominal step, not wrapped: a shifter moves by 270 degrees for 270, and its error is
/// proportional. 0 when the shifts are not equally spaced.
double nominal_step(const std::vector<double>& shifts_rad) {
  const double step = shifts_rad[1] - shifts_rad[0];
  for (std::size_t k = 2; k < shifts_rad.size(); ++k) {
    if (std::abs(shifts_rad[k] - shifts_rad[k - 1] - step) > 1e-6) return 0.0;
  }
  return step;
}

/// Returns the angle nearest to `nominal` with this cosine.
double nearest_angle(double cosine, double nominal) {
  const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
  const double up = nominal + wrap_rad(angle - nominal);
  const double down = nominal + wrap_rad(-angle - nominal);
  return std::abs(up - nominal) < std::abs(down - nominal) ? up : down;
}

/// The phase shift of I1 - I4 relative to I2 - I3: the mean error of shifts 1 and 4 less that of
/// shifts 2 and 3. It follows from the coefficient b in I1 - I4 = a (I2 - I3) + b (I2 + I3 - I1 -
/// I4).
double shift_error_of_window(const Eigen::ArrayXXf& counts, Eigen::Index k, double step) {
  const double outer = std::sin(1.5 * step);
  if (std::abs(outer) < kMinSine) return 0.0;
  Eigen::MatrixX3d contrasts(counts.rows(), 3);
  const auto frame = [&](Eigen::Index i) { return counts.col(k + i).cast<double>(); };
  contrasts.col(0) = (frame(0) - frame(3)) / std::numbers::sqrt2;
  contrasts.col(1) = (frame(1) - frame(2)) / std::numbers::sqrt2;
  contrasts.col(2) = 0.5 * (frame(1) + frame(2) - frame(0) - frame(3));
  const Eigen::Matrix3d products = contrasts.transpose() * contrasts;
  const SymmetricEigen<3> eigen = symmetric_eigen(products);
  const Eigen::Vector3d relation = eigen.vectors.col(0);
  if (std::abs(relation(0)) < 1e-3) return 0.0;
  const double b = -relation(2) / relation(0) / std::numbers::sqrt2;
  const double sigma =
      2.0 * std::sqrt(std::max(eigen.values(0), 0.0) / std::max(products(2, 2), 1e-9) /
                      static_cast<double>(counts.rows()));
  if (std::abs(b) < kJitterSigmas * sigma) return 0.0;
  return b * (std::cos(0.5 * step) - std::cos(1.5 * step)) / outer;
}

/// Rms error of single shifts, from all windows of four frames.
double jitter_of(const Eigen::ArrayXXf& counts, double step) {
  double sum = 0.0;
  for (Eigen::Index k = 0; k + 3 < counts.cols(); ++k) {
    const double turn = shift_error_of_window(counts, k, step);
    sum += turn * turn;
  }
  return std::sqrt(sum / static_cast<double>(counts.cols() - 3));
}

}  // namespace

StepEstimate estimate_step(const FrameStack& stack) {
  StepEstimate out;
  if (stack.frames.size() < 4 || stack.pattern.shifts_rad.size() != stack.frames.size()) return out;
  out.nominal_rad = out.step_rad = nominal_step(stack.pattern.shifts_rad);
  if (std::abs(std::sin(out.nominal_rad)) < kMinSine) return out;
  const Eigen::ArrayXXf counts =
      sample_frames(stack, std::min(kSampledPixels, kMaxCounts / stack.frames.size()));
  if (counts.rows() < kMinStepSamples) return out;
  out.mean_counts = static_cast<double>(counts.mean());

  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (Eigen::Index k = 0; k + 3 < counts.cols(); ++k) {
    const Eigen::ArrayXd x = (counts.col(k + 1) - counts.col(k + 2)).cast<double>();
    const Eigen::ArrayXd y = (counts.col(k) - counts.col(k + 3)).cast<double>();
    xx += x.square().sum();
    xy += (x * y).sum();
    yy += y.square().sum();
  }
  const double n = static_cast<double>(counts.rows() * (counts.cols() - 3));
  const double half_spread = 0.5 * std::hypot(xx - yy, 2.0 * xy);
  const double along = 0.5 * (xx + yy) + half_spread;
  const double across = std::max(0.5 * (xx + yy) - half_spread, 0.0);
  out.residual_counts2 = across / n / 2.0;  // each difference contains the noise of two frames
  if (!(along > kMinSignal * across)) return out;

  const double line = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const double slope = std::tan(line);
  const double step = nearest_angle(0.5 * (slope - 1.0), out.nominal_rad);
  if (!(std::abs(step / out.nominal_rad - 1.0) < kMaxGainError)) return out;
  out.jitter_rad = jitter_of(counts, step);
  const HarmonicStep harmonic = find_harmonic_step(stack, counts, out.nominal_rad, step);
  if (harmonic.harmonics) {
    out.jitter_rad = 0.0;  // the harmonics explain the residuals
    if (!harmonic.found) return out;
    out.step_rad = harmonic.step_rad;
    out.sigma_rad = harmonic.sigma_rad;
    out.found = true;
    return out;
  }
  const double line_sigma = std::sqrt(along * across / n) / (along - across);
  out.step_rad = step;
  out.sigma_rad = line_sigma * (1.0 + slope * slope) / (2.0 * std::abs(std::sin(step)));
  out.found = true;
  return out;
}

}  // namespace frangia
