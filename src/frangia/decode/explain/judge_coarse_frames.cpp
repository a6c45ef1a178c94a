#include "frangia/decode/explain/judge_coarse_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/decode/explain/internal/decided_fault.h"
#include "frangia/decode/explain/internal/frame_design.h"
#include "frangia/decode/explain/internal/frame_priors.h"
#include "frangia/decode/explain/internal/frame_sample.h"
#include "frangia/diagnose/score.h"

namespace frangia {
namespace {

constexpr std::size_t kLeastCoarse = 3;  ///< frames
constexpr std::size_t kMostCoarse = 12;
constexpr Eigen::Index kFewestCoarse = 200;  ///< pixels
constexpr Eigen::Index kEnoughCoarse = 450;
/// RMS over the modulation of what sound frames leave, and what is no sound one leaves at least.
constexpr double kRestOfCoarse = 0.03;
constexpr double kFaultOfCoarse = 0.1;
constexpr double kMostOfFault = 0.25;  ///< of the mean square, that the others leave at most
/// Length of the mean of exp(i difference) with the phase of the finer pattern.
constexpr double kLeastConcentration = 0.6;

/// Mean, cosine, second and third harmonic, each over that of the references.
using Factors = Eigen::Vector4d;

Factors shares_of(double phase_rad) {
  const double cosine = std::cos(phase_rad);
  return {1.0, cosine, 2.0 * cosine * cosine - 1.0, cosine * (4.0 * cosine * cosine - 3.0)};
}

/// Frames of a pattern at pixels whose mean and modulation other patterns tell.
struct CoarseFit {
  double misfit = INFINITY;  ///< of three quarters of the pixels, over the square of the modulation
  Eigen::ArrayXd phases_rad;
};

class CoarseFrames {
 public:
  CoarseFrames(const FrameSample& sample, std::vector<double> shifts_rad)
      : sample_(sample), shifts_rad_(std::move(shifts_rad)) {
    const Eigen::Index every = std::max<Eigen::Index>(1, sample.counts.rows() / kEnoughCoarse);
    for (Eigen::Index i = 0; i < sample.counts.rows(); i += every)
      if (sample.reference_modulation(i) > 0.0 && std::isfinite(sample.reference_mean(i)))
        pixels_.push_back(i);
  }
  [[nodiscard]] const std::vector<Eigen::Index>& pixels() const { return pixels_; }

  /// Fits the phase of each pixel, and the factors of all, to some of the frames.
  [[nodiscard]] CoarseFit fit(const std::vector<std::size_t>& frames) const {
    constexpr int kRounds = 5;
    CoarseFit out;
    out.phases_rad.resize(std::ssize(pixels_));
    Factors factors(1.0, 1.0, 0.0, 0.0);
    for (int round = 0; round < kRounds; ++round) {
      for (std::size_t i = 0; i < pixels_.size(); ++i)
        out.phases_rad(static_cast<Eigen::Index>(i)) = phase_of(pixels_[i], frames, factors);
      if (round + 1 < kRounds) factors = factors_of(out.phases_rad, frames);
    }
    std::vector<double> squares;
    for (std::size_t i = 0; i < pixels_.size(); ++i)
      squares.push_back(
          square(pixels_[i], frames, factors, out.phases_rad(static_cast<Eigen::Index>(i))));
    const auto high = squares.begin() + std::ssize(squares) * 3 / 4;
    std::nth_element(squares.begin(), high, squares.end());
    out.misfit = *high / static_cast<double>(frames.size() - 1);
    return out;
  }

  /// How well the phases are those of a finer pattern, but for a constant: 0 to 1; 1 where the
  /// ratio of the patterns is no integer.
  [[nodiscard]] double concentration(const Eigen::ArrayXd& phases_rad) const {
    if (sample_.reference_phase_rad.size() == 0) return 1.0;
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      const double difference_rad =
          sample_.periods * phases_rad(static_cast<Eigen::Index>(i)) -
          sample_.reference_periods * sample_.reference_phase_rad(pixels_[i]);
      sum += std::polar(1.0, difference_rad);
    }
    return std::abs(sum) / static_cast<double>(pixels_.size());
  }

