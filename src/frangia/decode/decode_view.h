#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/decode/decode_options.h"
#include "frangia/decode/explain/judge_frames.h"
#include "frangia/decode/plan_decoding.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/png.h"
#include "frangia/fringe_order/resolve_regions.h"
#include "frangia/phase/temporal/sequence_check.h"
#include "frangia/phase/waveform/assess_frames.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/range/laser_profile.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// The phase of one view and the intermediate results.
struct DecodedView {
  NoiseModel noise;  ///< noise of the camera: from rig.toml, the survey or the frames
  Pattern coarsest;  ///< the coarsest fringe pattern
  /// Those of `second_phase` first; each direction coarse to fine; empty unless `keep_maps`.
  std::vector<WrappedPhase> wrapped;
  std::vector<FrameAssessment> assessments;  ///< one per fringe pattern, in the same order
  std::optional<RelativePhase> relative;     ///< of a spatially unwrapped scan
  std::vector<ProfilePoint> profile;         ///< of the laser sheet, where the scan has one
  AbsolutePhase phase;                       ///< of the finest fringes
  /// Of the finest horizontal fringes, where `phase` is that of vertical ones and both were
  /// decoded.
  std::optional<AbsolutePhase> second_phase;
  /// Comparison of the patterns with each other: one per decoded direction, that of `phase` first.
  std::vector<SequenceCheck> checks;
  /// What explains the frames of the fringe patterns, coarse to fine, of the direction of `phase`
  /// first; empty where frames are merged from several exposures.
  std::vector<FrameVerdict> frames;
  std::vector<UnresolvedRegion> unresolved;  ///< regions without a fringe order
  Image<Rgb> color;                          ///< of each pixel; empty unless `colors` asks for it
};

/// Computes the absolute phase of one view from its frames, as `plan` says.
///
/// The patterns of each direction are compared with each other; `checks` holds the result, and the
/// caller decides whether a phase that does not fit is used.
///
/// @shape    `stacks` as read_frames returns them, of the patterns of `plan`; `rays` as
///           rays_of(rig.reference().model), or empty for a rig without geometry
/// @units    rad, counts
/// @missing  NaN in a phase; `status` gives the reason
/// @errors   Error(Input) when a function of `options.own` returns images of another size, or when
///           the stacks are not those of the plan
[[nodiscard]] DecodedView decode_view(std::span<const FrameStack> stacks,
                                      const DecodePlan& plan,
                                      const Rig& rig,
                                      const Image<Eigen::Vector2f>& rays,
                                      const DecodeOptions& options = {},
                                      const Run& run = {});

/// Computes the same for frames of which there is one view only: plans from the patterns of its
/// stacks.
///
/// @errors   as above, and as `plan_decoding`
[[nodiscard]] DecodedView decode_view(std::span<const FrameStack> stacks,
                                      const Rig& rig,
                                      const Image<Eigen::Vector2f>& rays,
                                      const DecodeOptions& options = {},
                                      const Run& run = {});

}  // namespace frangia
