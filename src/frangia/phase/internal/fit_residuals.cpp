#include "frangia/phase/internal/fit_residuals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "frangia/core/angles.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/core/missing.h"
#include "frangia/phase/algorithm/phase_algorithm.h"

namespace frangia {
namespace {

/// Least share of a harmonic's variance in the residuals. Below it the frames do not determine it.
constexpr double kMinShare = 0.02;

/// Largest share that errors of the shifts alone may explain. Gains that leave no residual of
/// multiple 0, which four frames may have, look like errors of the shifts.
constexpr double kMaxExplainedByShifts = 0.8;

/// Prior standard deviations of a harmonic relative to the fundamental, of a gain, of the share of
/// steady light, and of the error of a shift in rad. They decide only what the residuals do not
/// determine, such as a gain common to all frames, or everything but the noise where the image
/// shows part of a fringe.
constexpr double kPriorHarmonic = 0.3;
constexpr double kPriorGain = 0.02;
constexpr double kPriorSteadyShare = 0.3;
constexpr double kPriorShift_rad = 0.02;

/// Least share of the explained residual that gains alone must explain to be flicker.
constexpr double kMinExplained = 0.7;

/// Rounds of the fit of gains, which act on the harmonics and not on the steady light.
constexpr int kGainRounds = 4;

/// Projects frames on their residuals from the least-squares fringe.
Eigen::MatrixXd residual_projection(const std::vector<double>& shifts_rad) {
  const PhaseAlgorithm fit = least_squares(shifts_rad);
  const Eigen::Index frames = std::ssize(shifts_rad);
  Eigen::MatrixXd projection = Eigen::MatrixXd::Identity(frames, frames);
  for (Eigen::Index k = 0; k < frames; ++k) {
    const double shift = shifts_rad[static_cast<std::size_t>(k)];
    for (Eigen::Index l = 0; l < frames; ++l) {
      const auto i = static_cast<std::size_t>(l);
      projection(k, l) -=
          fit.mean[i] + std::cos(shift) * fit.cosine[i] - std::sin(shift) * fit.sine[i];
    }
  }
  return projection;
}

/// The unknowns of a fit: columns of its design, in this order.
struct Unknowns {
  std::vector<int> harmonics;  ///< orders, two columns each
  bool gains = false;          ///< one column per frame, and one for the share of steady light
  bool shifts = false;         ///< one column per frame
  bool products = false;       ///< of the gains with the harmonics and with the steady light
};

struct LinearFit {
  Eigen::VectorXd value;
  Eigen::MatrixXd covariance;
  double chi2 = 0.0;
};

class ResidualFitter {
 public:
  ResidualFitter(const FringeBins& bins, const std::vector<double>& shifts_rad)
      : bins_(bins),
        shifts_(Eigen::Map<const Eigen::ArrayXd>(shifts_rad.data(), std::ssize(shifts_rad))),
        projection_(residual_projection(shifts_rad)) {}

  [[nodiscard]] bool is_observable(int order) const {
    double share = 0.0;
    for (int bin = 0; bin < kPhaseBins; ++bin) {
      const Eigen::VectorXd wave = (order * (bin_phase(bin) + shifts_)).cos().matrix();
      share += (projection_ * wave).squaredNorm();
    }
    return share > kMinShare * 0.5 * kPhaseBins * static_cast<double>(shifts_.size());
  }

  /// The gains, of the light of the projector alone, multiply its harmonics: they are fitted in
  /// rounds, each about the values of the one before.
  [[nodiscard]] LinearFit fit(const Unknowns& unknowns) const {
    const Eigen::Index frames = shifts_.size();
    const Eigen::Index harmonics = 2 * std::ssize(unknowns.harmonics);
    const Eigen::Index steady = harmonics + frames;
    Eigen::VectorXd prior = Eigen::VectorXd::Constant(
        harmonics + (unknowns.gains ? frames + 1 : 0) + (unknowns.shifts ? frames : 0),
        kPriorHarmonic);
    if (unknowns.gains) {
      prior.segment(harmonics, frames).setConstant(kPriorGain);
      prior(steady) = kPriorSteadyShare;
    }
    if (unknowns.shifts) prior.tail(frames).setConstant(kPriorShift_rad);
    LinearFit out = fit_about(Eigen::VectorXd::Zero(prior.size()), unknowns, prior);
    for (int round = 1; round < kGainRounds && unknowns.products; ++round)
      out = fit_about(out.value, unknowns, prior);
    return out;
  }

 private:
  [[nodiscard]] LinearFit fit_about(const Eigen::VectorXd& about,
                                    const Unknowns& unknowns,
                                    const Eigen::VectorXd& prior) const {
    const Eigen::Index count = prior.size();
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
    LinearFit out;
    for (int bin = 0; bin < kPhaseBins; ++bin) {
      if (bins_.weight(bin) == 0.0) continue;
      const Linearized model = columns(unknowns, bin, about);
      const Eigen::MatrixXd design = projection_ * model.design;
      const Eigen::VectorXd residual =
          bins_.residual.row(bin).transpose().matrix() - projection_ * model.offset;
      normal += bins_.weight(bin) * design.transpose() * design;
      right += bins_.weight(bin) * design.transpose() * residual;
      out.chi2 += bins_.weight(bin) * residual.squaredNorm();
    }
    if (count == 0) return out;
    Eigen::MatrixXd with_prior = normal;
    with_prior.diagonal() += prior.cwiseAbs2().cwiseInverse();
    out.covariance = solve_symmetric_columns(with_prior, Eigen::MatrixXd::Identity(count, count));
    out.value = out.covariance * right;
    out.chi2 += out.value.dot(normal * out.value) - 2.0 * right.dot(out.value);
    return out;
  }

