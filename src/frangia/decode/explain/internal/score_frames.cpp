#include "frangia/decode/explain/internal/score_frames.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>

#include "frangia/core/angles.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/decode/explain/internal/frame_design.h"
#include "frangia/decode/explain/internal/frame_priors.h"

namespace frangia {
namespace {

constexpr int kHighestHarmonic = 12;
/// Prior standard deviations of a movement of the part in the image and of the phase by it.
constexpr double kPriorMovement_px = 1.0;
constexpr double kPriorMovement_rad = 0.5;
/// Share and size, over the scale of a pixel, of what no model predicts: depth edges, highlights.
constexpr double kOutliers = 0.02;
constexpr double kOutlierSize = 0.4;
constexpr double kLimit = 9.0;  ///< squared residuals count up to this multiple of their variance
constexpr int kRounds = 3;
/// No model of fringes is more exact, relative to the modulation.
constexpr double kModelError = 0.005;
/// Probability that a pixel of a lost frame shows what the other frames predict: a torn frame.
constexpr double kTorn = 0.5;
constexpr double kLeastTorn = 0.15;  ///< share of its pixels that show something else
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
    rest_ = product(shown_, design_.rest);
    shown_scale_ = shown_.rowwise().maxCoeff().array().max(1.0);
    // The slopes of the fitted fringes have less noise than those of a frame.
    if (hypothesis.moves_part) {
      const auto of_fringes = [&](const Eigen::ArrayXXd& slopes) -> Eigen::MatrixXd {
        return product(slopes(Eigen::all, design_.shown).matrix(),
                       product_transposed(design_.span, design_.span));
      };
      slope_x_ = of_fringes(sample.slope_x);
      slope_y_ = of_fringes(sample.slope_y);
    }
    if (design_.inverse.size() > 0) {
      values_ = product_transposed(shown_, design_.inverse);
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
  [[nodiscard]] Eigen::Index movement_count() const {
    return hypothesis_.path.empty() ? 0 : hypothesis_.moves_part ? 8 : 1;
  }
  [[nodiscard]] Eigen::Index nuisance_count() const {
    return shown_.cols() + 2 * std::ssize(waves_) + movement_count() +
           (hypothesis_.has_free_steps ? shown_.cols() : 0) + (hypothesis_.lamp_on ? 4 : 0);
  }

  /// What the nuisances of one pixel change in its frames, per unit of their priors: gains,
  /// harmonics, a movement of the part, and errors of the steps.
  void add_nuisances(Eigen::Index pixel, Eigen::MatrixXd& effects) const {
    const double phase = std::atan2(values_(pixel, 2), values_(pixel, 1));
    const double amplitude = std::hypot(values_(pixel, 1), values_(pixel, 2));
    const double b = modulation_(pixel);
    effects.setZero();
    const Eigen::Index after_waves = shown_.cols() + 2 * std::ssize(waves_);
    for (Eigen::Index i = 0; i < shown_.cols(); ++i) {
      const auto k = static_cast<std::size_t>(design_.shown[static_cast<std::size_t>(i)]);
      const double gain = hypothesis_.gains[k];
      const std::complex<double> turn = std::polar(1.0, phase + hypothesis_.shifts_rad[k]);
      effects(i, i) = kPriorGain * gain * (values_(pixel, 0) + amplitude * turn.real());
      std::complex<double> power = turn;
      Eigen::Index column = shown_.cols();
      std::size_t wave = 0;
      for (int order = 2; order <= kHighestHarmonic && wave < waves_.size(); ++order) {
        power *= turn;
        if (waves_[wave] != order) continue;
        ++wave;
        const double size = gain * b * prior_harmonic(order);
        effects(i, column++) = size * power.real();
        effects(i, column++) = size * power.imag();
      }
      const double slope = -gain * amplitude * turn.imag();  // of counts over phase
      column = after_waves;
      if (!hypothesis_.path.empty()) {
        const double by_phase = hypothesis_.path[k] * kPriorMovement_rad * slope;
        const double by_image = hypothesis_.path[k] * kPriorMovement_px;
        // Smooth over the image: what stands still around a part shows as curvature.
        const double x = sample_.x(pixel);
        const double y = sample_.y(pixel);
        Eigen::Index at = column;
        for (const double field : {1.0, x, y, x * x, y * y, x * y})
          if (at == column || hypothesis_.moves_part) effects(i, at++) = by_phase * field;
        if (hypothesis_.moves_part) {
          effects(i, at++) = by_image * slope_x_(pixel, i);
          effects(i, at) = by_image * slope_y_(pixel, i);
        }
        column += movement_count();
      }
      if (hypothesis_.has_free_steps) effects(i, column + i) = kPriorStep_rad * slope;
      if (is_lit_by_lamp(hypothesis_, k)) {
        // Alike at all pixels, or as their albedo, and it falls off smoothly. The albedo is that of
        // the fitted fringes: the brightest count holds noise of the residual.
        const double light = kPriorLamp * (values_(pixel, 0) + b);
        effects(i, column) = kPriorLamp * mean_scale_;
        effects(i, column + 1) = light;
        effects(i, column + 2) = light * sample_.x(pixel);
        effects(i, column + 3) = light * sample_.y(pixel);
      }
    }
  }

  /// Fits mean, modulation and phase again to the frames without their nuisances, which shift the
  /// phase of uneven steps. The modulation that the variance refers to stays: nuisances that cancel
  /// each other would lower it, and so raise the density of the same residuals.
  void refine_values(const Eigen::VectorXd& found, const std::vector<Eigen::MatrixXd>& effects) {
    for (Eigen::Index i = 0; i < pixels_; ++i) {
      const Eigen::VectorXd without =
          shown_.row(i).transpose() - product(effects[static_cast<std::size_t>(i)], found);
      values_.row(i) = product(design_.inverse, without).transpose();
    }
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
      const double visible = transposed_product(design_.rest, cosine).squaredNorm() +
                             transposed_product(design_.rest, sine).squaredNorm();
      if (visible > kVisible) waves_.push_back(order);
    }
  }

