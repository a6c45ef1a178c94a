#include "frangia/decode/explain/explain_predicted_frames.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include <Eigen/Cholesky>

#include "frangia/core/angles.h"
#include "frangia/decode/explain/internal/frame_priors.h"
#include "frangia/diagnose/score.h"

namespace frangia {
namespace {

constexpr Eigen::Index kThreeFrames = 3;
constexpr Eigen::Index kMinPredicted = 200;  ///< pixels; fewer explain nothing
constexpr Eigen::Index kUsedPixels = 1500;
constexpr int kNewtonSteps = 8;
constexpr double kOutlierSquares = 9.0;  ///< squared residuals count up to this multiple
/// What a sound set leaves of the modulation at least, and its prior standard deviation.
constexpr double kLeastRest = 0.02;
constexpr double kSoundPredicted = 0.05;
/// Prior standard deviations of what is fitted for all pixels together.
constexpr double kPriorModulation = 0.3;  ///< over that of the coarser pattern
constexpr double kPriorFaultyGain = 0.5;
constexpr double kPriorPhase_rad = 0.5;  ///< of a pixel about the predicted one

/// Places of the parameters in the list of them.
enum Parameter : Eigen::Index {
  kAtModulation = 0,
  kAtGains = 1,
  kAtSecond = 4,
  kAtThird = 6,
  kAtLamp = 8,
  kAtSteps = 10,
  kParameters = 13
};
using Parameters = Eigen::Matrix<double, kParameters, 1>;
using Normal = Eigen::Matrix<double, kParameters, kParameters>;
using Row = Eigen::Matrix<double, kThreeFrames, kParameters>;
using Three = Eigen::Matrix<double, kThreeFrames, 1>;

/// The frames of all pixels as one hypothesis sees them.
class PredictedFit {
 public:
  PredictedFit(const PredictedFrames& frames,
               const FrameHypothesis& hypothesis,
               const Eigen::ArrayXd& noise)
      : frames_(frames), hypothesis_(hypothesis), noise_(noise), phase_(frames.phase_rad) {
    values_.setZero();
    values_(kAtModulation) = 1.0;
    values_.segment<kThreeFrames>(kAtGains).setOnes();
    priors_.setZero();
    priors_(kAtModulation) = kPriorModulation;
    priors_.segment<kThreeFrames>(kAtGains).setConstant(kPriorGain);
    priors_.segment<2>(kAtSecond).setConstant(prior_harmonic(2));
    priors_.segment<2>(kAtThird).setConstant(prior_harmonic(3));
    if (hypothesis.cause == FrameCause::Gain)
      priors_(kAtGains + static_cast<Eigen::Index>(hypothesis.frames.front())) = kPriorFaultyGain;
    if (hypothesis.lamp_on) priors_.segment<2>(kAtLamp).setConstant(kPriorLamp);
    if (hypothesis.has_free_steps)
      priors_.segment<kThreeFrames>(kAtSteps).setConstant(kPriorStep_rad);
    expected_ = values_;
  }

  void fit() {
    for (int round = 0; round < kNewtonSteps; ++round)
      step();
  }

  [[nodiscard]] double gain(std::size_t frame) const {
    return values_(kAtGains + static_cast<Eigen::Index>(frame));
  }
  [[nodiscard]] double unexplained() const { return relative_; }
  /// Share of the variance of the residuals that is not noise.
  [[nodiscard]] double excess() const {
    const Eigen::ArrayXd variance = variances();
    return (1.0 - noise_ / variance).mean();
  }

  /// The log evidence of `share` of the pixels.
  [[nodiscard]] double log_evidence(double share) const {
    double out = 0.0;
    const Eigen::ArrayXd variance = variances();
    for (Eigen::Index i = 0; i < noise_.size(); ++i) {
      const double square = std::min(squares_(i), freedom() * kOutlierSquares * variance(i));
      out -= 0.5 * (square / variance(i) + freedom() * std::log(kTwoPi * variance(i)));
    }
    out = share * (out + log_density_of_lost());
    Normal scaled = share * normal_;
    for (Eigen::Index p = 0; p < kParameters; ++p) {
      if (priors_(p) == 0.0) continue;
      out -= 0.5 * std::pow((values_(p) - expected_(p)) / priors_(p), 2);
    }
    scaled.diagonal().array() += 1.0;
    const Eigen::LLT<Normal> factor(scaled);
    for (Eigen::Index p = 0; p < kParameters; ++p)
      out -= std::log(factor.matrixLLT()(p, p));
    return out;
  }

 private:
  [[nodiscard]] bool is_lost(Eigen::Index k) const {
    return hypothesis_.free[static_cast<std::size_t>(k)];
  }
  /// Residuals of a pixel without its own phase.
  [[nodiscard]] double freedom() const {
    const auto lost = std::count(hypothesis_.free.begin(), hypothesis_.free.end(), true);
    return static_cast<double>(kThreeFrames - 1 - lost);
  }
  [[nodiscard]] Eigen::ArrayXd variances() const {
    const double counted = std::max(relative_, kLeastRest);
    return noise_ + (counted * frames_.modulation).square();
  }

