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
#include "frangia/decode/explain/internal/log_densities.h"
#include "frangia/decode/explain/internal/lost_frames.h"
#include "frangia/decode/explain/internal/reference_light.h"

namespace frangia {
namespace {

constexpr int kHighestHarmonic = 12;
/// Prior standard deviations of a movement in the image, of a part or of a whole frame, and of the
/// phase by it.
constexpr double kPriorMovement_px = 1.0;
constexpr double kPriorMovement_rad = 0.5;
/// Share of what no model predicts: depth edges, highlights.
constexpr double kOutliers = 0.02;
constexpr double kLimit = 9.0;  ///< squared residuals count up to this multiple of their variance
constexpr int kRounds = 3;
/// No model of fringes is more exact, relative to the modulation.
constexpr double kModelError = 0.005;

/// The least squares solution of two unknowns of which none is negative.
Eigen::Vector2d solve_positive(const Eigen::Matrix2d& normal, const Eigen::Vector2d& right) {
  const double determinant = normal(0, 0) * normal(1, 1) - normal(0, 1) * normal(1, 0);
  const double both = normal(1, 1) * right(0) - normal(0, 1) * right(1);
  const double other = normal(0, 0) * right(1) - normal(1, 0) * right(0);
  constexpr double kSingular = 1e-9;  // equal modulations do not tell one from the other
  if (determinant > kSingular * normal(0, 0) * normal(1, 1) && both > 0.0 && other > 0.0)
    return {both / determinant, other / determinant};
  const Eigen::Vector2d first(std::max(0.0, right(0) / normal(0, 0)), 0.0);
  const Eigen::Vector2d second(0.0, std::max(0.0, right(1) / normal(1, 1)));
  const auto gain = [&](const Eigen::Vector2d& x) {
    return x.dot(right) - 0.5 * x.dot(normal * x);
  };
  return gain(first) > gain(second) ? first : second;
}

/// The fringes of all pixels as one hypothesis sees them.
class FrameFit {
 public:
  FrameFit(const FrameSample& sample,
           const FrameHypothesis& hypothesis,
           const Eigen::ArrayXd& counted,
           bool has_products)
      : sample_(sample),
        hypothesis_(hypothesis),
        has_products_(has_products),
        design_(design_of(hypothesis)),
        pixels_(sample.counts.rows()),
        counted_(counted.size() > 0 ? counted : Eigen::ArrayXd::Ones(pixels_)) {
    shown_.resize(pixels_, std::ssize(design_.shown));
    for (const double place : hypothesis.path)
      mean_path_ += place / static_cast<double>(hypothesis.path.size());
    for (std::size_t i = 0; i < design_.shown.size(); ++i)
      shown_.col(static_cast<Eigen::Index>(i)) = sample.counts.col(design_.shown[i]).matrix();
    rest_ = product(shown_, design_.rest);
    shown_scale_ = shown_.rowwise().maxCoeff().array().max(1.0);
    // The slopes of the fitted fringes have less noise than those of a frame.
    if (hypothesis.moves_part || hypothesis.moves_image || !hypothesis.displaced.empty()) {
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
    out.value_densities =
        -static_cast<double>(design_.span.cols()) * (sample_.scale_counts * kBroad).log();
    out.pixel_densities = out.value_densities;
    out.squared_rests = Eigen::ArrayXd::Zero(pixels_);
    if (rest_.cols() > 0) out.squared_rests = residual_.rowwise().squaredNorm().array();
    for (Eigen::Index i = 0; i < pixels_ && rest_.cols() > 0; ++i)
      out.pixel_densities(i) += log_density_of_rest(i);
    double common = 0.0;
    if (values_.size() > 0 && sample_.has_reference()) {
      const ReferenceGain gain = reference_gain(sample_, values_, counted_);
      out.reference_gains = gain.pixels;
      out.pixel_densities += gain.pixels;
      common = gain.common;
    }
    out.nuisance_price -= common;
    out.log_density = (counted_ * out.pixel_densities).sum();
    for (std::size_t k = 0; k < hypothesis_.free.size(); ++k)
      if (hypothesis_.free[k])
        out.log_density += log_density_of_lost(sample_, k, shown_scale_, values_);
    return out;
  }

 private:
  [[nodiscard]] Eigen::Index movement_count() const {
    if (hypothesis_.path.empty()) return 0;
    return hypothesis_.moves_part ? 8 : hypothesis_.moves_image ? 2 : 1;
  }
  /// The first of two columns: steady light as the albedo, and alike at all pixels.
  [[nodiscard]] Eigen::Index first_steady() const { return shown_.cols(); }
  [[nodiscard]] Eigen::Index first_wave() const { return shown_.cols() + 2; }
  [[nodiscard]] Eigen::Index nuisance_count() const {
    return first_wave() + 2 * std::ssize(waves_) + movement_count() +
           2 * std::ssize(hypothesis_.displaced) +
           (hypothesis_.has_free_steps ? shown_.cols() : 0) + (hypothesis_.lamp_on ? 4 : 0);
  }

  /// What the nuisances of one pixel change in its frames, per unit of their priors: gains, the
  /// share of steady light, harmonics, a movement of the part or of whole frames, and errors of the
  /// steps. Gains act on the harmonics and not on steady light: the effects are those about the
  /// values that were found before.
  void add_nuisances(Eigen::Index pixel,
                     const Eigen::VectorXd& about,
                     Eigen::MatrixXd& effects) const {
    const double phase = std::atan2(values_(pixel, 2), values_(pixel, 1));
    const double amplitude = std::hypot(values_(pixel, 1), values_(pixel, 2));
    const double b = modulation_(pixel);
    effects.setZero();
    const Eigen::Index after_waves = first_wave() + 2 * std::ssize(waves_);
    const Eigen::Vector2d steady =
        kPriorSteadyShare * Eigen::Vector2d(values_(pixel, 0), 0.5 * mean_scale_);
    const double flickering = values_(pixel, 0) - steady.dot(about.segment<2>(first_steady()));
    for (Eigen::Index i = 0; i < shown_.cols(); ++i) {
      const auto k = static_cast<std::size_t>(design_.shown[static_cast<std::size_t>(i)]);
      const double gain = hypothesis_.gains[k];
      const std::complex<double> turn = std::polar(1.0, phase + hypothesis_.shifts_rad[k]);
      const double by_gain = kPriorGain * gain;
      effects(i, i) = by_gain * (flickering + amplitude * turn.real());
      effects.row(i).segment<2>(first_steady()) = -by_gain * about(i) * steady.transpose();
      std::complex<double> power = turn;
      Eigen::Index column = first_wave();
      std::size_t wave = 0;
      for (int order = 2; order <= kHighestHarmonic && wave < waves_.size(); ++order) {
        power *= turn;
        if (waves_[wave] != order) continue;
        ++wave;
        const double size = gain * b * prior_harmonic(order);
        for (const double light : {size * power.real(), size * power.imag()}) {
          effects(i, i) += kPriorGain * light * about(column);
          effects(i, column++) = light;
        }
      }
      const double slope = -gain * amplitude * turn.imag();  // of counts over phase
      column = after_waves;
      if (!hypothesis_.path.empty()) {
        const double by_phase = hypothesis_.path[k] * kPriorMovement_rad * slope;
        // All that is seen moves about its middle place, where the slopes are.
        const double away = hypothesis_.path[k] - (hypothesis_.moves_image ? mean_path_ : 0.0);
        const double by_image = away * kPriorMovement_px;
        // Smooth over the image: what stands still around a part shows as curvature.
        const double x = sample_.x(pixel);
        const double y = sample_.y(pixel);
        Eigen::Index at = column;
        for (const double field : {1.0, x, y, x * x, y * y, x * y}) {
          if (hypothesis_.moves_image || (at > column && !hypothesis_.moves_part)) continue;
          effects(i, at++) = by_phase * field;
        }
        if (hypothesis_.moves_part || hypothesis_.moves_image) {
          effects(i, at++) = by_image * slope_x_(pixel, i);
          effects(i, at) = by_image * slope_y_(pixel, i);
        }
        column += movement_count();
      }
      for (const std::size_t displaced : hypothesis_.displaced) {
        if (displaced == k) {
          effects(i, column) = kPriorMovement_px * slope_x_(pixel, i);
          effects(i, column + 1) = kPriorMovement_px * slope_y_(pixel, i);
        }
        column += 2;
      }
      if (hypothesis_.has_free_steps) effects(i, column + i) = kPriorStep_rad * slope;
      if (is_lit_by_lamp(hypothesis_, k)) {
        // Alike at all pixels, or as their albedo, and it falls off smoothly. The albedo is that of
        // the fitted fringes: the brightest count holds noise of the residual.
        const double light = kPriorLamp * (values_(pixel, 0) + amplitude);
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
  void refine_values(const Eigen::VectorXd& change, const std::vector<Eigen::MatrixXd>& effects) {
    for (Eigen::Index i = 0; i < pixels_; ++i) {
      const Eigen::VectorXd without =
          shown_.row(i).transpose() - product(effects[static_cast<std::size_t>(i)], change);
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
    Eigen::VectorXd found = Eigen::VectorXd::Zero(count);
    Eigen::VectorXd about = found;  // stays 0 where the nuisances have no products
    Eigen::VectorXd share = found;  // of steady light, about which the model is linear
    const auto find_rows = [&] {
      if (count > 0) share.segment<2>(first_steady()) = about.segment<2>(first_steady());
      for (std::size_t i = 0; i < rows.size(); ++i) {
        add_nuisances(static_cast<Eigen::Index>(i), about, effects[i]);
        rows[i] = transposed_product(design_.rest, effects[i]);
      }
    };
    find_rows();
    residual_ = rest_;
    double relative = 0.05;  // of the modulation, to begin with
    variance_ = sample_.variance + relative * relative * modulation_.square();
    Eigen::MatrixXd normal;
    for (int round = 1; count > 0; ++round) {
      normal = Eigen::MatrixXd::Zero(count, count);
      Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
      for (Eigen::Index i = 0; i < pixels_; ++i) {
        const Eigen::MatrixXd& row = rows[static_cast<std::size_t>(i)];
        const double over =
            residual_.row(i).squaredNorm() / (static_cast<double>(freedom) * variance_(i));
        const double weight =
            counted_(i) * std::min(1.0, kLimit / std::max(over, 1e-9)) / variance_(i);
        normal.selfadjointView<Eigen::Lower>().rankUpdate(row.transpose(), weight);
        right += weight * transposed_product(row, rest_.row(i).transpose() + product(row, share));
      }
      normal = Eigen::MatrixXd(normal.selfadjointView<Eigen::Lower>());
      Eigen::MatrixXd with_prior = normal;
      with_prior.diagonal().array() += 1.0;
      found = solve_symmetric(with_prior, right);
      const Eigen::VectorXd change = found - share;
      for (Eigen::Index i = 0; i < pixels_; ++i) {
        residual_.row(i) =
            rest_.row(i) - product(rows[static_cast<std::size_t>(i)], change).transpose();
      }
      relative = excess_over_modulation();
      if (round == kRounds) break;
      const double largest = kPriorGain * found.head(shown_.cols()).cwiseAbs().maxCoeff();
      if (has_products_ && largest < kStructuralGain) about = found;
      refine_values(change, effects);
      find_rows();
    }
    if (count == 0) {
      for (int round = 0; round < kRounds; ++round)
        relative = excess_over_modulation();
    }
    out.unexplained = relative;
    out.nuisances = normal;
    out.nuisance_price = 0.5 * found.squaredNorm();
    if (count > 0) {
      const Eigen::VectorXd gains = kPriorGain * found.head(shown_.cols());
      out.largest_gain = (gains.array() - gains.mean()).abs().maxCoeff();
      if (hypothesis_.has_free_steps)
        out.step_errors_rad = kPriorStep_rad * found.tail(shown_.cols());
      else if (!hypothesis_.path.empty() && !hypothesis_.moves_part && !hypothesis_.moves_image)
        out.step_errors_rad = kPriorMovement_rad * found(count - 1) *
                              Eigen::VectorXd::Map(hypothesis_.path.data(), shown_.cols());
      if (hypothesis_.lamp_on) {  // the first two of its four columns, the last of all
        const double light = (values_.col(0).array() + modulation_).mean();
        out.lamp_share = kPriorLamp * (found(count - 4) * mean_scale_ / light + found(count - 3));
      }
      const Eigen::Index last = first_wave() + 2 * std::ssize(waves_) + movement_count();
      out.displacements_px.resize(std::ssize(hypothesis_.displaced), 2);
      for (Eigen::Index k = 0; k < out.displacements_px.rows(); ++k)
        out.displacements_px.row(k) =
            kPriorMovement_px * found.segment<2>(last + 2 * k).transpose();
      if (out.displacements_px.rows() > 0)
        out.largest_displacement_px = out.displacements_px.rowwise().norm().maxCoeff();
    }
    const double excess = (counted_ * (1.0 - sample_.variance / variance_)).sum();
    for (Eigen::Index i = 0; i < pixels_; ++i) {
      const double over = residual_(i, 0) / std::sqrt(variance_(i));
      out.residuals.push_back(counted_(i) * std::clamp(over, -3.0, 3.0));
    }
    out.excess = relative < kModelError ? 0.0 : excess / counted_.sum();
  }

  /// Updates the variance of the residuals by what they show beyond the noise: counts that the
  /// noise model lacks, such as those of coarse levels or compression, and a share of the
  /// modulation. Returns the RMS of both over the modulation.
  double excess_over_modulation() {
    const auto freedom = static_cast<double>(residual_.cols());
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (Eigen::Index i = 0; i < pixels_; ++i) {
      const double square = residual_.row(i).squaredNorm() / freedom;
      const double beyond = std::min(square, kLimit * variance_(i)) - sample_.variance(i);
      const Eigen::Vector2d row(1.0, modulation_(i) * modulation_(i));
      const double weight = counted_(i) / (variance_(i) * variance_(i));
      normal += weight * row * row.transpose();
      right += weight * beyond * row;
    }
    const Eigen::Vector2d parts = solve_positive(normal, right);
    const double scale = (counted_ * modulation_.square()).sum() / counted_.sum();
    const double counts_squared = parts(0);
    const double relative = std::max(std::sqrt(parts(1)), kModelError);
    variance_ = sample_.variance + counts_squared + relative * relative * modulation_.square();
    return std::sqrt(counts_squared / scale + parts(1));
  }

  [[nodiscard]] double log_density_of_rest(Eigen::Index i) const {
    const double square = residual_.row(i).squaredNorm();
    const auto freedom = static_cast<double>(residual_.cols());
    const double outlier =
        std::max(std::pow(kOutlierSize * sample_.scale_counts(i), 2), variance_(i));
    return log_of_mixture(std::log(1.0 - kOutliers) + log_normal(square, variance_(i), freedom),
                          std::log(kOutliers) + log_normal(square, outlier, freedom));
  }

  const FrameSample& sample_;
  double mean_scale_ = sample_.scale_counts.mean();
  const FrameHypothesis& hypothesis_;
  bool has_products_;  ///< of gains with harmonics and with the share of steady light
  FrameDesign design_;
  double mean_path_ = 0.0;
  Eigen::Index pixels_;
  Eigen::ArrayXd counted_;  ///< 1 for the pixels that are fitted and scored, else 0
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

/// Whether gains of the frames may be flicker of the projector, which acts on all that it shows and
/// not on the light of the room. Where a fault has unknowns of its own these would resemble it.
bool may_flicker(const FrameHypothesis& hypothesis, const FrameScore& score) {
  constexpr double kLeast = 0.003;
  constexpr std::ptrdiff_t kFewest = 5;  // fewer frames do not tell the share of steady light
  return hypothesis.path.empty() && hypothesis.displaced.empty() && !hypothesis.has_free_steps &&
         !hypothesis.lamp_on && hypothesis.cause != FrameCause::Exposure &&
         std::count(hypothesis.free.begin(), hypothesis.free.end(), false) >= kFewest &&
         score.largest_gain > kLeast && score.largest_gain < kStructuralGain;
}

}  // namespace

double FrameScore::log_evidence(double share) const {
  const double out = share * log_density - nuisance_price;
  if (nuisances.size() == 0) return out;
  Eigen::MatrixXd scaled = share * nuisances;
  scaled.diagonal().array() += 1.0;
  return out - 0.5 * Cholesky(scaled).log_determinant();
}

FrameScore score_frames(const FrameSample& sample,
                        const FrameHypothesis& hypothesis,
                        const Eigen::ArrayXd& counted) {
  FrameScore out = FrameFit(sample, hypothesis, counted, false).score();
  if (!may_flicker(hypothesis, out)) return out;
  FrameScore flickering = FrameFit(sample, hypothesis, counted, true).score();
  return flickering.log_evidence(1.0) > out.log_evidence(1.0) ? flickering : out;
}

}  // namespace frangia
