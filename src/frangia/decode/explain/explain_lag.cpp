#include "frangia/decode/explain/explain_lag.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include <Eigen/Core>
#include <fmt/format.h>

#include "frangia/core/random.h"
#include "frangia/core/statistics.h"
#include "frangia/decode/explain/internal/frame_priors.h"
#include "frangia/diagnose/score.h"
#include "frangia/phase/algorithm/phase_algorithm.h"

namespace frangia {
namespace {

constexpr std::array kLags = {1, 2, 3, -1};
constexpr std::size_t kFewestFrames = 3;  ///< that determine a pixel
constexpr int kGrid = 80;                 ///< pixels along the longer side of the image
constexpr std::size_t kFewestPixels = 200;
constexpr double kLeastChange = 0.25;  ///< least change of a pixel over the large changes
/// RMS over the modulation of what blur, texture and harmonics leave of frames in step.
constexpr double kRestInStep = 0.03;
/// The same of frames out of step at least.
constexpr double kOutOfStep = 0.1;
/// What a lag leaves of the mean square at most: the patterns that it concerns are not all the
/// same.
constexpr double kMostLeft = 0.5;

/// A frame of the sequence.
struct Shown {
  const Frame* frame;
  const FrameStack* stack;
};

std::vector<Shown> sequence_of(std::span<const FrameStack> stacks) {
  std::vector<Shown> out;
  for (const FrameStack& stack : stacks)
    for (const Frame& frame : stack.frames)
      out.push_back({&frame, &stack});
  return out;
}

bool has_fringes(const FrameStack& stack) {
  return stack.pattern.kind == PatternKind::Fringe &&
         stack.frames.size() == stack.pattern.shifts_rad.size() &&
         stack.frames.size() >= kFewestFrames;
}

/// The counts of all frames at lit pixels: pixels x frames of the sequence.
Eigen::ArrayXXd lit_counts(const std::vector<Shown>& sequence) {
  const int width = width_of(*sequence.front().frame);
  const int height = height_of(*sequence.front().frame);
  const double step = std::max(1.0, static_cast<double>(std::max(width, height)) / kGrid);
  std::vector<Eigen::ArrayXd> pixels;
  std::vector<double> changes;
  for (int row = 0; (row + 1) * step <= height; ++row) {
    for (int column = 0; (column + 1) * step <= width; ++column) {
      // At equal distances all pixels might see the same phase.
      const std::uint64_t place =
          hash(hash(static_cast<std::uint64_t>(row)), static_cast<std::uint64_t>(column));
      const int x = static_cast<int>((column + uniform_from(place)) * step);
      const int y = static_cast<int>((row + uniform_from(hash(place))) * step);
      Eigen::ArrayXd pixel(std::ssize(sequence));
      double least = INFINITY;
      double most = 0.0;
      bool saturated = false;
      for (std::size_t j = 0; j < sequence.size(); ++j) {
        const double counts = counts_at(*sequence[j].frame, x, y);
        pixel(static_cast<Eigen::Index>(j)) = counts;
        if (!has_fringes(*sequence[j].stack)) continue;
        saturated = saturated || counts >= sequence[j].stack->white_level;
        least = std::min(least, counts);
        most = std::max(most, counts);
      }
      if (saturated) continue;
      pixels.push_back(std::move(pixel));
      changes.push_back(most - least);
    }
  }
  if (pixels.empty()) return {};
  std::vector<double> ordered = changes;
  const auto high = ordered.begin() + std::ssize(ordered) * 9 / 10;
  std::nth_element(ordered.begin(), high, ordered.end());
  Eigen::ArrayXXd out(std::ssize(pixels), std::ssize(sequence));
  Eigen::Index kept = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    if (changes[i] > std::max(kLeastChange * *high, 1.0)) out.row(kept++) = pixels[i];
  return out.topRows(kept);
}

/// Mean, modulation and residual variance of all pixels by the frames of one pattern.
struct Fitted {
  Eigen::ArrayXd mean;
  Eigen::ArrayXd modulation;
  Eigen::ArrayXd rest;  ///< variance of the residual; empty for three frames
};

/// The pattern as it is shown from a place of the sequence on. Empty if fewer frames than three
/// are left of it.
Fitted fit(const Eigen::ArrayXXd& counts, const Pattern& pattern, std::ptrdiff_t from) {
  std::vector<Eigen::Index> places;
  std::vector<double> shifts_rad;
  for (std::size_t k = 0; k < pattern.shifts_rad.size(); ++k) {
    const std::ptrdiff_t place = from + static_cast<std::ptrdiff_t>(k);
    if (place < 0 || place >= counts.cols()) continue;
    places.push_back(place);
    shifts_rad.push_back(pattern.shifts_rad[k]);
  }
  if (places.size() < kFewestFrames) return {};
  const PhaseAlgorithm weights = least_squares(shifts_rad);
  const auto sum = [&](const std::vector<double>& of) {
    Eigen::ArrayXd out = Eigen::ArrayXd::Zero(counts.rows());
    for (std::size_t k = 0; k < places.size(); ++k)
      out += of[k] * counts.col(places[k]);
    return out;
  };
  const Eigen::ArrayXd mean = sum(weights.mean);
  const Eigen::ArrayXd cosine = sum(weights.cosine);
  const Eigen::ArrayXd sine = sum(weights.sine);
  Fitted out{mean, (cosine.square() + sine.square()).sqrt(), {}};
  if (places.size() == kFewestFrames) return out;
  out.rest = Eigen::ArrayXd::Zero(counts.rows());
  for (std::size_t k = 0; k < places.size(); ++k)
    out.rest += (counts.col(places[k]) - mean - std::cos(shifts_rad[k]) * cosine +
                 std::sin(shifts_rad[k]) * sine)
                    .square();
  out.rest /= static_cast<double>(places.size() - kFewestFrames);
  return out;
}

double median_of(const Eigen::ArrayXd& values) {
  return median(std::vector<double>(values.begin(), values.end()));
}

constexpr double kLeast_counts2 = 1.0;  ///< of a squared modulation: less is none

/// Darkest and brightest counts of each pixel.
struct Levels {
  Eigen::ArrayXd dark;
  Eigen::ArrayXd range;
};

Levels levels_of(const Eigen::ArrayXXd& counts) {
  const Eigen::ArrayXd dark = counts.rowwise().minCoeff();
  return {dark, (counts.rowwise().maxCoeff() - dark).max(std::sqrt(kLeast_counts2))};
}

/// How far the frames of a Gray code, as it is shown from a place of the sequence on, are from dark
/// and from bright: the mean square over half of the range.
Eigen::ArrayXd between_levels(const Eigen::ArrayXXd& counts,
                              const Levels& levels,
                              std::ptrdiff_t from,
                              std::ptrdiff_t frames) {
  const std::ptrdiff_t begin = std::max<std::ptrdiff_t>(0, from);
  const std::ptrdiff_t end = std::min<std::ptrdiff_t>(counts.cols(), from + frames);
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(counts.rows());
  for (std::ptrdiff_t k = begin; k < end; ++k) {
    const Eigen::ArrayXd share = (counts.col(k) - levels.dark) / levels.range;
    sum += (2.0 * share.min(1.0 - share)).square();
  }
  return sum / static_cast<double>(std::max<std::ptrdiff_t>(1, end - begin));
}

/// How much mean and modulation of two patterns differ, over the modulation. Fine fringes have less
/// contrast, by one factor.
Eigen::ArrayXd difference_of(const Fitted& a, const Fitted& b) {
  const double factor = median_of(b.modulation / a.modulation.max(std::sqrt(kLeast_counts2)));
  const Eigen::ArrayXd other = factor * a.modulation;
  return ((b.mean - a.mean).square() + 0.5 * (b.modulation - other).square()) /
         (0.5 * (b.modulation.square() + other.square())).max(kLeast_counts2);
}

/// The same of fringes beside the levels of a Gray code, of which they are one share everywhere.
Eigen::ArrayXd difference_of(const Fitted& fringes, const Levels& levels) {
  const Eigen::ArrayXd mean = (fringes.mean - levels.dark) / levels.range;
  const Eigen::ArrayXd modulation = fringes.modulation / levels.range;
  const double usual = std::max(median_of(modulation), 1e-3);
  return ((mean - median_of(mean)).square() + 0.5 * (modulation - usual).square()) /
         (usual * usual);
}

/// What the patterns leave if their frames are late by `lag`: the median over the pixels of the
/// mean square of residuals, and of how the patterns differ in mean and modulation, over the
/// modulation. Nothing if no two patterns tell.
std::optional<double> misfit_of(const Eigen::ArrayXXd& counts,
                                std::span<const FrameStack> stacks,
                                int lag) {
  const Levels levels = levels_of(counts);
  std::vector<Fitted> fits;
  std::vector<Eigen::ArrayXd> terms;
  std::ptrdiff_t begin = lag;
  for (const FrameStack& stack : stacks) {
    const auto frames = std::ssize(stack.frames);
    if (stack.pattern.kind == PatternKind::Gray)
      terms.push_back(between_levels(counts, levels, begin, frames));
    if (has_fringes(stack)) {
      Fitted one = fit(counts, stack.pattern, begin);
      if (one.mean.size() > 0) fits.push_back(std::move(one));
    }
    begin += frames;
  }
  const bool has_code = !terms.empty();
  if (fits.size() < (has_code ? 1U : 2U)) return std::nullopt;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const Fitted& one = fits[i];
    if (one.rest.size() > 0)
      terms.push_back(one.rest / one.modulation.square().max(kLeast_counts2));
    if (has_code) terms.push_back(difference_of(one, levels));
    if (i > 0) terms.push_back(difference_of(fits[i - 1], one));
  }
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(counts.rows());
  for (const Eigen::ArrayXd& term : terms)
    sum += term;
  return median_of(sum / static_cast<double>(terms.size()));
}

/// Whether what is left of a pattern, in the order of its shifts, determines the phase.
bool determines_phase(const FrameStack& stack) {
  if (stack.pattern.kind != PatternKind::Fringe) return false;
  return stack.frames.size() >= kFewestFrames;
}

/// Whether two lags predict the same frames: they differ by whole patterns of equal length.
bool predict_alike(int a, int b, std::span<const FrameStack> stacks) {
  const auto frames = std::ssize(stacks.front().frames);
  const bool equally_long = std::all_of(stacks.begin(), stacks.end(), [&](const FrameStack& one) {
    return std::ssize(one.frames) == frames;
  });
  return a == b || (equally_long && (a - b) % frames == 0);
}

}  // namespace

