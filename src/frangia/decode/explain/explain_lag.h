#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frangia/decode/explain/judge_frames.h"
#include "frangia/diagnose/explanation.h"
#include "frangia/frames/frame_stack.h"

namespace frangia {

/// Places that frames of a display out of step are late; early by more is no camera's fault.
inline constexpr std::array kFrameLags = {1, 2, 3, -1};

/// The part of the image that is out of step.
enum class LagPart : std::uint8_t { All, Above, Below };

/// All frames of a view show what frames before or behind them should: projector and camera are
/// out of step from the first frame on.
struct FrameLag {
  int frames = 0;               ///< places that they are late; below 0: early
  Explanation explanation{};    ///< with the lags that predict the same
  LagPart part = LagPart::All;  ///< where they are
  int row_px = 0;               ///< of the image, where that part ends or begins
};

/// Finds frames that are out of step all through a view.
///
/// Of one pattern by itself, such frames are those of another start, or with one that is lost. But
/// taken as what they show, all patterns leave no residual, and have the same mean and modulation
/// at each pixel. A lag and one that differs by a whole pattern predict the same.
///
/// @shape    the stacks in the order in which their frames were captured
/// @missing  nothing where the frames are as described, are not better so, or do not tell: for
///           fewer than two fringe patterns, or several exposures
[[nodiscard]] std::optional<FrameLag> explain_lag(std::span<const FrameStack> stacks);

/// Finds torn frames: above or below some row of the image all frames show what the frame before or
/// behind them should, in the rest they are in step, as where the display changes while the camera
/// exposes.
///
/// A lag of a part shifts the phase of all patterns there alike, so that they agree with each other
/// at a wrong place; but the frames at which the pattern changes leave a residual, or another mean
/// and modulation than those of the other patterns.
///
/// @shape    the stacks in the order in which their frames were captured
/// @missing  as `explain_lag`
[[nodiscard]] std::optional<FrameLag> explain_torn_frames(std::span<const FrameStack> stacks);

/// Finds the same as `explain_lag` for fringes beside a Gray code: moved by the lag, code and
/// fringes agree, which they do not as described.
///
/// @shape    the stacks in the order in which their frames were captured
/// @missing  nothing where code and fringes agree as described, or with no lag; for several
///           exposures, and without a Gray code beside fringes
[[nodiscard]] std::optional<FrameLag> explain_lag_by_code(std::span<const FrameStack> stacks);

/// The stacks with the frames that show them if all are late by `lag`, as far as these were
/// captured.
[[nodiscard]] std::vector<FrameStack> moved_by(std::span<const FrameStack> stacks, int lag);

/// The same, if they determine the phase. A pattern at the end of the sequence lacks some; empty if
/// what is left of it does not suffice.
[[nodiscard]] std::vector<FrameStack> in_step(std::span<const FrameStack> stacks,
                                              const FrameLag& lag);

/// The verdict on each fringe pattern of a view that is out of step: the view is left out.
/// `may_remedy`: the frames can be decoded as what they show.
[[nodiscard]] std::vector<FrameVerdict> judge_lag(std::span<const Pattern> patterns,
                                                  const FrameLag& lag,
                                                  bool may_remedy);

/// A clause: "all frames are late by one frame: each shows what should be seen one frame before".
[[nodiscard]] std::string describe(const FrameLag& lag);

}  // namespace frangia
