#include "frangia/decode/explain/internal/score_frames.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>

#include <Eigen/Cholesky>

#include "frangia/core/angles.h"
#include "frangia/decode/explain/internal/frame_design.h"

namespace frangia {
namespace {

/// Prior standard deviation of the gain of a frame, of lamp and exposure.
constexpr double kPriorGain = 0.03;
/// Prior standard deviation of harmonic n over that of the fringes: 0.35 for the second one is
/// that of gamma 2.6; binary fringes have 1/n.
double prior_harmonic(int order) {
  return order == 2 ? 0.35 : 1.0 / order;
}
constexpr int kHighestHarmonic = 12;
/// Share and size, over the scale of a pixel, of what no model predicts: depth edges, highlights.
constexpr double kOutliers = 0.02;
constexpr double kOutlierSize = 0.4;
constexpr double kLimit = 9.0;  ///< squared residuals count up to this multiple of their variance
constexpr int kRounds = 3;
/// No model of fringes is more exact, relative to the modulation.
constexpr double kModelError = 0.005;
/// Probability that a pixel of a lost frame shows what the other frames predict: a torn frame.
constexpr double kTorn = 0.5;
/// Width of the density of counts of fringes over the scale of a pixel: a frame that is darker or
/// brighter everywhere by less than a quarter of it is no sound one.
constexpr double kBroad = 0.35;

double log_normal(double square, double variance, double count) {
  return -0.5 * (square / variance + count * std::log(kTwoPi * variance));
}

double log_of_mixture(double a, double b) {
  const double larger = std::max(a, b);
  return larger + std::log(std::exp(a - larger) + std::exp(b - larger));
}

/// The fringes of all pixels as one hypothesis sees them.
class FrameFit {
 public:
  FrameFit(const FrameSample& sample, const FrameHypothesis& hypothesis)
      : sample_(sample),
        hypothesis_(hypothesis),
        design_(design_of(hypothesis)),
        pixels_(sample.counts.rows()) {
    shown_.resize(pixels_, std::ssize(design_.shown));
    for (std::size_t i = 0; i < design_.shown.size(); ++i)
      shown_.col(static_cast<Eigen::Index>(i)) = sample.counts.col(design_.shown[i]).matrix();
    rest_ = shown_ * design_.rest;
    if (design_.inverse.size() > 0) {
      values_ = shown_ * design_.inverse.transpose();
      modulation_ = (values_.col(1).array().square() + values_.col(2).array().square()).sqrt();
      modulation_ = modulation_.min(sample.scale_counts).max(sample.variance.sqrt());
    } else {
      modulation_ = 0.5 * sample.scale_counts;
    }
  }

  FrameScore score() {
    FrameScore out;
    if (rest_.cols() > 0) fit_rest(out);
    for (Eigen::Index i = 0; i < pixels_; ++i)
      out.log_density += rest_.cols() > 0 ? log_density_of_rest(i) : 0.0;
    out.log_density += log_density_of_values() + log_density_of_free();
    return out;
  }

 private:
  /// The nuisances of one pixel: what each leaves of the design, per unit of its prior.
  void add_nuisances(Eigen::Index pixel, Eigen::MatrixXd& rows) const {
    const double a = values_(pixel, 0);
    const double c = values_(pixel, 1);
    const double s = values_(pixel, 2);
    const double phase = std::atan2(s, c);
    Eigen::Index column = 0;
    for (Eigen::Index i = 0; i < shown_.cols(); ++i) {
      const auto k = static_cast<std::size_t>(design_.shown[static_cast<std::size_t>(i)]);
      const double predicted = hypothesis_.gains[k] * (a + c * std::cos(hypothesis_.shifts_rad[k]) -
                                                       s * std::sin(hypothesis_.shifts_rad[k]));
      rows.col(column++) = kPriorGain * predicted * design_.rest.row(i).transpose();
    }
    const double b = modulation_(pixel);
    for (const Wave& wave : waves_) {
      const double size = b * prior_harmonic(wave.order);
      const double cosine = size * std::cos(wave.order * phase);
      const double sine = size * std::sin(wave.order * phase);
      rows.col(column++) = cosine * wave.real - sine * wave.imaginary;
      rows.col(column++) = sine * wave.real + cosine * wave.imaginary;
    }
  }