  void fit_rest(FrameScore& out) {
    const Eigen::Index freedom = rest_.cols();
    const bool determined = design_.inverse.size() > 0;
    if (determined) find_waves();
    const Eigen::Index count = determined ? nuisance_count() : 0;
    const auto used = static_cast<std::size_t>(count > 0 ? pixels_ : 0);
    std::vector<Eigen::MatrixXd> effects(used, Eigen::MatrixXd(shown_.cols(), count));
    std::vector<Eigen::MatrixXd> rows(used, Eigen::MatrixXd(freedom, count));
    const auto find_rows = [&] {
      for (std::size_t i = 0; i < rows.size(); ++i) {
        add_nuisances(static_cast<Eigen::Index>(i), effects[i]);
        rows[i] = transposed_product(design_.rest, effects[i]);
      }
    };
    find_rows();
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
        right += weight * transposed_product(row, rest_.row(i).transpose());
      }
      normal = Eigen::MatrixXd(normal.selfadjointView<Eigen::Lower>());
      Eigen::MatrixXd with_prior = normal;
      with_prior.diagonal().array() += 1.0;
      found = solve_symmetric(with_prior, right);
      for (Eigen::Index i = 0; i < pixels_; ++i) {
        residual_.row(i) =
            rest_.row(i) - product(rows[static_cast<std::size_t>(i)], found).transpose();
      }
      relative = excess_over_modulation(relative);
      if (round + 1 == kRounds) break;
      refine_values(found, effects);
      find_rows();
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
      if (hypothesis_.has_free_steps)
        out.step_errors_rad = kPriorStep_rad * found.tail(shown_.cols());
      else if (!hypothesis_.path.empty() && !hypothesis_.moves_part)
        out.step_errors_rad = kPriorMovement_rad * found(count - 1) *
                              Eigen::VectorXd::Map(hypothesis_.path.data(), shown_.cols());
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

  /// Normal density of one value per pixel that is alike in counts, or relative to the scale, where
  /// its variance is `in_scale`.
  [[nodiscard]] double log_density_alike(const Eigen::ArrayXd& counts, double in_scale) const {
    const auto n = static_cast<double>(pixels_);
    const double noise = sample_.variance.mean();
    const double in_counts =
        std::max((counts - counts.mean()).square().mean(), std::min(noise, 1.0 / 12.0));
    return std::max(log_normal(n * in_counts, in_counts, n),
                    log_normal(n * in_scale, in_scale, n) - shown_scale_.log().sum());
  }

