#include "frangia/decode/explain/judge_frames.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frangia/decode/explain/internal/frame_design.h"

namespace frangia {
namespace {

/// The frames that a fault makes useless; none where the fault is one of all frames.
std::vector<std::size_t> useless_frames(const FrameHypothesis& fault) {
  switch (fault.cause) {
    case FrameCause::Lost:
    case FrameCause::Repeated:
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
    case FrameCause::AsDescribed:
    case FrameCause::Exchanged:
    case FrameCause::Late:
    case FrameCause::Moved:
    case FrameCause::Steps:
    case FrameCause::Start:
    case FrameCause::Direction:
    case FrameCause::Unexplained:
      return {};
  }
  return fault.frames;
}

/// Whether frames with these shifts determine the phase with at most twice the noise of as many
/// equal steps.
bool determine_phase(const std::vector<double>& shifts_rad) {
  constexpr std::size_t kLeast = 3;
  constexpr double kMostNoise = 2.0;
  if (shifts_rad.size() < kLeast) return false;
  const auto frames = shifts_rad.size();
  const FrameDesign design = design_of({.frames = {},
                                        .shifts_rad = shifts_rad,
                                        .gains = std::vector<double>(frames, 1.0),
                                        .free = std::vector<bool>(frames, false),
                                        .lamp_on = {},
                                        .path = {}});
  if (design.inverse.size() == 0) return false;
  const double noise = std::sqrt(0.5 * design.inverse.bottomRows(2).squaredNorm());
  return noise <= kMostNoise * std::sqrt(2.0 / static_cast<double>(frames));
}

bool is_sound(const FrameExplanation& found) {
  return found.decided && found.best.cause == FrameCause::AsDescribed && found.are_fringes;
}

std::string of_pattern(const FrameExplanation& found) {
  return fmt::format("pattern \"{}\": {}", found.pattern, describe(found.explanation));
}

}  // namespace

bool leaves_out_view(std::span<const FrameVerdict> verdicts) {
  return std::any_of(verdicts.begin(), verdicts.end(), [](const FrameVerdict& one) {
    return one.action == FrameAction::LeaveOutView;
  });
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
  FrameVerdict out;
  out.explanation = explain_frames(stack, noise);
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
  out.action = FrameAction::LeaveOutView;
  constexpr std::size_t kFewSteps = 4;  // show some combinations of the errors of their steps alone
  if (found.explanation.best.size() == 1 &&
      (found.best.cause == FrameCause::Exchanged || found.best.cause == FrameCause::Late ||
       (found.best.cause == FrameCause::Steps && stack.frames.size() > kFewSteps)) &&
      found.best.faults == 1) {
    FrameStack remedied = stack;
    remedied.pattern.shifts_rad = found.best.shifts_rad;
    if (is_sound(explain_frames(remedied, noise))) out.remedy_rad = found.best.shifts_rad;
  }
  out.left_out = useless_frames(found.best);
  // Hypotheses that predict alike but blame other frames do not say which one to leave out.
  if (out.left_out.empty() || found.explanation.best.size() > 1 || !options.may_leave_out) {
    out.left_out.clear();
    return out;
  }
  const FrameStack rest = without_frames(stack, out.left_out);
  constexpr std::size_t kWithoutResidual = 3;
  const bool checked = rest.frames.size() > kWithoutResidual || options.has_other_check;
  if (checked && determine_phase(rest.pattern.shifts_rad)) {
    const FrameExplanation again = explain_frames(rest, noise);
    if (is_sound(again)) {
      out.action = FrameAction::LeaveOutFrames;
      out.explanation.unexplained_rad = again.unexplained_rad;
      return out;
    }
  }
  out.left_out.clear();
  return out;
}

}  // namespace frangia
