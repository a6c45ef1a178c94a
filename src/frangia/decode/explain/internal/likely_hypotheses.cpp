#include "frangia/decode/explain/internal/likely_hypotheses.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "frangia/core/linear_algebra.h"
#include "frangia/core/statistics.h"
#include "frangia/decode/explain/internal/frame_design.h"
#include "frangia/decode/explain/internal/frame_priors.h"
#include "frangia/decode/explain/internal/score_frames.h"
#include "frangia/diagnose/score.h"

namespace frangia {
namespace {

constexpr std::size_t kThreeSteps = 3;
constexpr std::size_t kFourSteps = 4;  ///< whose single residual any movement resembles
constexpr std::size_t kScoredSingles = 8;
constexpr std::size_t kPairedSingles = 5;

/// Moments of the frames, relative to the scale of each pixel.
struct FrameMoments {
  Eigen::MatrixXd moments;
  Eigen::VectorXd means;
  double relative_noise = 0.0;
};

FrameMoments moments_of(const FrameSample& sample) {
  const Eigen::MatrixXd relative =
      (sample.counts.colwise() / sample.scale_counts).min(1.5).matrix();
  const auto count = static_cast<double>(relative.rows());
  return {relative.transpose() * relative / count,
          relative.colwise().mean().transpose(),
          std::sqrt((sample.variance / sample.scale_counts.square()).mean())};
}

/// The gain of a frame that leaves the least residual; false where it is within the nuisances.
bool fit_gain(const FrameMoments& moments, std::size_t frame, FrameHypothesis& hypothesis) {
  double least = std::numeric_limits<double>::infinity();
  double best = 1.0;
  const auto left = [&](double gain) {
    hypothesis.gains[frame] = gain;
    const FrameDesign design = design_of(hypothesis);
    return (design.rest.transpose() * moments.moments(design.shown, design.shown) * design.rest)
        .trace();
  };
  const auto look_at = [&](double gain) {
    const double rest = left(gain);
    if (rest >= least) return;
    least = rest;
    best = gain;
  };
  for (double gain = 0.04; gain < 3.0; gain *= 1.15)
    look_at(gain);
  for (double step = 0.07; step > 5e-4; step *= 0.5) {
    const double from = best;
    look_at(from * (1.0 + step));
    look_at(from / (1.0 + step));
  }
  hypothesis.gains[frame] = best;
  return std::abs(std::log(best)) > kStructuralGain;
}

/// The gains of all frames that leave the least residual; false where fewer than two of them differ
/// by more than flicker, or one by more than exposures do.
///
/// Without its gains h_k = 1 / g_k a frame is one of fringes, so that the residual of all pixels is
/// the quadratic form of h with the moments times, element by element, the projection on what no
/// fringes show.
bool fit_exposure(const FrameMoments& moments, FrameHypothesis& hypothesis) {
  constexpr double kMostGain = 5.0;
  const FrameDesign design = design_of(hypothesis);
  const Eigen::MatrixXd residual =
      moments.moments.cwiseProduct(product_transposed(design.rest, design.rest));
  const Eigen::VectorXd inverse = symmetric_eigen(residual).vectors.col(0);
  const double sign = inverse.sum() < 0.0 ? -1.0 : 1.0;
  std::vector<double> gains;
  for (const double one : inverse) {
    if (sign * one <= 0.0) return false;
    gains.push_back(sign / one);
  }
  const double middle = median(gains);
  std::size_t structural = 0;
  for (double& gain : gains) {
    gain /= middle;
    if (std::abs(std::log(gain)) > std::log(kMostGain)) return false;
    if (std::abs(std::log(gain)) > kStructuralGain) ++structural;
  }
  hypothesis.gains = std::move(gains);
  return structural > 1;
}

/// With three frames, those that remain must show the whole fringe; a part in the dark part of one
/// coarse fringe looks like a black frame otherwise.
bool show_whole_fringe(const FrameSample& sample, const FrameHypothesis& hypothesis) {
  if (hypothesis.shifts_rad.size() > kThreeSteps) return true;
  constexpr double kDark = 0.3;
  constexpr double kLeast = 0.1;
  for (std::size_t k = 0; k < hypothesis.free.size(); ++k) {
    if (hypothesis.free[k]) continue;
    const auto dark = sample.counts.col(static_cast<Eigen::Index>(k)) < kDark * sample.scale_counts;
    if (dark.cast<double>().mean() < kLeast) return false;
  }
  // A lost frame is not the brightest one at most pixels. A white frame does not count, because
  // `scale_counts` leaves it out.
  constexpr double kBright = 0.9;
  constexpr double kMost = 0.5;
  Eigen::ArrayXd brightest = Eigen::ArrayXd::Zero(sample.counts.rows());
  for (std::size_t k = 0; k < hypothesis.free.size(); ++k) {
    if (!hypothesis.free[k])
      brightest = brightest.max(sample.counts.col(static_cast<Eigen::Index>(k)));
  }
  return (brightest > kBright * sample.scale_counts).cast<double>().mean() > kMost;
}

/// Whether the sample sees the second harmonic of the fringes with both signs. A part that sees one
/// side of a coarse fringe alone does not tell it from uneven steps, nor, with six frames or fewer,
/// from light in some of them, where a camera's response makes the harmonic differ with the
/// brightness.
bool sees_both_sides(const FrameSample& sample, const FrameHypothesis& declared) {
  constexpr double kOneSided = 0.3;
  Eigen::ArrayXcd phasor = Eigen::ArrayXcd::Zero(sample.counts.rows());
  for (std::size_t k = 0; k < declared.shifts_rad.size(); ++k)
    phasor += sample.counts.col(static_cast<Eigen::Index>(k)).cast<std::complex<double>>() *
              std::polar(1.0, -declared.shifts_rad[k]);
  const Eigen::ArrayXcd doubled = phasor.square() / phasor.abs2().max(1e-12);
  return std::abs(doubled.mean()) < kOneSided;
}

/// The frames before which a path makes nearly all of its way: one, or none for a part that moves
/// all the time.
std::vector<std::size_t> jump_of(const std::vector<double>& path) {
  constexpr double kRest = 0.2;  // of the largest step: the noise of the others
  const auto step = [&](std::size_t k) { return std::abs(path[k] - path[k - 1]); };
  std::size_t largest = 1;
  for (std::size_t k = 2; k < path.size(); ++k)
    if (step(k) > step(largest)) largest = k;
  for (std::size_t k = 1; k < path.size(); ++k)
    if (k != largest && step(k) > kRest * step(largest)) return {};
  return {largest};
}

/// The displacements of the frames along the largest one.
std::vector<double> along_largest(const FrameScore& fit) {
  const Eigen::MatrixX2d away =
      fit.displacements_px.rowwise() - fit.displacements_px.colwise().mean();
  Eigen::Index largest = 0;
  away.rowwise().norm().maxCoeff(&largest);
  const Eigen::VectorXd along = away * away.row(largest).transpose();
  return {along.begin(), along.end()};
}

/// A part that moved as the free steps of its frames say.
FrameHypothesis moved_freely(const FrameHypothesis& steps, const Eigen::VectorXd& errors_rad) {
  FrameHypothesis out = steps;
  out.cause = FrameCause::Moved;
  out.has_free_steps = false;
  out.moves_part = true;
  out.parameters = static_cast<int>(errors_rad.size());
  const Eigen::VectorXd moved = errors_rad.array() - errors_rad.mean();
  const double largest = std::max(1e-6, moved.cwiseAbs().maxCoeff());
  for (Eigen::Index k = 0; k < moved.size(); ++k)
    out.path.push_back(moved(k) / largest);
  out.frames = jump_of(out.path);
  return out;
}

/// The likeliest hypothesis of each cause, by some of the pixels: which frame it begins with; and
/// those that predict the same.
std::vector<FrameHypothesis> likeliest_of_each(const FrameSample& sample,
                                               std::vector<FrameHypothesis> all) {
  constexpr int kEvery = 4;
  const FrameSample some = every_nth_block(sample, kEvery);
  std::map<FrameCause, std::pair<double, FrameHypothesis>> best;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const FrameScore fit = score_frames(some, all[i]);
    if (fit.displacements_px.rows() > 1) all[i].frames = jump_of(along_largest(fit));
    const FrameHypothesis one = all[i];
    const double price = price_of_parameter(static_cast<double>(some.counts.rows()));
    const double score = fit.log_evidence(1.0) - one.parameters * price;
    if (one.has_free_steps && fit.step_errors_rad.size() > 0)
      all.push_back(moved_freely(one, fit.step_errors_rad));
    const auto found = best.find(one.cause);
    if (found == best.end() || score > found->second.first)
      best.insert_or_assign(one.cause, std::pair(score, one));
  }
  std::vector<FrameHypothesis> out;
  for (FrameHypothesis& one : all) {
    const FrameHypothesis& likeliest = best.at(one.cause).second;
    if (predict_alike(one, likeliest)) out.push_back(std::move(one));
  }
  return out;
}

/// The hypotheses with one fault: by rough score, best first, then the likeliest lamp, movement and
/// uneven steps, displaced frames and exposures, which form no pairs.
std::vector<FrameHypothesis> likely_singles(const FrameSample& sample,
                                            const FrameMoments& moments,
                                            const Pattern& pattern) {
  std::vector<std::pair<double, FrameHypothesis>> ranked;
  std::vector<FrameHypothesis> others;  // `rough_score` does not model them
  std::vector<FrameHypothesis> last;    // which form no pairs
  std::vector<FrameHypothesis> all = frame_hypotheses(pattern);
  const FrameHypothesis declared = all.front();
  constexpr std::size_t kFewSteps = 6;  // their residuals are those of the harmonics 2 and 3
  const bool both_sides = sees_both_sides(sample, declared);
  for (FrameHypothesis& one : all) {
    if (one.cause == FrameCause::Gain && !fit_gain(moments, one.frames.front(), one)) continue;
    if (one.in_part) continue;  // `find_covered_part`
    if (one.cause == FrameCause::Exposure && !fit_exposure(moments, one)) continue;
    if (one.cause == FrameCause::Displaced || one.cause == FrameCause::Exposure) {
      last.push_back(std::move(one));
      continue;
    }
    if (one.cause == FrameCause::Moved || !one.path.empty() || one.has_free_steps || one.lamp_on) {
      const std::size_t steps = declared.shifts_rad.size();
      const bool like_harmonic =
          one.lamp_on ? steps <= kFewSteps : one.cause == FrameCause::Steps || steps <= kFourSteps;
      if (both_sides || !like_harmonic) others.push_back(std::move(one));
      continue;
    }
    if (predict_alike(one, declared) || !show_whole_fringe(sample, one)) continue;
    const double rough = rough_score(moments.moments, moments.means, moments.relative_noise, one);
    ranked.emplace_back(rough, std::move(one));
  }
  std::stable_sort(
      ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<FrameHypothesis> out;
  for (auto& [rough, one] : ranked) {
    if (out.size() == kScoredSingles) break;
    out.push_back(std::move(one));
  }
  for (FrameHypothesis& one : likeliest_of_each(sample, std::move(others)))
    out.push_back(std::move(one));
  for (FrameHypothesis& one : last)
    out.push_back(std::move(one));
  return out;
}

/// Pairs of faults of which each by itself is likely, the best ones.
std::vector<FrameHypothesis> likely_pairs(const FrameMoments& moments,
                                          const std::vector<FrameHypothesis>& singles) {
  std::vector<std::pair<double, FrameHypothesis>> ranked;
  const std::size_t count = std::min(singles.size(), kPairedSingles);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = i + 1; k < count; ++k) {
      std::optional<FrameHypothesis> both = both_of(singles[i], singles[k]);
      if (!both) continue;
      const FrameDesign design = design_of(*both);
      // Two lost frames may leave just what determines the phase; other pairs need a residual.
      const bool determines = design.inverse.size() > 0;
      const bool both_lost = std::ssize(design.shown) + 2 == std::ssize(both->free);
      if (!determines || (design.rest.cols() < 2 && !both_lost)) continue;
      bool structural = true;
      for (const FrameHypothesis* one : {&singles[i], &singles[k]}) {
        if (one->cause == FrameCause::Gain)
          structural = structural && fit_gain(moments, one->frames.front(), *both);
      }
      // Two faults that show what one does are that one.
      const bool known = std::any_of(singles.begin(), singles.end(), [&](const auto& one) {
        return predict_alike(one, *both);
      });
      if (!structural || known) continue;
      const double rough =
          rough_score(moments.moments, moments.means, moments.relative_noise, *both);
      ranked.emplace_back(rough, *std::move(both));
    }
  }
  std::stable_sort(
      ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<FrameHypothesis> out;
  constexpr std::size_t kScoredPairs = 3;
  for (auto& [rough, one] : ranked) {
    if (out.size() == kScoredPairs) break;
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace

std::vector<FrameHypothesis> likely_hypotheses(const FrameSample& sample, const Pattern& pattern) {
  const FrameMoments moments = moments_of(sample);
  std::vector<FrameHypothesis> all = likely_singles(sample, moments, pattern);
  constexpr std::size_t kMinFramesOfPairs = 6;  // fewer leave too little that checks a pair
  if (pattern.shifts_rad.size() < kMinFramesOfPairs) return all;
  for (FrameHypothesis& both : likely_pairs(moments, all))
    all.push_back(std::move(both));
  return all;
}

}  // namespace frangia
