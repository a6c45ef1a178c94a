#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frangia/decode/explain/explain_frames.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"

namespace frangia {

/// What is done with the frames of a pattern.
enum class FrameAction {
  Use,             ///< all of them
  LeaveOutFrames,  ///< the others determine the phase, and fit
  LeaveOutView     ///< the pattern measures nothing in this view
};

/// What follows from the explanation of the frames of a pattern.
struct FrameVerdict {
  FrameExplanation explanation;           ///< of the frames
  FrameAction action = FrameAction::Use;  ///< what is done with them
  std::vector<std::size_t> left_out;      ///< frames that are left out
  /// The shifts with which all frames fit, where those of the pattern are wrong; empty otherwise.
  std::vector<double> remedy_rad;
  /// What is wrong with the frames, as a clause: "frame 2 of pattern "f" is black"; empty if
  /// nothing is.
  std::string finding{};
};

/// Whether the frames of a pattern are at fault, so that nothing is measured with them.
[[nodiscard]] bool leaves_out_view(std::span<const FrameVerdict> verdicts);

/// What may be done with frames that are at fault.
struct JudgeOptions {
  bool may_leave_out = true;  ///< the phase can be computed from some of the frames
  /// Coarser patterns or a Gray code check the phase, also if three frames remain, which leave no
  /// residual.
  bool has_other_check = false;
  /// Fringe patterns of the same view that are as described, as `explain_frames` takes them.
  std::span<const FrameStack* const> references{};
};

/// Explains the frames of a fringe pattern and decides what is used of them.
///
/// A frame that is lost, repeated, displaced, covered in part or under other light is left out if
/// those that remain determine the phase with less than twice the noise and are as described.
/// Otherwise the pattern measures nothing in this view, and neither do frames that are no fringes.
/// Where frames are covered in part and are not left out, all of them are used: the pixels that
/// contradict each other are left out.
[[nodiscard]] FrameVerdict judge_frames(const FrameStack& stack,
                                        const NoiseModel& noise,
                                        const JudgeOptions& options = {});

/// Judges the frames of a pattern the first of which shows the last frame of the pattern that was
/// captured before it: a projector that is late only where the pattern changes.
///
/// Two frames of different fringes that are equal within their noise at the pixels with fringes
/// leave no other cause, with three frames, too. Nothing where they are not equal, or dark.
[[nodiscard]] std::optional<FrameVerdict> judge_first_frame(const FrameStack& stack,
                                                            const FrameStack& before,
                                                            const NoiseModel& noise,
                                                            const JudgeOptions& options = {});

/// Whether the frames are as described, with evidence.
[[nodiscard]] bool is_sound(const FrameExplanation& found);

/// The stack without some of its frames and their shifts.
[[nodiscard]] FrameStack without_frames(const FrameStack& stack,
                                        std::span<const std::size_t> left_out);

}  // namespace frangia