  /// The residuals of a pixel, their slope over its phase and over the parameters.
  void linearize(Eigen::Index i, Three& rest, Three& slope, Row& effects) const {
    rest.setZero();
    slope.setZero();
    effects.setZero();
    const double x = values_(kAtModulation) * frames_.modulation(i);
    const std::complex<double> second(values_(kAtSecond), values_(kAtSecond + 1));
    const std::complex<double> third(values_(kAtThird), values_(kAtThird + 1));
    const std::complex<double> imaginary(0.0, 1.0);
    for (Eigen::Index k = 0; k < kThreeFrames; ++k) {
      if (is_lost(k)) continue;
      const double shift =
          hypothesis_.shifts_rad[static_cast<std::size_t>(k)] + values_(kAtSteps + k);
      const auto turn = std::polar(1.0, phase_(i) + shift);
      const auto twice = turn * turn;
      const auto thrice = twice * turn;
      const double wave = (turn + second * twice + third * thrice).real();
      const double light = frames_.mean(i) + x * wave;
      const double gain = values_(kAtGains + k);
      const double scale = frames_.mean(i) + x;
      double predicted = gain * light;
      slope(k) =
          gain * x * (imaginary * (turn + 2.0 * second * twice + 3.0 * third * thrice)).real();
      effects(k, kAtModulation) = gain * frames_.modulation(i) * wave;
      effects(k, kAtGains + k) = light;
      effects(k, kAtSecond) = gain * x * twice.real();
      effects(k, kAtSecond + 1) = -gain * x * twice.imag();
      effects(k, kAtThird) = gain * x * thrice.real();
      effects(k, kAtThird + 1) = -gain * x * thrice.imag();
      effects(k, kAtSteps + k) = slope(k);
      if (is_lit_by_lamp(hypothesis_, static_cast<std::size_t>(k))) {
        effects(k, kAtLamp) = mean_scale_;
        effects(k, kAtLamp + 1) = scale;
        predicted += values_(kAtLamp) * mean_scale_ + values_(kAtLamp + 1) * scale;
      }
      rest(k) = frames_.counts(i, k) - predicted;
    }
    for (Eigen::Index p = 0; p < kParameters; ++p)
      effects.col(p) *= priors_(p);
  }

  /// One step of Gauss and Newton, in which the phases of the pixels are eliminated.
  void step() {
    const Eigen::ArrayXd variance = variances();
    Parameters right = Parameters::Zero();
    normal_.setZero();
    double excess = 0.0;
    double scale = 0.0;
    Three rest;
    Three slope;
    Row effects;
    std::vector<Three> rests(static_cast<std::size_t>(noise_.size()));
    for (Eigen::Index i = 0; i < noise_.size(); ++i) {
      linearize(i, rest, slope, effects);
      const double prior = variance(i) / (kPriorPhase_rad * kPriorPhase_rad);
      const double off = wrap_rad(frames_.phase_rad(i) - phase_(i));
      const double curvature = slope.squaredNorm() + prior;
      const Parameters along = effects.transpose() * slope / curvature;
      const double phase_step = (slope.dot(rest) + prior * off) / curvature;
      squares_(i) = rest.squaredNorm() + prior * off * off - curvature * phase_step * phase_step;
      const double over = squares_(i) / (freedom() * variance(i));
      const double weight = std::min(1.0, kOutlierSquares / std::max(over, 1e-9)) / variance(i);
      normal_ += weight * (effects.transpose() * effects - curvature * along * along.transpose());
      right += weight * (effects.transpose() * rest - curvature * phase_step * along);
      excess += std::min(squares_(i) / freedom(), kOutlierSquares * variance(i)) - noise_(i);
      scale += frames_.modulation(i) * frames_.modulation(i);
    }
    relative_ = std::sqrt(std::max(0.0, excess / scale));
    Normal with_prior = normal_;
    with_prior.diagonal().array() += 1.0;
    for (Eigen::Index p = 0; p < kParameters; ++p)
      if (priors_(p) > 0.0) right(p) -= (values_(p) - expected_(p)) / priors_(p);
    const Parameters change = with_prior.ldlt().solve(right);
    values_ += (change.array() * priors_.array()).matrix();
    for (Eigen::Index i = 0; i < noise_.size(); ++i) {
      linearize(i, rest, slope, effects);
      const double prior = variance(i) / (kPriorPhase_rad * kPriorPhase_rad);
      const double off = wrap_rad(frames_.phase_rad(i) - phase_(i));
      constexpr double kMost_rad = 0.5;
      phase_(i) += std::clamp(
          (slope.dot(rest) + prior * off) / (slope.squaredNorm() + prior), -kMost_rad, kMost_rad);
    }
  }

