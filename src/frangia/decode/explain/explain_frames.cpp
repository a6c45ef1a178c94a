#include "frangia/decode/explain/explain_frames.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/decode/explain/internal/covered_part.h"
#include "frangia/decode/explain/internal/frame_design.h"
#include "frangia/decode/explain/internal/frame_priors.h"
#include "frangia/decode/explain/internal/frame_sample.h"
#include "frangia/decode/explain/internal/likely_hypotheses.h"
#include "frangia/decode/explain/internal/score_frames.h"
#include "frangia/diagnose/score.h"

namespace frangia {
namespace {

constexpr std::size_t kMinFrames = 3;
constexpr std::size_t kMaxFrames = 24;      ///< longer sequences hardly feel one frame
constexpr Eigen::Index kMinPixels = 200;    ///< fewer explain nothing
constexpr double kPriorUnexplained = 0.01;  ///< odds of a broad density before the data
/// Standard deviation of what blur, texture and ambient light leave of sound frames, over the
/// modulation.
constexpr double kSoundRest = 0.03;
/// What sound frames leave at most before other hypotheses are scored: less cannot be bettered.
constexpr double kNegligibleRest = 0.015;
constexpr double kNegligibleGain = 0.05;
constexpr double kNegligibleExcess = 0.1;  ///< the same in dim frames, of the residual's variance
/// Residual variance over the noise within which the noise model may be wrong.
constexpr double kNoiseTolerance = 0.25;
/// What frames in another order leave at least; on a part of one fringe nothing else is asked.
constexpr double kOtherOrder = 0.3;
/// RMS of a cosine: beyond it the frames are no fringes.
const double kNoFringes = std::sqrt(0.5);

/// A hypothesis with its score.
struct Candidate {
  FrameHypothesis hypothesis;
  FrameScore score;
};

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
  const auto covers = [&](const FrameHypothesis& shown) {
    const FrameDesign design = design_of(shown);
    if (design.inverse.size() == 0) return false;
    const Eigen::MatrixXd values =
        sample.counts(Eigen::all, design.shown).matrix() * design.inverse.transpose();
    Eigen::ArrayXd bins = Eigen::ArrayXd::Zero(kBins);
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      const double turn = std::atan2(values(i, 2), values(i, 1)) / kTwoPi + 0.5;
      bins(std::min(kBins - 1, static_cast<Eigen::Index>(turn * kBins))) += 1.0;
    }
    return (bins > kLeast * static_cast<double>(values.rows())).count() >= kCovered;
  };
  if (covers(others)) return true;
  for (std::size_t k = 0; k < others.free.size(); ++k) {  // no single frame hides the fringes
    if (others.free[k]) continue;
    FrameHypothesis without = others;
    without.free[k] = true;
    if (covers(without)) return true;
  }
  return false;
}

/// Share of the samples that count, by the hypothesis that leaves least.
double share_of(const std::vector<Candidate>& candidates, const FrameSample& sample) {
  const FrameScore* least = nullptr;
  double highest = 0.0;
  for (const Candidate& one : candidates) {
    if (one.score.residuals.empty()) continue;
    const double density = one.score.log_density - one.score.reference_gains.sum();
    if (least != nullptr && density <= highest) continue;
    least = &one.score;
    highest = density;
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
    // Gains of all frames that explain what flicker does not, without one that is at fault.
    if (score.largest_gain > kStructuralGain) out += std::log(kPriorFault);
  }
  return out - price_of_choice(hypothesis.choices) -
         hypothesis.parameters * price_of_parameter(samples);
}

/// A frame at another gain lets the light of the room be anything; where a dark room explains the
/// frames as well, it has fewer unknowns.
void prefer_dark_room(const FrameSample& sample, FrameHypothesis& hypothesis, FrameScore& score) {
  FrameHypothesis dark = hypothesis;
  dark.lamp_on.reset();
  FrameScore of_dark = score_frames(sample, dark);
  if (of_dark.log_evidence(1.0) <= score.log_evidence(1.0)) return;
  hypothesis = std::move(dark);
  score = std::move(of_dark);
}