std::optional<FrameLag> explain_lag(std::span<const FrameStack> stacks) {
  const auto fringes = std::count_if(stacks.begin(), stacks.end(), has_fringes);
  const bool has_code = std::any_of(stacks.begin(), stacks.end(), [](const FrameStack& one) {
    return one.pattern.kind == PatternKind::Gray;
  });
  const bool bracketed = std::any_of(stacks.begin(), stacks.end(), [](const FrameStack& one) {
    return one.pattern.exposure_count() > 1;
  });
  if (fringes < (has_code ? 1 : 2) || bracketed) return std::nullopt;
  const Eigen::ArrayXXd counts = lit_counts(sequence_of(stacks));
  if (counts.rows() < static_cast<Eigen::Index>(kFewestPixels)) return std::nullopt;
  const std::optional<double> described = misfit_of(counts, stacks, 0);
  if (!described || *described < kOutOfStep * kOutOfStep) return std::nullopt;
  // Gaussian rests of unknown size, that are one smooth field each.
  const auto evidence = [](double misfit) {
    return -0.5 * kFieldWitnesses * std::log(misfit + kRestInStep * kRestInStep);
  };
  std::vector<FrameLag> lags{{}};
  std::vector<ScoredHypothesis> scored{{"the frames are as described", evidence(*described)}};
  for (const int frames : kLags) {
    if (predict_alike(frames, 0, stacks)) continue;
    const std::optional<double> misfit = misfit_of(counts, stacks, frames);
    if (!misfit || *misfit > kMostLeft * *described) continue;
    lags.push_back({frames});
    std::size_t alike = 1;
    while (!predict_alike(lags[alike].frames, frames, stacks))
      ++alike;
    const double price = price_of_choice(kLags.size()) - std::log(kPriorFault);
    scored.push_back(
        {describe(lags.back()), evidence(*misfit) - price, std::sqrt(*misfit), {}, alike});
  }
  const Explanation found = choose(scored);
  if (!found.is_decided() || found.likeliest == 0) return std::nullopt;
  // Of those that predict the same, one that leaves a phase of all patterns.
  FrameLag best = lags[found.likeliest];
  for (std::size_t i = 1; i < lags.size() && in_step(stacks, best).empty(); ++i)
    if (scored[i].prediction == scored[found.likeliest].prediction &&
        scored[i].log_evidence > scored[found.likeliest].log_evidence - kNamedLogOdds)
      best = lags[i];
  best.explanation = found;
  return best;
}