  /// Density of lost frames: normal in counts, or relative to the light of the pixel.
  [[nodiscard]] double log_density_of_lost() const {
    double out = 0.0;
    for (Eigen::Index k = 0; k < kThreeFrames; ++k) {
      if (!is_lost(k)) continue;
      const Eigen::ArrayXd scale = frames_.mean + frames_.modulation;
      const Eigen::ArrayXd counts = frames_.counts.col(k);
      const Eigen::ArrayXd over = counts / scale;
      const double least = noise_.mean();
      const double in_counts = std::max((counts - counts.mean()).square().mean(), least);
      const double in_scale =
          std::max((over - over.mean()).square().mean(), least / scale.square().mean());
      const auto n = static_cast<double>(counts.size());
      out += std::max(-0.5 * n * (1.0 + std::log(kTwoPi * in_counts)),
                      -0.5 * n * (1.0 + std::log(kTwoPi * in_scale)) - scale.log().sum());
    }
    return out;
  }

  const PredictedFrames& frames_;
  const FrameHypothesis& hypothesis_;
  const Eigen::ArrayXd& noise_;
  Eigen::ArrayXd phase_;
  double mean_scale_ = (frames_.mean + frames_.modulation).mean();
  Parameters values_;
  Parameters expected_;
  Parameters priors_;
  Normal normal_ = Normal::Zero();  ///< in units of the priors
  Eigen::ArrayXd squares_ = Eigen::ArrayXd::Zero(noise_.size());
  double relative_ = 0.05;  ///< residual beyond the noise over the modulation
};

/// Every n-th pixel, and those with light.
PredictedFrames sampled(const PredictedFrames& all) {
  const Eigen::Index stride = std::max<Eigen::Index>(1, all.counts.rows() / kUsedPixels);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < all.counts.rows(); i += stride)
    if (all.modulation(i) > 1.0) kept.push_back(i);
  return {all.counts(kept, Eigen::all), all.mean(kept), all.modulation(kept), all.phase_rad(kept)};
}

std::vector<FrameHypothesis> predicted_hypotheses(const Pattern& pattern) {
  const FrameHypothesis declared = frame_hypotheses(pattern).front();
  std::vector<FrameHypothesis> out{declared, declared};
  out.back().cause = FrameCause::Unexplained;
  const auto add = [&](FrameCause cause, std::vector<std::size_t> frames, std::size_t choices) {
    out.push_back(declared);
    out.back().cause = cause;
    out.back().frames = std::move(frames);
    out.back().faults = 1;
    out.back().choices = choices;
  };
  for (std::size_t k = 0; k < static_cast<std::size_t>(kThreeFrames); ++k) {
    add(FrameCause::Lost, {k}, kThreeFrames);
    out.back().free[k] = true;
    out.back().parameters = 2;
    add(FrameCause::Gain, {k}, kThreeFrames);
    add(FrameCause::Lamp, {k}, kThreeFrames);
    out.back().lamp_on = k;
    out.back().lamp_off = k + 1;
    if (k == 0) continue;
    add(FrameCause::Repeated, {k}, kThreeFrames - 1);
    out.back().shifts_rad[k] = declared.shifts_rad[k - 1];
  }
  add(FrameCause::Steps, {}, 1);
  out.back().has_free_steps = true;
  return out;
}

}  // namespace

FrameExplanation explain_predicted_frames(const PredictedFrames& frames,
                                          const Pattern& pattern,
                                          const NoiseModel& noise) {
  FrameExplanation out{.pattern = pattern.name};
  if (frames.counts.cols() != kThreeFrames) return out;
  const PredictedFrames sample = sampled(frames);
  if (sample.counts.rows() < kMinPredicted) return out;
  const Eigen::ArrayXd variance =
      sample.counts.rowwise().mean().unaryExpr([&](double mean) { return noise.variance(mean); });
  std::vector<FrameHypothesis> hypotheses = predicted_hypotheses(pattern);
  std::vector<PredictedFit> fits;
  fits.reserve(hypotheses.size());
  double least_excess = 1.0;
  for (const FrameHypothesis& one : hypotheses) {
    fits.emplace_back(sample, one, variance);
    fits.back().fit();
    least_excess = std::min(least_excess, fits.back().excess());
  }
  const auto pixels = static_cast<double>(variance.size());
  const double share =
      1.0 / ((1.0 - least_excess) + least_excess * std::max(1.0, pixels / kFieldWitnesses));
  std::vector<ScoredHypothesis> scored;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    FrameHypothesis& one = hypotheses[i];
    double prior = std::log(kPriorFault);
    if (one.cause != FrameCause::Unexplained)
      prior = one.faults * prior - 0.5 * std::pow(fits[i].unexplained() / kSoundPredicted, 2);
    prior -= price_of_choice(one.choices) + one.parameters * price_of_parameter(share * pixels);
    if (one.cause == FrameCause::Gain) {
      one.gains[one.frames.front()] = fits[i].gain(one.frames.front());
      if (std::abs(std::log(std::max(one.gains[one.frames.front()], 1e-3))) < kStructuralGain)
        continue;
    }
    scored.push_back({describe(one),
                      fits[i].log_evidence(share) + prior,
                      fits[i].unexplained(),
                      one.faults > 0 ? "capture the frames again" : "",
                      i});
  }
  out.decided = true;
  out.explanation = choose(scored);
  out.best = hypotheses[scored[out.explanation.likeliest].prediction];
  return out;
}

}  // namespace frangia
