#include "frangia/decode/explain/explain_frames.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/decode/explain/internal/frame_design.h"
#include "frangia/decode/explain/internal/frame_sample.h"
#include "frangia/decode/explain/internal/score_frames.h"
#include "frangia/diagnose/score.h"

namespace frangia {
namespace {

constexpr std::size_t kMinFrames = 3;
constexpr std::size_t kMaxFrames = 24;    ///< longer sequences hardly feel one frame
constexpr Eigen::Index kMinPixels = 200;  ///< fewer explain nothing
constexpr std::size_t kScoredSingles = 8;
constexpr std::size_t kPairedSingles = 5;
/// Witnesses in what a hypothesis leaves beyond the noise: it may be one smooth field.
constexpr double kFieldWitnesses = 50.0;
/// Odds of a structural fault, and of a broad density, before the data.
constexpr double kPriorFault = 0.01;
constexpr double kPriorUnexplained = 0.01;
/// Logarithm of the least gain that is a fault of a single frame; less is flicker.
constexpr double kStructuralGain = 0.1;
/// Standard deviation of what blur, texture and ambient light leave of sound frames, over the
/// modulation.
constexpr double kSoundRest = 0.03;
/// What sound frames leave at most before other hypotheses are scored: less cannot be bettered.
constexpr double kNegligibleRest = 0.015;
constexpr double kNegligibleGain = 0.05;
/// Residual variance over the noise within which the noise model may be wrong.
constexpr double kNoiseTolerance = 0.25;
/// RMS of a cosine: beyond it the frames are no fringes.
const double kNoFringes = std::sqrt(0.5);

/// A hypothesis with its score.
struct Candidate {
  FrameHypothesis hypothesis;
  FrameScore score;
};

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

/// With three frames, those that remain must show the whole fringe; a part in the dark part of one
/// coarse fringe looks like a black frame otherwise.
bool show_whole_fringe(const FrameSample& sample, const FrameHypothesis& hypothesis) {
  if (hypothesis.shifts_rad.size() > kMinFrames) return true;
  constexpr double kDark = 0.3;
  constexpr double kLeast = 0.1;
  for (std::size_t k = 0; k < hypothesis.free.size(); ++k) {
    if (hypothesis.free[k]) continue;
    const auto dark = sample.counts.col(static_cast<Eigen::Index>(k)) < kDark * sample.scale_counts;
    if (dark.cast<double>().mean() < kLeast) return false;
  }
  return true;
}

/// Whether the phases of four frames or more cover the fringe: on a part of one coarse fringe, the
/// plateaus of binary fringes look like lost frames. One lost frame of four leaves half of it.
bool cover_fringe(const FrameSample& sample, const FrameHypothesis& declared) {
  if (declared.shifts_rad.size() <= kMinFrames) return true;
  constexpr Eigen::Index kBins = 12;
  constexpr Eigen::Index kCovered = 5;
  constexpr double kLeast = 0.01;  // of the pixels
  constexpr double kWhite = 0.9;
  FrameHypothesis others = declared;  // without white frames, which outshine the fringes
  for (std::size_t k = 0; k < others.free.size(); ++k) {
    const auto brightest =
        sample.counts.col(static_cast<Eigen::Index>(k)) >= sample.counts.maxCoeff();
    others.free[k] = brightest.cast<double>().mean() > kWhite;
  }
  const FrameDesign design = design_of(others);
  if (design.inverse.size() == 0) return true;
  const Eigen::MatrixXd values =
      sample.counts(Eigen::all, design.shown).matrix() * design.inverse.transpose();
  Eigen::ArrayXd bins = Eigen::ArrayXd::Zero(kBins);
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    const double turn = std::atan2(values(i, 2), values(i, 1)) / kTwoPi + 0.5;
    bins(std::min(kBins - 1, static_cast<Eigen::Index>(turn * kBins))) += 1.0;
  }
  return (bins > kLeast * static_cast<double>(values.rows())).count() >= kCovered;
}

/// The hypotheses with one fault, those that fit roughly best first.
std::vector<FrameHypothesis> likely_singles(const FrameSample& sample,
                                            const FrameMoments& moments,
                                            const Pattern& pattern) {
  std::vector<std::pair<double, FrameHypothesis>> ranked;
  std::vector<FrameHypothesis> all = frame_hypotheses(pattern);
  const FrameHypothesis declared = all.front();
  for (FrameHypothesis& one : all) {
    if (one.cause == FrameCause::Gain && !fit_gain(moments, one.frames.front(), one)) continue;
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

/// Share of the samples that count, by the hypothesis that leaves least.
double share_of(const std::vector<Candidate>& candidates, const FrameSample& sample) {
  const FrameScore* least = nullptr;
  for (const Candidate& one : candidates) {
    if (one.score.residuals.empty()) continue;
    if (least == nullptr || one.score.log_density > least->log_density) least = &one.score;
  }
  const auto pixels = static_cast<double>(sample.counts.rows());
  if (least == nullptr) {  // no residuals: blocks are the witnesses
    const auto blocks = std::set<int>(sample.blocks.begin(), sample.blocks.end()).size();
    return static_cast<double>(blocks) / pixels;
  }
  const double by_blocks = effective_share(least->residuals, sample.blocks);
  const double field = std::max(1.0, pixels / kFieldWitnesses);
  return 1.0 / ((1.0 - least->excess) / by_blocks + least->excess * field);
}

double log_prior(const FrameHypothesis& hypothesis, const FrameScore& score, double samples) {
  double out = 0.0;
  if (hypothesis.cause == FrameCause::Unexplained) {
    out = std::log(kPriorUnexplained);
  } else {
    out = -0.5 * std::pow(score.unexplained / kSoundRest, 2);
    out += hypothesis.faults * std::log(kPriorFault);
  }
  return out - price_of_choice(hypothesis.choices) -
         hypothesis.parameters * price_of_parameter(samples);
}

/// Names what a lost frame shows.
std::string text_of(const FrameHypothesis& hypothesis, const FrameSample& sample, int white_level) {
  std::string text = describe(hypothesis);
  constexpr double kBlack = 0.25;
  constexpr double kWhite = 0.9;
  for (std::size_t frame = 0; frame < hypothesis.free.size(); ++frame) {
    const std::string clause = fmt::format("frame {} shows no fringes", frame);
    const auto at = text.find(clause);
    if (!hypothesis.free[frame] || at == std::string::npos) continue;
    const Eigen::ArrayXd counts = sample.counts.col(static_cast<Eigen::Index>(frame));
    if ((counts / sample.scale_counts).mean() < kBlack)
      text.replace(at, clause.size(), fmt::format("frame {} is black", frame));
    else if ((counts >= white_level).cast<double>().mean() > kWhite)
      text.replace(at, clause.size(), fmt::format("frame {} is white", frame));
  }
  return text;
}

std::string remedy_of(const FrameHypothesis& hypothesis) {
  switch (hypothesis.cause) {
    case FrameCause::AsDescribed:
      return {};
    case FrameCause::Exchanged:
      return "correct the order of the frames";
    case FrameCause::Lamp:
      return "keep the light of the room as it is, and capture the frames again";
    case FrameCause::Unexplained:
      return "check that the frames are those of this pattern, and that nothing moved";
    default:
      break;
  }
  return "capture the frames again, the projector and the camera in step";
}

}  // namespace

bool FrameExplanation::has_fault() const {
  return decided && explanation.is_decided() && best.cause != FrameCause::AsDescribed &&
         best.cause != FrameCause::Unexplained;
}

FrameExplanation explain_frames(const FrameStack& stack, const NoiseModel& noise) {
  FrameExplanation out{.pattern = stack.pattern.name};
  const std::size_t frames = stack.pattern.shifts_rad.size();
  if (frames < kMinFrames || frames > kMaxFrames || frames != stack.frames.size()) return out;
  const FrameSample sample = sample_blocks(stack, noise);
  if (sample.counts.rows() < kMinPixels) return out;
  const FrameHypothesis declared = frame_hypotheses(stack.pattern).front();
  if (!cover_fringe(sample, declared)) return out;
  out.decided = true;

  std::vector<Candidate> candidates{{declared, score_frames(sample, declared)}};
  const FrameScore& sound = candidates.front().score;
  const bool fits = !sound.residuals.empty() && sound.unexplained < kNegligibleRest &&
                    sound.largest_gain < kNegligibleGain;
  if (!fits) {
    FrameHypothesis broad = declared;
    broad.cause = FrameCause::Unexplained;
    broad.parameters = 1;
    candidates.push_back({broad, candidates.front().score});
    const FrameMoments moments = moments_of(sample);
    const std::vector<FrameHypothesis> singles = likely_singles(sample, moments, stack.pattern);
    std::vector<FrameHypothesis> all = singles;
    for (FrameHypothesis& both : likely_pairs(moments, singles))
      all.push_back(std::move(both));
    for (FrameHypothesis& one : all) {
      FrameScore score = score_frames(sample, one);
      candidates.push_back({std::move(one), std::move(score)});
    }
  }

  const double share = share_of(candidates, sample);
  const double samples = share * static_cast<double>(sample.counts.rows());
  std::vector<ScoredHypothesis> scored;
  for (const Candidate& one : candidates) {
    std::size_t prediction = scored.size();
    for (std::size_t i = 0; i < scored.size() && prediction == scored.size(); ++i)
      if (predict_alike(candidates[i].hypothesis, one.hypothesis)) prediction = i;
    scored.push_back({text_of(one.hypothesis, sample, stack.white_level),
                      one.score.log_evidence(share) + log_prior(one.hypothesis, one.score, samples),
                      one.score.unexplained,
                      remedy_of(one.hypothesis),
                      prediction});
  }
  out.explanation = choose(scored);
  const auto best = std::find_if(scored.begin(), scored.end(), [&](const ScoredHypothesis& one) {
    return one.text == out.explanation.best.front();
  });
  std::size_t winner = static_cast<std::size_t>(best - scored.begin());
  if (!out.explanation.is_decided() && candidates.size() > 1) {
    // No cause is named. Without evidence against them the frames count as described.
    constexpr std::size_t kBroad = 1;
    winner = best->log_evidence - scored.front().log_evidence < std::log(100.0) ? 0 : kBroad;
  }
  out.best = candidates[winner].hypothesis;
  const FrameScore& score = candidates[winner].score;
  out.are_fringes = score.unexplained < kNoFringes;
  if (score.excess > kNoiseTolerance / (1.0 + kNoiseTolerance)) {
    const auto shown = std::count(out.best.free.begin(), out.best.free.end(), false);
    out.unexplained_rad = score.unexplained * std::sqrt(2.0 / static_cast<double>(shown));
  }
  return out;
}

}  // namespace frangia