/// The same hypotheses, of which the likely movements are one class: that something moved may be
/// sure where it is open which frames saw it.
std::vector<ScoredHypothesis> join_movements(const std::vector<Candidate>& candidates,
                                             double highest,
                                             std::vector<ScoredHypothesis> scored) {
  std::vector<std::size_t> likely;
  bool is_moved = false;
  for (std::size_t i = 0; i < scored.size(); ++i) {
    const FrameHypothesis& one = candidates[i].hypothesis;
    const bool moved = one.cause == FrameCause::Moved;
    if (scored[i].log_evidence < highest - kNamedLogOdds || !(moved || displaced_alone(one)))
      continue;
    likely.push_back(i);
    is_moved = is_moved || moved;
  }
  if (!is_moved || likely.size() < 2) return scored;
  for (const std::size_t i : likely) {
    scored[i].prediction = likely.front();
    scored[i].text = "the part or the camera moved while the frames were taken";
  }
  return scored;
}

/// RMS effect on the phase of errors of the steps that are not decided, each as likely as its
/// evidence says, rad.
double spread_of_steps(const std::vector<Candidate>& candidates,
                       const std::vector<ScoredHypothesis>& scored) {
  double highest = scored.front().log_evidence;
  for (const ScoredHypothesis& one : scored)
    highest = std::max(highest, one.log_evidence);
  double all = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < scored.size(); ++i) {
    const double odds = std::exp(scored[i].log_evidence - highest);
    const Eigen::VectorXd& errors_rad = candidates[i].score.step_errors_rad;
    all += odds;
    if (errors_rad.size() == 0) continue;
    const auto count = static_cast<double>(errors_rad.size());
    square += odds * 2.0 / count * (errors_rad.array() - errors_rad.mean()).square().mean();
  }
  return std::sqrt(square / all);
}

