#include "frangia/decode/explain/judge_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/statistics.h"
#include "frangia/decode/explain/internal/decided_fault.h"
#include "frangia/decode/explain/internal/frame_design.h"
#include "frangia/decode/explain/internal/frame_sample.h"
#include "frangia/decode/explain/internal/score_frames.h"

namespace frangia {
namespace {

/// The frames that a fault makes useless; none where the fault is one of all frames.
std::vector<std::size_t> useless_frames(const FrameHypothesis& fault) {
  switch (fault.cause) {
    case FrameCause::Lost:
    case FrameCause::Repeated:
    case FrameCause::Covered:
    case FrameCause::Displaced:
    case FrameCause::Gain:
      break;
    case FrameCause::Lamp: {  // the smaller part of the set
      std::vector<std::size_t> out;
      const std::size_t frames = fault.shifts_rad.size();
      const std::size_t on = fault.lamp_on.value_or(frames);
      if (fault.lamp_off <= frames) return fault.frames;
      const bool later = 2 * on >= frames;
      for (std::size_t k = later ? on : 0; k < (later ? frames : on); ++k)
        out.push_back(k);
      return out;
    }
    case FrameCause::Moved:  // before the last frame; behind the first one, the others see it moved
      if (displaced_alone(fault) == fault.shifts_rad.size() - 1)
        return {fault.shifts_rad.size() - 1};
      return {};
    case FrameCause::AsDescribed:
    case FrameCause::Exchanged:
    case FrameCause::Sorted:
    case FrameCause::Exposure:
    case FrameCause::Late:
    case FrameCause::Steps:
    case FrameCause::Start:
    case FrameCause::Direction:
    case FrameCause::Unexplained:
      return {};
  }
  return fault.frames;
}

/// The frames that all hypotheses of a class make useless; none where they blame different ones, so
/// that nothing says which to leave out.
std::vector<std::size_t> useless_frames(const FrameExplanation& found) {
  std::vector<std::size_t> out = useless_frames(found.best);
  for (const FrameHypothesis& one : found.alike)
    if (useless_frames(one) != out) return {};
  return out;
}

/// Whether mean, modulation and phase that these frames have by a hypothesis are those of other
/// patterns, at nearly all pixels. Three frames have no other check of themselves.
bool agree_with(std::span<const FrameStack* const> references,
                const FrameStack& stack,
                const NoiseModel& noise,
                const FrameHypothesis& hypothesis) {
  if (references.empty()) return true;
  constexpr double kMost = 0.15;  // of the pixels; depth edges and indirect light are fewer
  const FrameSample sample = sample_blocks(stack, noise, references);
  if (sample.counts.rows() == 0) return true;
  const FrameScore score = score_frames(sample, hypothesis);
  if (score.reference_gains.size() == 0) return true;
  return (score.reference_gains < 0.0).cast<double>().mean() < kMost;
}

bool agree_as_described(std::span<const FrameStack* const> references,
                        const FrameStack& stack,
                        const NoiseModel& noise) {
  return agree_with(references, stack, noise, frame_hypotheses(stack.pattern).front());
}

std::string of_pattern(const FrameExplanation& found) {
  return fmt::format("pattern \"{}\": {}", found.pattern, describe(found.explanation));
}

/// Whether the frames that remain without some determine the phase, are as described, and agree
/// with other patterns; then `again` is what explains them.
bool remain_sound(const FrameStack& rest,
                  const NoiseModel& noise,
                  const JudgeOptions& options,
                  FrameExplanation& again) {
  constexpr std::size_t kWithoutResidual = 3;
  const bool checked = rest.frames.size() > kWithoutResidual || options.has_other_check;
  if (!checked || !determine_phase(rest.pattern.shifts_rad)) return false;
  again = explain_frames(rest, noise, options.references);
  return is_sound(again) && agree_as_described(options.references, rest, noise);
}

/// Whether a fault is one of some frames, which others might show instead.
bool blames_frames(FrameCause cause) {
  return cause == FrameCause::Lost || cause == FrameCause::Covered ||
         cause == FrameCause::Displaced || cause == FrameCause::Gain || cause == FrameCause::Lamp ||
         cause == FrameCause::Unexplained;
}

/// Names the only frame without which the others are as described and agree with other patterns.
/// The frames that the verdict blames do not: without any such frame its cause is refuted.
void judge_by_references(const FrameStack& stack,
                         const NoiseModel& noise,
                         const JudgeOptions& options,
                         FrameVerdict& verdict) {
  std::vector<std::size_t> named;
  FrameExplanation of_rest;
  for (std::size_t k = 0; k < stack.frames.size(); ++k) {
    FrameExplanation again;
    if (!remain_sound(without_frames(stack, std::array{k}), noise, options, again)) continue;
    named.push_back(k);
    of_rest = std::move(again);
  }
  FrameExplanation& found = verdict.explanation;
  if (named.size() != 1) {
    if (!found.has_fault()) return;
    found.best.cause = FrameCause::Unexplained;
    found.best.frames.clear();
    found.explanation.second = std::exchange(found.explanation.best, {describe(found.best)});
    found.explanation.log_odds = 0.0;
    verdict.finding = fmt::format(
        "pattern \"{}\": the frames contradict each other and the other patterns, and no known "
        "cause "
        "explains it",
        found.pattern);
    found.explanation.remedy =
        "check that the frames are those of this pattern, and that nothing moved";
    verdict.action = FrameAction::LeaveOutView;
    return;
  }
  found.best.cause = FrameCause::Lost;
  found.best.frames = named;
  found.explanation.second = std::exchange(
      found.explanation.best,
      {fmt::format("frame {} shows something else than the other frames and the other patterns",
                   named.front())});
  found.unexplained_rad = of_rest.unexplained_rad;
  found.explanation.remedy = "capture the frames again, the projector and the camera in step";
  verdict.finding =
      fmt::format("pattern \"{}\": {}", found.pattern, found.explanation.best.front());
  verdict.left_out = named;
  verdict.action = FrameAction::LeaveOutFrames;
}

/// Judges the frames by the explanation that the options allow.
FrameVerdict judge_by_evidence(const FrameStack& stack,
                               const NoiseModel& noise,
                               const JudgeOptions& options) {
  FrameVerdict out;
  out.explanation = explain_frames(stack, noise, options.references);
  const FrameExplanation& found = out.explanation;
  if (!found.decided) return out;
  if (!found.are_fringes) {
    out.finding = fmt::format(
        "pattern \"{}\": the frames show no fringes with its shifts, and no known cause explains "
        "them; {}",
        found.pattern,
        "check that they are the frames of this pattern, and that nothing moved");
    out.action = FrameAction::LeaveOutView;
    return out;
  }
  if (!found.has_fault()) return out;
  out.finding = of_pattern(found);
  out.action =
      found.best.cause == FrameCause::Covered ? FrameAction::Use : FrameAction::LeaveOutView;
  constexpr std::size_t kFewSteps = 4;  // show some combinations of the errors of their steps alone
  if (found.explanation.best.size() == 1 &&
      (found.best.cause == FrameCause::Exchanged || found.best.cause == FrameCause::Late ||
       found.best.cause == FrameCause::Sorted ||
       (found.best.cause == FrameCause::Steps &&
        (stack.frames.size() > kFewSteps || !found.best.has_free_steps))) &&
      found.best.faults == 1) {
    FrameStack remedied = stack;
    remedied.pattern.shifts_rad = found.best.shifts_rad;
    if (is_sound(explain_frames(remedied, noise, options.references)))
      out.remedy_rad = found.best.shifts_rad;
  }
  out.left_out = useless_frames(found);
  if (out.left_out.empty() || !options.may_leave_out) {
    out.left_out.clear();
    return out;
  }
  FrameExplanation again;
  if (remain_sound(without_frames(stack, out.left_out), noise, options, again)) {
    out.action = FrameAction::LeaveOutFrames;
    out.explanation.unexplained_rad = again.unexplained_rad;
    return out;
  }
  out.left_out.clear();
  return out;
}

/// Whether a frame shows another one again, as far as noise tells, where a stack has fringes.
bool shows_again(const FrameStack& stack,
                 const Frame& frame,
                 const Frame& other,
                 const NoiseModel& noise) {
  constexpr int kStride = 3;
  constexpr double kSigmas = 8.0;
  constexpr std::size_t kFewest = 200;  // pixels
  constexpr double kMostDiffering = 2.0;
  constexpr double kLeastBright = 0.25;  // of the pixels: else both are dark
  std::vector<double> squares;
  double bright = 0.0;
  for (int y = 0; y < height_of(frame); y += kStride) {
    for (int x = 0; x < width_of(frame); x += kStride) {
      int least = stack.white_level;
      int most = 0;
      for (const Frame& one : stack.frames) {
        least = std::min(least, counts_at(one, x, y));
        most = std::max(most, counts_at(one, x, y));
      }
      const double variance = noise.variance(0.5 * (least + most));
      const double change = kSigmas * std::sqrt(variance);
      if (most >= stack.white_level || most - least < change) continue;
      const double difference = counts_at(frame, x, y) - counts_at(other, x, y);
      squares.push_back(difference * difference / (2.0 * variance));
      if (counts_at(frame, x, y) - least > change) bright += 1.0;
    }
  }
  return squares.size() >= kFewest && bright > kLeastBright * static_cast<double>(squares.size()) &&
         median(squares) < kMostDiffering;
}

}  // namespace

std::optional<FrameVerdict> judge_first_frame(const FrameStack& stack,
                                              const FrameStack& before,
                                              const NoiseModel& noise,
                                              const JudgeOptions& options) {
  const Frame& first = stack.frames.front();
  const Frame& last = before.frames.back();
  if (width_of(first) != width_of(last) || height_of(first) != height_of(last)) return std::nullopt;
  if (!shows_again(stack, first, last, noise)) return std::nullopt;
  FrameVerdict out;
  FrameExplanation& found = out.explanation;
  found = decided_fault(stack.pattern, FrameCause::Repeated, {0});
  found.explanation.best = {
      fmt::format("frame 0 shows the last frame of pattern \"{}\"", before.pattern.name)};
  found.explanation.second = {"the frames are as described"};
  constexpr double kCertain = 30.0;  // of hundreds of pixels
  found.explanation.log_odds = kCertain;
  found.explanation.remedy = "capture the frames again, the projector and the camera in step";
  out.finding = fmt::format("pattern \"{}\": {}", found.pattern, found.explanation.best.front());
  out.action = FrameAction::LeaveOutView;
  const FrameStack rest = without_frames(stack, std::array{std::size_t{0}});
  FrameExplanation again;
  const bool remains = remain_sound(rest, noise, options, again) ||
                       (!again.decided && again.pattern == rest.pattern.name);
  if (options.may_leave_out && remains) {
    out.left_out = {0};
    out.action = FrameAction::LeaveOutFrames;
    found.unexplained_rad = again.unexplained_rad;
  }
  return out;
}

bool leaves_out_view(std::span<const FrameVerdict> verdicts) {
  return std::any_of(verdicts.begin(), verdicts.end(), [](const FrameVerdict& one) {
    return one.action == FrameAction::LeaveOutView;
  });
}

bool is_sound(const FrameExplanation& found) {
  return found.decided && found.best.cause == FrameCause::AsDescribed && found.are_fringes;
}

FrameStack without_frames(const FrameStack& stack, std::span<const std::size_t> left_out) {
  FrameStack out = stack;
  out.frames.clear();
  out.pattern.shifts_rad.clear();
  for (std::size_t k = 0; k < stack.frames.size(); ++k) {
    if (std::find(left_out.begin(), left_out.end(), k) != left_out.end()) continue;
    out.frames.push_back(stack.frames[k]);
    out.pattern.shifts_rad.push_back(stack.pattern.shifts_rad[k]);
  }
  return out;
}

FrameVerdict judge_frames(const FrameStack& stack,
                          const NoiseModel& noise,
                          const JudgeOptions& options) {
  JudgeOptions alone = options;
  alone.references = {};
  FrameVerdict out = judge_by_evidence(stack, noise, alone);
  if (options.references.empty() || !out.explanation.decided || is_sound(out.explanation))
    return out;
  // What the frames that remain predict of the other patterns confirms the cause.
  if (out.action == FrameAction::LeaveOutFrames &&
      agree_as_described(options.references, without_frames(stack, out.left_out), noise))
    return out;
  out = judge_by_evidence(stack, noise, options);
  const bool isolated = out.action == FrameAction::LeaveOutFrames ||
                        (out.action == FrameAction::Use && out.explanation.has_fault());
  // Or the model of the cause itself agrees with them: no frame is left that a lamp has not lit.
  if (!isolated && out.explanation.has_fault() &&
      agree_with(options.references, stack, noise, out.explanation.best))
    return out;
  constexpr std::size_t kOneMore = 4;  // than three, of which none can be left out to see
  if (!isolated && options.may_leave_out && out.explanation.decided &&
      stack.frames.size() >= kOneMore && blames_frames(out.explanation.best.cause))
    judge_by_references(stack, noise, options, out);
  return out;
}

}  // namespace frangia