 private:
  [[nodiscard]] double expected(Eigen::Index pixel, const Factors& factors, double phase) const {
    const Factors shares = factors.cwiseProduct(shares_of(phase));
    return shares(0) * sample_.reference_mean(pixel) +
           shares.tail<3>().sum() * sample_.reference_modulation(pixel);
  }
  /// Sum of the squared residuals over the square of the modulation.
  [[nodiscard]] double square(Eigen::Index pixel,
                              const std::vector<std::size_t>& frames,
                              const Factors& factors,
                              double phase_rad) const {
    double sum = 0.0;
    for (const std::size_t k : frames) {
      const double rest = sample_.counts(pixel, static_cast<Eigen::Index>(k)) -
                          expected(pixel, factors, phase_rad + shifts_rad_[k]);
      sum += rest * rest;
    }
    return sum / std::pow(sample_.reference_modulation(pixel), 2);
  }
  /// The phase with the least residual: of a grid, then by halving its step.
  [[nodiscard]] double phase_of(Eigen::Index pixel,
                                const std::vector<std::size_t>& frames,
                                const Factors& factors) const {
    constexpr int kGrid = 16;
    constexpr int kHalvings = 9;
    double best = 0.0;
    double least = INFINITY;
    const auto look_at = [&](double phase_rad) {
      const double found = square(pixel, frames, factors, phase_rad);
      if (found >= least) return;
      least = found;
      best = phase_rad;
    };
    for (int k = 0; k < kGrid; ++k)
      look_at(kTwoPi * k / kGrid);
    double step = 0.5 * kTwoPi / kGrid;
    for (int k = 0; k < kHalvings; ++k, step *= 0.5) {
      const double middle = best;
      look_at(middle - step);
      look_at(middle + step);
    }
    return best;
  }
  [[nodiscard]] Factors factors_of(const Eigen::ArrayXd& phases_rad,
                                   const std::vector<std::size_t>& frames) const {
    const Factors expected(1.0, 1.0, 0.0, 0.0);
    const Factors priors(0.05, 0.2, prior_harmonic(2), prior_harmonic(3));
    const double weight =
        kFieldWitnesses / static_cast<double>(pixels_.size()) / (kRestOfCoarse * kRestOfCoarse);
    Eigen::Matrix4d normal = priors.array().square().inverse().matrix().asDiagonal();
    Eigen::Vector4d right = normal * expected;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      const Eigen::Index pixel = pixels_[i];
      const double modulation = sample_.reference_modulation(pixel);
      for (const std::size_t k : frames) {
        Factors row = shares_of(phases_rad(static_cast<Eigen::Index>(i)) + shifts_rad_[k]);
        row(0) *= sample_.reference_mean(pixel) / modulation;
        normal += weight * row * row.transpose();
        right += weight * sample_.counts(pixel, static_cast<Eigen::Index>(k)) / modulation * row;
      }
    }
    return normal.ldlt().solve(right);
  }

  const FrameSample& sample_;
  std::vector<double> shifts_rad_;
  std::vector<Eigen::Index> pixels_;
};

std::vector<std::size_t> all_but(std::size_t frames, std::size_t left_out) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < frames; ++k)
    if (k != left_out) out.push_back(k);
  return out;
}

/// The evidence of Gaussian rests of unknown size, and of how the phases differ from those of the
/// finer pattern: in a normal way, or as chance has it.
double evidence_of(double misfit, double concentration) {
  constexpr double kNormal = 2.0 * kPi * 2.718281828459045;  // 2 pi e
  constexpr double kSurest_rad = 0.2;
  const double variance =
      std::max(kSurest_rad * kSurest_rad, -2.0 * std::log(std::max(1e-3, concentration)));
  const double of_phase = std::log(kTwoPi) - 0.5 * std::log(kNormal * variance);
  return kFieldWitnesses *
         (std::max(0.0, of_phase) - 0.5 * std::log(misfit + kRestOfCoarse * kRestOfCoarse));
}