std::vector<FrameStack> in_step(std::span<const FrameStack> stacks, const FrameLag& lag) {
  const std::vector<Shown> sequence = sequence_of(stacks);
  std::vector<FrameStack> out;
  std::ptrdiff_t begin = 0;
  for (const FrameStack& stack : stacks) {
    FrameStack moved{.pattern = stack.pattern,
                     .frames = {},
                     .white_level = stack.white_level,
                     .exposure = stack.exposure,
                     .compression_counts2 = stack.compression_counts2,
                     .color = {}};
    if (has_fringes(stack)) moved.pattern.shifts_rad.clear();
    for (std::size_t k = 0; k < stack.frames.size(); ++k) {
      const std::ptrdiff_t place = begin + static_cast<std::ptrdiff_t>(k) + lag.frames;
      if (place < 0 || place >= std::ssize(sequence)) continue;
      moved.frames.push_back(*sequence[static_cast<std::size_t>(place)].frame);
      if (has_fringes(stack)) moved.pattern.shifts_rad.push_back(stack.pattern.shifts_rad[k]);
    }
    begin += std::ssize(stack.frames);
    if (moved.frames.size() < stack.frames.size() && !determines_phase(moved)) return {};
    out.push_back(std::move(moved));
  }
  return out;
}

std::vector<FrameVerdict> judge_lag(std::span<const Pattern> patterns,
                                    const FrameLag& lag,
                                    bool may_remedy) {
  std::vector<FrameVerdict> out;
  for (const Pattern& pattern : patterns) {
    FrameVerdict one;
    FrameExplanation& found = one.explanation;
    found.pattern = pattern.name;
    found.decided = true;
    found.best = frame_hypotheses(pattern).front();
    found.best.cause = FrameCause::Late;
    found.best.faults = 1;
    found.alike = {found.best};
    found.explanation = lag.explanation;
    found.explanation.remedy = "capture the frames again with a longer delay_s of the projector";
    if (may_remedy)
      found.explanation.remedy += ", or set `accept_remedy` to decode each frame as what it shows";
    one.finding = describe(found.explanation);
    one.action = FrameAction::LeaveOutView;
    out.push_back(std::move(one));
  }
  return out;
}

std::string describe(const FrameLag& lag) {
  static constexpr std::array kFrames = {"one frame", "two frames", "three frames"};
  const char* const by = kFrames.at(static_cast<std::size_t>(std::abs(lag.frames)) - 1);
  return lag.frames > 0
             ? fmt::format(
                   "all frames are late by {}: each shows what should be seen {} before", by, by)
             : fmt::format(
                   "all frames are early by {}: each shows what should be seen {} later", by, by);
}

}  // namespace frangia
