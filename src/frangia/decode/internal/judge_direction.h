#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "frangia/decode/explain/judge_frames.h"
#include "frangia/decode/internal/direction_maps.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/phase/temporal/check_sequence.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// The frames of a direction, each pattern explained by itself.
struct JudgedFrames {
  NoiseModel noise;                    ///< of the camera
  std::vector<FrameVerdict> verdicts;  ///< of the fringe patterns, coarse to fine
  /// All stacks of the view without the frames that are left out, and with the white level at
  /// which they are cut off; empty if they are used as they are.
  std::vector<FrameStack> stacks;
  std::map<std::string, double> unexplained_rad;  ///< of the phase, by pattern
  /// By pattern: orders of the frames that its frames do not tell apart.
  std::map<std::string, std::vector<std::vector<double>>> orders_rad;
};

/// Whether the phase may be computed from some of the frames: no algorithm needs all of them.
[[nodiscard]] bool may_leave_out(const Pattern& pattern, const DecodeOptions& options);

/// Explains the fringe patterns of a direction and leaves out the frames at fault.
[[nodiscard]] JudgedFrames judge_direction(const DirectionInput& input);

/// Reports frames that are left out. Returns the direction's check, which a pattern that measures
/// nothing in this view makes inconsistent.
[[nodiscard]] std::optional<SequenceCheck> report_frames(const std::vector<FrameVerdict>& verdicts,
                                                         std::optional<SequenceCheck> check,
                                                         const Run& run);

/// The direction's check, which a phase that is uncertain by more than 0.5 rad on half of the
/// pixels makes inconsistent: what was not explained is in its sigma.
[[nodiscard]] std::optional<SequenceCheck> report_uncertain_phase(
    const AbsolutePhase& phase, std::optional<SequenceCheck> check);

/// Reports pixels whose Gray code names columns or rows outside the projector, which are not
/// measured. Where they are most of the pixels, the code is not what scan.toml or rig.toml says,
/// and the others are right by chance: the check is inconsistent.
[[nodiscard]] std::optional<SequenceCheck> report_outside_field(const AbsolutePhase& phase,
                                                                std::optional<SequenceCheck> check,
                                                                const Run& run);

/// The check of a direction whose orders come from a pattern of one fringe, which orders by chance
/// make inconsistent: the phase of a pattern is unrelated to that of the next finer one, of which
/// some order agrees with any phase.
[[nodiscard]] std::optional<SequenceCheck> report_orders_by_chance(
    const DecodedDirection& view, std::optional<SequenceCheck> check);

}  // namespace frangia