  /// Density of frames that show no fringes: normal in counts, or relative to those that do.
  [[nodiscard]] double log_density_of_free() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < hypothesis_.free.size(); ++k) {
      if (!hypothesis_.free[k]) continue;
      const Eigen::ArrayXd counts = sample_.counts.col(static_cast<Eigen::Index>(k));
      const Eigen::ArrayXd relative = counts / shown_scale_;
      const double in_scale = std::max((relative - relative.mean()).square().mean(), 1e-8);
      sum += std::max({log_density_alike(counts, in_scale),
                       log_density_of_mean(counts),
                       log_density_of_torn(k, relative.mean(), in_scale)});
    }
    return sum;
  }

  /// Density of a frame that shows the mean of the others: fringes that are out of focus, or move
  /// while it is exposed.
  [[nodiscard]] double log_density_of_mean(const Eigen::ArrayXd& counts) const {
    if (values_.size() == 0) return -std::numeric_limits<double>::infinity();
    const Eigen::ArrayXd mean = values_.col(0).array().max(1.0);
    const Eigen::ArrayXd relative = counts / mean;
    const auto n = static_cast<double>(pixels_);
    const double variance = std::max((relative - relative.mean()).square().mean(), 1e-6);
    return log_normal(n * variance, variance, n) - mean.log().sum();
  }

  /// Density of a frame that shows its fringes at some pixels and something else at others.
  [[nodiscard]] double log_density_of_torn(std::size_t frame, double mean, double variance) const {
    if (values_.size() == 0) return -std::numeric_limits<double>::infinity();
    const double c = std::cos(hypothesis_.shifts_rad[frame]);
    const double s = std::sin(hypothesis_.shifts_rad[frame]);
    double sum = 0.0;
    double others = 0.0;  // pixels that show something else
    for (Eigen::Index i = 0; i < pixels_; ++i) {
      const double counts = sample_.counts(i, static_cast<Eigen::Index>(frame));
      const double scale = shown_scale_(i);
      const double predicted = values_(i, 0) + c * values_(i, 1) - s * values_(i, 2);
      const double error = 2.0 * sample_.variance(i) + std::pow(0.02 * modulation_(i), 2);
      const double shown =
          std::log(1.0 - kTorn) + log_normal(std::pow(counts - predicted, 2), error, 1.0);
      const double other =
          std::log(kTorn) +
          log_normal(std::pow(counts - mean * scale, 2), variance * scale * scale, 1.0);
      sum += log_of_mixture(shown, other);
      if (other > shown) others += 1.0;
    }
    // A frame that is a little off nearly everywhere is not torn.
    const bool is_torn = others > kLeastTorn * static_cast<double>(pixels_);
    return is_torn ? sum : -std::numeric_limits<double>::infinity();
  }

  const FrameSample& sample_;
  double mean_scale_ = sample_.scale_counts.mean();
  const FrameHypothesis& hypothesis_;
  FrameDesign design_;
  Eigen::Index pixels_;
  Eigen::MatrixXd shown_;
  Eigen::ArrayXd shown_scale_;  ///< largest count of each pixel in these frames
  Eigen::MatrixXd rest_;
  Eigen::MatrixXd slope_x_;  ///< of the shown frames, where the part moved
  Eigen::MatrixXd slope_y_;
  Eigen::MatrixXd values_;  ///< mean, B cos(phi), B sin(phi) of each pixel; empty if undetermined
  Eigen::ArrayXd modulation_;
  Eigen::MatrixXd residual_;
  Eigen::ArrayXd variance_;
  std::vector<int> waves_;  ///< orders of the harmonics that leave a residual
};

}  // namespace

double FrameScore::log_evidence(double share) const {
  const double out = share * log_density - nuisance_price;
  if (nuisances.size() == 0) return out;
  Eigen::MatrixXd scaled = share * nuisances;
  scaled.diagonal().array() += 1.0;
  return out - 0.5 * Cholesky(scaled).log_determinant();
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
  const double left = congruence(design.rest, shown).trace();
  const auto count = static_cast<double>(freedom);
  return out - 0.5 * count * std::log(left / count + noise);
}

}  // namespace frangia