  /// Fits mean, modulation and phase again to the frames without their nuisances, which shift the
  /// phase where the steps are not equal.
  void refine_values(const Eigen::VectorXd& found) {
    const Eigen::Index frames = shown_.cols();
    Eigen::VectorXd corrected(frames);
    for (Eigen::Index i = 0; i < pixels_; ++i) {
      const double phase = std::atan2(values_(i, 2), values_(i, 1));
      const double b = std::hypot(values_(i, 1), values_(i, 2));
      for (Eigen::Index row = 0; row < frames; ++row) {
        const auto k = static_cast<std::size_t>(design_.shown[static_cast<std::size_t>(row)]);
        const std::complex<double> turn = std::polar(1.0, phase + hypothesis_.shifts_rad[k]);
        std::complex<double> power = turn;
        double extra = kPriorGain * found(row) * (values_(i, 0) + b * turn.real());
        Eigen::Index column = frames;
        std::size_t wave = 0;
        for (int order = 2; order <= kHighestHarmonic && wave < waves_.size(); ++order) {
          power *= turn;
          if (waves_[wave].order != order) continue;
          ++wave;
          const double size = b * prior_harmonic(order);
          extra += size * (found(column) * power.real() + found(column + 1) * power.imag());
          column += 2;
        }
        corrected(row) = shown_(i, row) - hypothesis_.gains[k] * extra;
      }
      values_.row(i) = (design_.inverse * corrected).transpose();
    }
    modulation_ = (values_.col(1).array().square() + values_.col(2).array().square()).sqrt();
    modulation_ = modulation_.min(sample_.scale_counts).max(sample_.variance.sqrt());
  }

  void find_waves() {
    constexpr double kVisible = 1e-3;
    for (int order = 2; order <= kHighestHarmonic; ++order) {
      Eigen::VectorXd cosine(shown_.cols());
      Eigen::VectorXd sine(shown_.cols());
      for (Eigen::Index i = 0; i < shown_.cols(); ++i) {
        const auto k = static_cast<std::size_t>(design_.shown[static_cast<std::size_t>(i)]);
        cosine(i) = hypothesis_.gains[k] * std::cos(order * hypothesis_.shifts_rad[k]);
        sine(i) = hypothesis_.gains[k] * std::sin(order * hypothesis_.shifts_rad[k]);
      }
      const Wave wave{order, design_.rest.transpose() * cosine, design_.rest.transpose() * sine};
      if (wave.real.squaredNorm() + wave.imaginary.squaredNorm() > kVisible) waves_.push_back(wave);
    }
  }