/// Names what a lost frame shows.
std::string text_of(const FrameHypothesis& hypothesis, const FrameSample& sample, int white_level) {
  std::string text = describe(hypothesis);
  constexpr double kBlack = 0.25;
  constexpr double kWhite = 0.9;
  for (std::size_t frame = 0; frame < hypothesis.free.size(); ++frame) {
    const std::string clause = fmt::format("frame {} shows no fringes", frame);
    const auto at = text.find(clause);
    if (!hypothesis.free[frame] || hypothesis.in_part || at == std::string::npos) continue;
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
    case FrameCause::Sorted:
      return "bring the frames into the order of their numbers";
    case FrameCause::Covered:
      return "keep everything out of the light while the frames are captured";
    case FrameCause::Displaced:
      return "hold camera and part still while the frames are captured";
    case FrameCause::Exposure:
      return "switch off automatic exposure and gain of the camera, and capture the frames again";
    case FrameCause::Moved:
      return "hold the part still while it is captured, and capture the frames again";
    case FrameCause::Steps:
      return "correct shifts_deg of scan.toml, or hold rig and part still while they are captured";
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

FrameExplanation explain_frames(const FrameStack& stack,
                                const NoiseModel& noise,
                                std::span<const FrameStack* const> references) {
  FrameExplanation out{.pattern = stack.pattern.name};
  const std::size_t frames = stack.pattern.shifts_rad.size();
  if (frames < kMinFrames || frames > kMaxFrames || frames != stack.frames.size()) return out;
  const FrameSample sample = sample_blocks(stack, noise, references);
  if (sample.counts.rows() < kMinPixels) return out;
  const FrameHypothesis declared = frame_hypotheses(stack.pattern).front();
  std::vector<Candidate> candidates{{declared, score_frames(sample, declared)}};
  const bool covers = cover_fringe(sample, declared);
  if (!covers && candidates.front().score.unexplained < kOtherOrder) return out;
  out.decided = true;
  const FrameScore& sound = candidates.front().score;
  const bool fits = !sound.residuals.empty() && sound.largest_gain < kNegligibleGain &&
                    (sound.unexplained < kNegligibleRest || sound.excess < kNegligibleExcess);
  if (!fits) {
    FrameHypothesis broad = declared;
    broad.cause = FrameCause::Unexplained;
    broad.parameters = 1;
    candidates.push_back({broad, candidates.front().score});
    for (FrameHypothesis& one : likely_hypotheses(sample, stack.pattern)) {
      const bool by_others = one.cause == FrameCause::Exposure && sample.has_reference();
      if (!covers && !by_others && one.cause != FrameCause::Exchanged) continue;
      FrameScore score = score_frames(sample, one);
      if (one.cause == FrameCause::Lamp && std::abs(score.lamp_share) < kStructuralLamp) continue;
      if (one.cause == FrameCause::Gain) prefer_dark_room(sample, one, score);
      one.displacement_px = score.largest_displacement_px;
      candidates.push_back({std::move(one), std::move(score)});
    }
    if (covers) {
      if (auto part = find_covered_part(sample, stack.pattern))
        candidates.push_back({std::move(part->hypothesis), std::move(part->score)});
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
  if (!out.explanation.is_decided()) {
    auto joined =
        join_movements(candidates, scored[out.explanation.likeliest].log_evidence, scored);
    const Explanation of_joined = choose(joined);
    if (of_joined.is_decided()) {
      scored = std::move(joined);
      out.explanation = of_joined;
    }
  }
  std::size_t winner = out.explanation.likeliest;
  if (!out.explanation.is_decided() && candidates.size() > 1) {
    // No cause is named. Without evidence against them the frames count as described.
    constexpr std::size_t kBroad = 1;
    const double gain = scored[winner].log_evidence - scored.front().log_evidence;
    winner = gain < kNamedLogOdds ? 0 : kBroad;
  }
  out.best = candidates[winner].hypothesis;
  const Eigen::VectorXd& errors_rad = candidates[winner].score.step_errors_rad;
  for (Eigen::Index k = 0; k < errors_rad.size(); ++k)  // without their mean, which is a phase
    out.best.shifts_rad[static_cast<std::size_t>(k)] += errors_rad(k) - errors_rad.mean();
  out.alike.push_back(out.best);
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (i != winner && scored[i].prediction == scored[winner].prediction)
      out.alike.push_back(candidates[i].hypothesis);
  const FrameScore& score = candidates[winner].score;
  if (!covers && !out.has_fault()) return {.pattern = stack.pattern.name};
  out.are_fringes = score.unexplained < kNoFringes;
  if (score.excess > kNoiseTolerance / (1.0 + kNoiseTolerance)) {
    const auto shown = std::count(out.best.free.begin(), out.best.free.end(), false);
    out.unexplained_rad = score.unexplained * std::sqrt(2.0 / static_cast<double>(shown));
  }
  if (!out.explanation.is_decided())
    out.unexplained_rad = std::hypot(out.unexplained_rad, spread_of_steps(candidates, scored));
  return out;
}

namespace {

constexpr int kStride = 3;             ///< px between samples
constexpr double kLeastShare = 0.002;  ///< of the samples; fewer do not matter
constexpr double kOverNeighbours = 4.0;
constexpr double kLeastNoise = 0.35;  ///< counts; less leaves all equal pixels at one level
constexpr int kNeighbours = 12;       ///< levels below the ceiling that are compared
/// Odds of a ceiling below the white level before the data.
constexpr double kPriorCeiling = 0.01;

/// How often each level occurs.
std::map<int, double> count_levels(std::span<const FrameStack> stacks) {
  std::map<int, double> levels;
  for (const FrameStack& stack : stacks) {
    if (stack.pattern.kind != PatternKind::Fringe) continue;
    for (const Frame& frame : stack.frames) {
      std::visit(
          [&](const auto& image) {
            for (int y = kStride / 2; y < image.height(); y += kStride)
              for (int x = kStride / 2; x < image.width(); x += kStride)
                levels[static_cast<int>(image(x, y))] += 1.0;
          },
          frame);
    }
  }
  return levels;
}

}  // namespace

std::optional<Ceiling> find_ceiling(std::span<const FrameStack> stacks, const NoiseModel& noise) {
  const std::map<int, double> levels = count_levels(stacks);
  if (levels.empty()) return std::nullopt;
  const auto [ceiling, at] = *levels.rbegin();
  if (ceiling >= stacks.front().white_level) return std::nullopt;
  if (ceiling == 0) return std::nullopt;  // black frames
  if (std::sqrt(noise.variance(ceiling)) < kLeastNoise) return std::nullopt;
  double all = 0.0;
  double most = 1.0;
  for (const auto& [level, count] : levels) {
    all += count;
    if (level < ceiling && level >= ceiling - kNeighbours) most = std::max(most, count);
  }
  if (at < kLeastShare * all || at < kOverNeighbours * most) return std::nullopt;
  // Poisson counts of the mean `most` against the count that was found.
  const double log_odds = at * std::log(at / most) - (at - most) + std::log(kPriorCeiling);
  if (log_odds < kNamedLogOdds) return std::nullopt;
  return Ceiling{ceiling, at / all, log_odds};
}

}  // namespace frangia
