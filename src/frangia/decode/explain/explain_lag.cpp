#include "frangia/decode/explain/explain_lag.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <utility>

#include <Eigen/Core>
#include <fmt/format.h>

#include "frangia/decode/explain/internal/decided_fault.h"
#include "frangia/decode/explain/internal/frame_priors.h"
#include "frangia/decode/explain/internal/frame_sequence.h"
#include "frangia/decode/select_stacks.h"
#include "frangia/diagnose/score.h"

namespace frangia {
namespace {

constexpr std::size_t kFewestPixels = 200;
/// RMS over the modulation of what blur, texture and harmonics leave of frames in step.
constexpr double kRestInStep = 0.03;
/// The same of frames out of step at least.
constexpr double kOutOfStep = 0.1;
/// What a lag leaves of the mean square at most: the patterns that it concerns are not all the
/// same.
constexpr double kMostLeft = 0.5;

/// The frames of one pattern with a fault: two of them exchanged, or one left out.
std::vector<Placed> with_one_fault(const Placed& pattern) {
  std::vector<Placed> out;
  for (std::size_t i = 0; i < pattern.places.size(); ++i) {
    for (std::size_t k = i + 1; k < pattern.places.size(); ++k) {
      out.push_back(pattern);
      std::swap(out.back().shifts_rad[i], out.back().shifts_rad[k]);
    }
    if (pattern.places.size() == kFewestFrames) continue;
    out.push_back(pattern);
    out.back().places.erase(out.back().places.begin() + static_cast<std::ptrdiff_t>(i));
    out.back().shifts_rad.erase(out.back().shifts_rad.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return out;
}

/// What the patterns leave as they are described, or with one fault of one of them, where that is
/// less.
double misfit_without_lag(const Eigen::ArrayXXd& counts,
                          const std::vector<Placed>& patterns,
                          double described) {
  std::vector<Fitted> fits = fit_all(counts, patterns);
  double least = described;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    Fitted own = fits[i];
    for (const Placed& other : with_one_fault(patterns[i])) {
      fits[i] = fit(counts, other);
      least = std::min(least, misfit_of(fits).value_or(described));
    }
    fits[i] = std::move(own);
  }
  return least;
}

/// Whether the frames of each pattern are in the sequence, or enough of them for a phase.
bool leaves_phases(std::span<const FrameStack> stacks, int lag) {
  std::ptrdiff_t all = 0;
  for (const FrameStack& stack : stacks)
    all += std::ssize(stack.frames);
  std::ptrdiff_t begin = lag;
  for (const FrameStack& stack : stacks) {
    const std::ptrdiff_t end = begin + std::ssize(stack.frames);
    const std::ptrdiff_t left = std::min(end, all) - std::max<std::ptrdiff_t>(begin, 0);
    const auto least =
        has_fringes(stack) ? std::ptrdiff_t{kFewestFrames} : std::ssize(stack.frames);
    if (left < least) return false;
    begin = end;
  }
  return true;
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
  const std::vector<Shown> sequence = sequence_of(stacks);
  if (fringes < 2 || are_bracketed(stacks) || !are_alike(sequence)) return std::nullopt;
  const Eigen::ArrayXXd counts = lit_counts(sequence).counts;
  if (counts.rows() < static_cast<Eigen::Index>(kFewestPixels)) return std::nullopt;
  const auto frames_in_all = counts.cols();
  const std::vector<Placed> in_place = placed_at(stacks, frames_in_all, 0);
  const std::optional<double> described = misfit_of(fit_all(counts, in_place));
  if (!described || *described < kOutOfStep * kOutOfStep) return std::nullopt;
  const double without_lag = misfit_without_lag(counts, in_place, *described);
  if (without_lag < kOutOfStep * kOutOfStep) return std::nullopt;
  // Gaussian rests of unknown size, that are one smooth field each.
  const auto evidence = [](double misfit) {
    return -0.5 * kFieldWitnesses * std::log(misfit + kRestInStep * kRestInStep);
  };
  std::vector<FrameLag> lags{{}};
  std::vector<ScoredHypothesis> scored{{"the frames are as described", evidence(without_lag)}};
  for (const int frames : kFrameLags) {
    if (predict_alike(frames, 0, stacks)) continue;
    const std::optional<double> misfit =
        misfit_of(fit_all(counts, placed_at(stacks, frames_in_all, frames)));
    if (!misfit || *misfit > kMostLeft * without_lag) continue;
    lags.push_back({frames});
    std::size_t alike = 1;
    while (!predict_alike(lags[alike].frames, frames, stacks))
      ++alike;
    const double price = price_of_choice(kFrameLags.size()) - std::log(kPriorFault);
    scored.push_back(
        {describe(lags.back()), evidence(*misfit) - price, std::sqrt(*misfit), {}, alike});
  }
  const Explanation found = choose(scored);
  if (!found.is_decided() || found.likeliest == 0) return std::nullopt;
  // Of those that predict the same, one that leaves a phase of all patterns.
  FrameLag best = lags[found.likeliest];
  for (std::size_t i = 1; i < lags.size() && !leaves_phases(stacks, best.frames); ++i)
    if (scored[i].prediction == scored[found.likeliest].prediction &&
        scored[i].log_evidence > scored[found.likeliest].log_evidence - kNamedLogOdds)
      best = lags[i];
  best.explanation = found;
  return best;
}

std::vector<FrameStack> moved_by(std::span<const FrameStack> stacks, int lag) {
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
      const std::ptrdiff_t place = begin + static_cast<std::ptrdiff_t>(k) + lag;
      if (place < 0 || place >= std::ssize(sequence)) continue;
      moved.frames.push_back(*sequence[static_cast<std::size_t>(place)].frame);
      if (has_fringes(stack)) moved.pattern.shifts_rad.push_back(stack.pattern.shifts_rad[k]);
    }
    begin += std::ssize(stack.frames);
    out.push_back(std::move(moved));
  }
  return out;
}

std::vector<FrameStack> in_step(std::span<const FrameStack> stacks, const FrameLag& lag) {
  return lag.part == LagPart::All && leaves_phases(stacks, lag.frames)
             ? moved_by(stacks, lag.frames)
             : std::vector<FrameStack>{};
}

std::vector<FrameVerdict> judge_lag(std::span<const Pattern> patterns,
                                    const FrameLag& lag,
                                    bool may_remedy) {
  std::vector<FrameVerdict> out;
  for (const Pattern& pattern : patterns) {
    FrameVerdict one;
    FrameExplanation& found = one.explanation;
    found = decided_fault(pattern, FrameCause::Late);
    found.explanation = lag.explanation;
    found.explanation.remedy =
        lag.frames > 0 && lag.part == LagPart::All
            ? "capture the frames again with a longer delay_s of the projector"
            : "capture the frames again, the projector and the camera in step";
    if (may_remedy)
      found.explanation.remedy += ", or set `accept_remedy` to decode each frame as what it shows";
    one.finding = describe(found.explanation);
    one.action = FrameAction::LeaveOutView;
    out.push_back(std::move(one));
  }
  return out;
}

std::string describe(const FrameLag& lag) {
  if (lag.part == LagPart::Above) {
    return lag.frames > 0
               ? fmt::format(
                     "the frames are torn at about row {}: above it each shows what should "
                     "be seen one frame before",
                     lag.row_px)
               : fmt::format(
                     "the frames are torn at about row {}: above it each shows what should "
                     "be seen one frame later",
                     lag.row_px);
  }
  if (lag.part == LagPart::Below) {
    return lag.frames > 0
               ? fmt::format(
                     "the frames are torn at about row {}: below it each shows what should "
                     "be seen one frame before",
                     lag.row_px)
               : fmt::format(
                     "the frames are torn at about row {}: below it each shows what should "
                     "be seen one frame later",
                     lag.row_px);
  }
  static constexpr std::array kFrames = {"one frame", "two frames", "three frames"};
  const char* const by = kFrames.at(static_cast<std::size_t>(std::abs(lag.frames)) - 1);
  return lag.frames > 0
             ? fmt::format(
                   "all frames are late by {}: each shows what should be seen {} before", by, by)
             : fmt::format(
                   "all frames are early by {}: each shows what should be seen {} later", by, by);
}

}  // namespace frangia