  void fit_rest(FrameScore& out) {
    const Eigen::Index freedom = rest_.cols();
    const bool determined = design_.inverse.size() > 0;
    if (determined) find_waves();
    const Eigen::Index count = determined ? shown_.cols() + 2 * std::ssize(waves_) : 0;
    std::vector<Eigen::MatrixXd> rows(static_cast<std::size_t>(count > 0 ? pixels_ : 0),
                                      Eigen::MatrixXd(freedom, count));
    for (Eigen::Index i = 0; i < std::ssize(rows); ++i)
      add_nuisances(i, rows[static_cast<std::size_t>(i)]);
    residual_ = rest_;
    double relative = 0.05;  // of the modulation, to begin with
    variance_ = sample_.variance + relative * relative * modulation_.square();
    Eigen::MatrixXd normal;
    Eigen::VectorXd found = Eigen::VectorXd::Zero(count);
    for (int round = 0; round < kRounds && count > 0; ++round) {
      normal = Eigen::MatrixXd::Zero(count, count);
      Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
      for (Eigen::Index i = 0; i < pixels_; ++i) {
        const Eigen::MatrixXd& row = rows[static_cast<std::size_t>(i)];
        const double over =
            residual_.row(i).squaredNorm() / (static_cast<double>(freedom) * variance_(i));
        const double weight = std::min(1.0, kLimit / std::max(over, 1e-9)) / variance_(i);
        normal.selfadjointView<Eigen::Lower>().rankUpdate(row.transpose(), weight);
        right.noalias() += weight * row.transpose() * rest_.row(i).transpose();
      }
      normal = Eigen::MatrixXd(normal.selfadjointView<Eigen::Lower>());
      Eigen::MatrixXd with_prior = normal;
      with_prior.diagonal().array() += 1.0;
      found = with_prior.ldlt().solve(right);
      for (Eigen::Index i = 0; i < pixels_; ++i) {
        residual_.row(i) = rest_.row(i) - (rows[static_cast<std::size_t>(i)] * found).transpose();
      }
      relative = excess_over_modulation(relative);
      if (round + 1 == kRounds) break;
      refine_values(found);
      for (Eigen::Index i = 0; i < std::ssize(rows); ++i)
        add_nuisances(i, rows[static_cast<std::size_t>(i)]);
    }
    if (count == 0) {
      for (int round = 0; round < kRounds; ++round)
        relative = excess_over_modulation(relative);
    }
    out.unexplained = relative;
    out.nuisances = normal;
    out.nuisance_price = 0.5 * found.squaredNorm();
    if (count > 0) {
      const Eigen::VectorXd gains = kPriorGain * found.head(shown_.cols());
      out.largest_gain = (gains.array() - gains.mean()).abs().maxCoeff();
    }
    double excess = 0.0;
    for (Eigen::Index i = 0; i < pixels_; ++i) {
      excess += 1.0 - sample_.variance(i) / variance_(i);
      const double sigma = std::sqrt(variance_(i));
      out.residuals.push_back(std::clamp(residual_(i, 0) / sigma, -3.0, 3.0));
    }
    out.excess = relative < kModelError ? 0.0 : excess / static_cast<double>(pixels_);
  }

  /// Updates the variance of the residuals by what they show beyond the noise, relative to the
  /// modulation.
  double excess_over_modulation(double relative) {
    const auto freedom = static_cast<double>(residual_.cols());
    double excess = 0.0;
    double scale = 0.0;
    for (Eigen::Index i = 0; i < pixels_; ++i) {
      const double square = residual_.row(i).squaredNorm() / freedom;
      excess += std::min(square, kLimit * variance_(i)) - sample_.variance(i);
      scale += modulation_(i) * modulation_(i);
    }
    relative = std::sqrt(std::max(0.0, excess / scale));
    const double counted = std::max(relative, kModelError);
    variance_ = sample_.variance + counted * counted * modulation_.square();
    return relative;
  }

  [[nodiscard]] double log_density_of_rest(Eigen::Index i) const {
    const double square = residual_.row(i).squaredNorm();
    const auto freedom = static_cast<double>(residual_.cols());
    const double outlier =
        std::max(std::pow(kOutlierSize * sample_.scale_counts(i), 2), variance_(i));
    return log_of_mixture(std::log(1.0 - kOutliers) + log_normal(square, variance_(i), freedom),
                          std::log(kOutliers) + log_normal(square, outlier, freedom));
  }

  /// Density of what the hypothesis leaves open at each pixel, in the space of the counts: as broad
  /// as fringes are.
  [[nodiscard]] double log_density_of_values() const {
    return -static_cast<double>(design_.span.cols()) * (sample_.scale_counts * kBroad).log().sum();
  }