  /// What the unknowns x change in the frames: design x + offset, about some values of them.
  struct Linearized {
    Eigen::MatrixXd design;
    Eigen::VectorXd offset;
  };

  [[nodiscard]] Linearized columns(const Unknowns& unknowns,
                                   int bin,
                                   const Eigen::VectorXd& about) const {
    const Eigen::Index frames = shifts_.size();
    const Eigen::ArrayXd phase = bin_phase(bin) + shifts_;
    Linearized out{Eigen::MatrixXd::Zero(frames, about.size()), Eigen::VectorXd::Zero(frames)};
    Eigen::Index column = 0;
    Eigen::ArrayXd wave = phase.cos();
    for (const int order : unknowns.harmonics) {
      for (const Eigen::ArrayXd& one :
           {(order * phase).cos().eval(), (-(order * phase).sin()).eval()}) {
        wave += about(column) * one;
        out.design.col(column++) = one.matrix();
      }
    }
    if (unknowns.gains) {
      // (1 + g) ((1 - s) A + B w) + s A: the light of the projector, its waves w, and steady light.
      const Eigen::VectorXd gains = about.segment(column, frames);
      const double share = about(column + frames);
      const double mean = bins_.mean_over_modulation(bin);
      out.design.middleCols(column, frames).diagonal() = ((1.0 - share) * mean + wave).matrix();
      column += frames;
      out.design.col(column++) = -mean * gains;
      out.offset = share * mean * gains;
    }
    if (unknowns.shifts) out.design.middleCols(column, frames).diagonal() = -phase.sin().matrix();
    return out;
  }

  const FringeBins& bins_;
  Eigen::ArrayXd shifts_;
  Eigen::MatrixXd projection_;
};

}  // namespace

ResidualFit fit_residuals(const FringeBins& bins,
                          const std::vector<double>& shifts_rad,
                          GainFit gain_fit) {
  const bool with_gains = gain_fit != GainFit::None;
  const ResidualFitter fitter(bins, shifts_rad);
  const auto frames = static_cast<int>(shifts_rad.size());
  ResidualFit out;
  Unknowns unknowns{.products = gain_fit == GainFit::Flicker};
  for (int order = 2; order <= std::clamp(frames - 1, 2, kMaxHarmonic); ++order) {
    out.observable.push_back(fitter.is_observable(order));
    if (out.observable.back()) unknowns.harmonics.push_back(order);
  }
  out.harmonics.assign(out.observable.size(), 0.0);
  out.sigma.assign(out.observable.size(), kMissing);
  if (frames < 4) return out;

  // Gains and errors of the shifts leave residuals of the multiples 0 and 1 of the phase.
  Unknowns all = unknowns;
  all.gains = with_gains;
  all.shifts = true;
  const LinearFit full = fitter.fit(all);
  const double freedom = std::max(1.0, static_cast<double>((frames - 3) * kPhaseBins));
  const double excess = std::max(1.0, full.chi2 / freedom);
  for (std::size_t i = 0; i < unknowns.harmonics.size(); ++i) {
    const auto order = static_cast<std::size_t>(unknowns.harmonics[i]);
    const auto column = static_cast<Eigen::Index>(2 * i);
    out.harmonics[order - 2] = {full.value(column), full.value(column + 1)};
    out.sigma[order - 2] = std::sqrt(excess * std::max(full.covariance(column, column),
                                                       full.covariance(column + 1, column + 1)));
  }
  if (!with_gains) return out;
  Unknowns gains = unknowns;
  gains.gains = true;
  Unknowns shifts = unknowns;
  shifts.shifts = true;
  const LinearFit with = fitter.fit(gains);
  const double none = fitter.fit(unknowns).chi2;
  const Eigen::Index first = 2 * std::ssize(unknowns.harmonics);
  const Eigen::VectorXd found = with.value.segment(first, frames);
  const double mean = found.mean();
  for (const double gain : found)
    out.gains.push_back(gain - mean);
  // The gain common to all frames is not determined, and its variance does not count.
  out.steady_share = with.value(first + frames);
  const Eigen::MatrixXd covariance = with.covariance.block(first, first, frames, frames);
  const double variance = covariance.trace() - covariance.mean() * static_cast<double>(frames);
  out.gain_sigma = std::sqrt(excess * std::max(variance, 0.0) / static_cast<double>(frames));
  out.gain_chi2 = (none - with.chi2) / excess;
  const double explained = none - full.chi2;
  const double by_shifts = none - fitter.fit(shifts).chi2;
  out.gains_explain =
      none - with.chi2 > kMinExplained * explained && by_shifts < kMaxExplainedByShifts * explained;
  return out;
}

double explained_residual(const FringeBins& bins, const std::vector<double>& shifts_rad) {
  const ResidualFitter fitter(bins, shifts_rad);
  Unknowns unknowns;
  const auto frames = static_cast<int>(shifts_rad.size());
  for (int order = 2; order <= std::clamp(frames - 1, 2, kMaxHarmonic); ++order) {
    if (fitter.is_observable(order)) unknowns.harmonics.push_back(order);
  }
  return fitter.fit({}).chi2 - fitter.fit(unknowns).chi2;
}

}  // namespace frangia
