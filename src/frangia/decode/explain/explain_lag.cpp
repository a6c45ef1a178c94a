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
#include "frangia/decode/select_stacks.h"
#include "frangia/diagnose/score.h"
#include "frangia/phase/algorithm/phase_algorithm.h"

namespace frangia {
namespace {

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

/// Whether all frames have one size; those that do not are refused where they are decoded.
bool are_alike(const std::vector<Shown>& sequence) {
  return std::all_of(sequence.begin(), sequence.end(), [&](const Shown& one) {
    return width_of(*one.frame) == width_of(*sequence.front().frame) &&
           height_of(*one.frame) == height_of(*sequence.front().frame);
  });
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

/// The frames of a pattern: their places in the sequence, and the shifts that they show.
struct Placed {
  std::vector<Eigen::Index> places;
  std::vector<double> shifts_rad;
};

/// `pattern` has three frames or more.
Fitted fit(const Eigen::ArrayXXd& counts, const Placed& pattern) {
  const auto& [places, shifts_rad] = pattern;
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

/// What the patterns leave together: the median over the pixels of the mean square of residuals,
/// and of how the patterns differ in mean and modulation, over the modulation. Nothing if no two
/// patterns tell.
std::optional<double> misfit_of(const std::vector<Fitted>& fits) {
  if (fits.size() < 2) return std::nullopt;
  constexpr double kLeast_counts2 = 1.0;  // of the modulation: less is none
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(fits.front().mean.size());
  int terms = 0;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const Fitted& one = fits[i];
    if (one.rest.size() > 0) {
      sum += one.rest / one.modulation.square().max(kLeast_counts2);
      ++terms;
    }
    if (i == 0) continue;
    const Fitted& last = fits[i - 1];  // fine fringes have less contrast, by one factor
    const double factor =
        median_of(one.modulation / last.modulation.max(std::sqrt(kLeast_counts2)));
    const Eigen::ArrayXd other = factor * last.modulation;
    sum += ((one.mean - last.mean).square() + 0.5 * (one.modulation - other).square()) /
           (0.5 * (one.modulation.square() + other.square())).max(kLeast_counts2);
    ++terms;
  }
  return median_of(sum / terms);
}

/// The fringe patterns whose frames are late by `lag`, without those of fewer than three frames.
std::vector<Placed> placed_at(std::span<const FrameStack> stacks,
                              std::ptrdiff_t frames,
                              std::ptrdiff_t lag) {
  std::vector<Placed> out;
  std::ptrdiff_t begin = lag;
  for (const FrameStack& stack : stacks) {
    Placed one;
    for (std::size_t k = 0; has_fringes(stack) && k < stack.frames.size(); ++k) {
      const std::ptrdiff_t place = begin + static_cast<std::ptrdiff_t>(k);
      if (place < 0 || place >= frames) continue;
      one.places.push_back(place);
      one.shifts_rad.push_back(stack.pattern.shifts_rad[k]);
    }
    if (one.places.size() >= kFewestFrames) out.push_back(std::move(one));
    begin += std::ssize(stack.frames);
  }
  return out;
}

std::vector<Fitted> fit_all(const Eigen::ArrayXXd& counts, const std::vector<Placed>& patterns) {
  std::vector<Fitted> out;
  for (const Placed& one : patterns)
    out.push_back(fit(counts, one));
  return out;
}

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
  const Eigen::ArrayXXd counts = lit_counts(sequence);
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
  return leaves_phases(stacks, lag.frames) ? moved_by(stacks, lag.frames)
                                           : std::vector<FrameStack>{};
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
    found.explanation.remedy =
        lag.frames > 0 ? "capture the frames again with a longer delay_s of the projector"
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
  static constexpr std::array kFrames = {"one frame", "two frames", "three frames"};
  const char* const by = kFrames.at(static_cast<std::size_t>(std::abs(lag.frames)) - 1);
  return lag.frames > 0
             ? fmt::format(
                   "all frames are late by {}: each shows what should be seen {} before", by, by)
             : fmt::format(
                   "all frames are early by {}: each shows what should be seen {} later", by, by);
}

}  // namespace frangia