/// What the frame shows instead.
std::string text_of_lost(const FrameSample& sample, std::size_t frame) {
  constexpr double kBlack = 0.25;
  const Eigen::ArrayXd counts = sample.counts.col(static_cast<Eigen::Index>(frame));
  double sum = 0.0;
  double count = 0.0;
  for (Eigen::Index i = 0; i < counts.size(); ++i) {
    const double bright = sample.reference_mean(i) + sample.reference_modulation(i);
    if (!(bright > 0.0)) continue;
    sum += counts(i) / bright;
    count += 1.0;
  }
  if (sum < kBlack * count) return fmt::format("frame {} is black", frame);
  return fmt::format("frame {} shows something else than the other frames and the other patterns",
                     frame);
}

/// The explanation of the frames, if one lost frame is it.
std::optional<std::pair<std::size_t, Explanation>> find_lost(const CoarseFrames& coarse,
                                                             const FrameSample& sample,
                                                             std::size_t frames) {
  const CoarseFit of_all = coarse.fit(all_but(frames, frames));
  const double described = of_all.misfit;
  const double concentration = coarse.concentration(of_all.phases_rad);
  if (described < kFaultOfCoarse * kFaultOfCoarse && concentration >= kLeastConcentration)
    return std::nullopt;
  std::vector<ScoredHypothesis> scored{
      {"the frames are as described", evidence_of(described, concentration), std::sqrt(described)}};
  std::vector<double> misfits;
  std::vector<double> concentrations;
  for (std::size_t k = 0; k < frames; ++k) {
    const CoarseFit without = coarse.fit(all_but(frames, k));
    misfits.push_back(without.misfit);
    concentrations.push_back(coarse.concentration(without.phases_rad));
    scored.push_back({text_of_lost(sample, k),
                      evidence_of(without.misfit, concentrations.back()) - price_of_choice(frames) +
                          std::log(kPriorFault),
                      std::sqrt(without.misfit),
                      {},
                      k + 1});
  }
  Explanation found = choose(scored);
  if (!found.is_decided() || found.likeliest == 0) return std::nullopt;
  const std::size_t lost = found.likeliest - 1;
  // The phase of the finer pattern decides where a frame without light leaves hardly a residual.
  const double most = concentration < kLeastConcentration ? INFINITY : kMostOfFault * described;
  if (misfits[lost] > std::min(kFaultOfCoarse * kFaultOfCoarse, most) ||
      concentrations[lost] < kLeastConcentration)
    return std::nullopt;
  return std::pair{lost, std::move(found)};
}

}  // namespace

std::optional<FrameVerdict> judge_coarse_frames(const FrameStack& stack,
                                                const NoiseModel& noise,
                                                const JudgeOptions& options) {
  const std::size_t frames = stack.frames.size();
  if (options.references.empty() || frames != stack.pattern.shifts_rad.size() ||
      frames < kLeastCoarse || frames > kMostCoarse)
    return std::nullopt;
  const FrameSample sample = sample_blocks(stack, noise, options.references);
  if (!sample.has_reference()) return std::nullopt;
  const CoarseFrames coarse(sample, stack.pattern.shifts_rad);
  if (std::ssize(coarse.pixels()) < kFewestCoarse) return std::nullopt;
  auto lost = find_lost(coarse, sample, frames);
  if (!lost) return std::nullopt;
  auto& [frame, explanation] = *lost;
  FrameVerdict out;
  FrameExplanation& found = out.explanation;
  found = decided_fault(stack.pattern, FrameCause::Lost, {frame});
  found.explanation = std::move(explanation);
  found.explanation.remedy = "capture the frames again, the projector and the camera in step";
  out.finding = fmt::format("pattern \"{}\": {}", found.pattern, describe(found.explanation));
  out.action = FrameAction::LeaveOutView;
  const FrameStack rest = without_frames(stack, std::array{frame});
  if (options.may_leave_out && determine_phase(rest.pattern.shifts_rad)) {
    out.left_out = {frame};
    out.action = FrameAction::LeaveOutFrames;
  }
  return out;
}

}  // namespace frangia