  /// Density of frames that show no fringes: normal in counts, or relative to the scale.
  [[nodiscard]] double log_density_of_free() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < hypothesis_.free.size(); ++k) {
      if (!hypothesis_.free[k]) continue;
      const Eigen::ArrayXd counts = sample_.counts.col(static_cast<Eigen::Index>(k));
      const Eigen::ArrayXd relative = counts / sample_.scale_counts;
      const double noise = sample_.variance.mean();
      const double in_counts =
          std::max((counts - counts.mean()).square().mean(), std::min(noise, 1.0 / 12.0));
      const double in_scale = std::max((relative - relative.mean()).square().mean(), 1e-8);
      const auto n = static_cast<double>(pixels_);
      const double absolute = log_normal(n * in_counts, in_counts, n);
      const double scaled =
          log_normal(n * in_scale, in_scale, n) - sample_.scale_counts.log().sum();
      sum += std::max({absolute, scaled, log_density_of_torn(k, relative.mean(), in_scale)});
    }
    return sum;
  }

  /// Density of a frame that shows its fringes at some pixels and something else at others.
  [[nodiscard]] double log_density_of_torn(std::size_t frame, double mean, double variance) const {
    if (values_.size() == 0) return -std::numeric_limits<double>::infinity();
    const double c = std::cos(hypothesis_.shifts_rad[frame]);
    const double s = std::sin(hypothesis_.shifts_rad[frame]);
    double sum = 0.0;
    for (Eigen::Index i = 0; i < pixels_; ++i) {
      const double counts = sample_.counts(i, static_cast<Eigen::Index>(frame));
      const double scale = sample_.scale_counts(i);
      const double predicted = values_(i, 0) + c * values_(i, 1) - s * values_(i, 2);
      const double error = 2.0 * sample_.variance(i) + std::pow(0.02 * modulation_(i), 2);
      sum += log_of_mixture(
          std::log(1.0 - kTorn) + log_normal(std::pow(counts - predicted, 2), error, 1.0),
          std::log(kTorn) +
              log_normal(std::pow(counts - mean * scale, 2), variance * scale * scale, 1.0));
    }
    return sum;
  }

  struct Wave {
    int order;
    Eigen::VectorXd real;
    Eigen::VectorXd imaginary;
  };

  const FrameSample& sample_;
  const FrameHypothesis& hypothesis_;
  FrameDesign design_;
  Eigen::Index pixels_;
  Eigen::MatrixXd shown_;
  Eigen::MatrixXd rest_;
  Eigen::MatrixXd values_;  ///< mean, B cos(phi), B sin(phi) of each pixel; empty if undetermined
  Eigen::ArrayXd modulation_;
  Eigen::MatrixXd residual_;
  Eigen::ArrayXd variance_;
  std::vector<Wave> waves_;
};

}  // namespace

double FrameScore::log_evidence(double share) const {
  double out = share * log_density - nuisance_price;
  if (nuisances.size() == 0) return out;
  Eigen::MatrixXd scaled = share * nuisances;
  scaled.diagonal().array() += 1.0;
  const Eigen::LLT<Eigen::MatrixXd> factor(scaled);
  for (Eigen::Index i = 0; i < scaled.rows(); ++i)
    out -= std::log(factor.matrixLLT()(i, i));
  return out;
}

FrameScore score_frames(const FrameSample& sample, const FrameHypothesis& hypothesis) {
  return FrameFit(sample, hypothesis).score();
}

double rough_score(const Eigen::MatrixXd& moments,
                   const Eigen::VectorXd& means,
                   double relative_noise,
                   const FrameHypothesis& hypothesis) {
  const FrameDesign design = design_of(hypothesis);
  const double noise = relative_noise * relative_noise;
  double out = -static_cast<double>(design.span.cols()) * std::log(kBroad);
  for (std::size_t k = 0; k < hypothesis.free.size(); ++k) {
    if (!hypothesis.free[k]) continue;
    const auto i = static_cast<Eigen::Index>(k);
    out -= 0.5 * std::log(std::max(moments(i, i) - means(i) * means(i), 0.0) + noise);
  }
  const Eigen::Index freedom = design.rest.cols();
  if (freedom == 0) return out;
  const Eigen::MatrixXd shown = moments(design.shown, design.shown);
  const double left = (design.rest.transpose() * shown * design.rest).trace();
  const auto count = static_cast<double>(freedom);
  return out - 0.5 * count * std::log(left / count + noise);
}

}  // namespace frangia
