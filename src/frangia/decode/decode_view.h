#pragma once

#include <optional>
#include <span>
#include <string>
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
#include "frangia/phase/blur/estimate_blur.h"
#include "frangia/phase/temporal/check_sequence.h"
#include "frangia/phase/waveform/assess_frames.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/range/laser_profile.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// One direction of fringes of a view: its phase and the intermediate results.
struct DecodedDirection {
  NoiseModel noise;                   ///< of the camera: from rig.toml, survey or frames
  Pattern coarsest;                   ///< the coarsest fringe pattern
  std::vector<WrappedPhase> wrapped;  ///< coarse to fine; empty unless `keep_maps`
  /// The wrapped maps at every `thinning_px`-th pixel along both axes, beginning with pixel (0, 0),
  /// coarse to fine. They are kept always.
  std::vector<WrappedPhase> thinned;
  int thinning_px = 4;                       ///< pixels from one of `thinned` to the next
  std::vector<FrameAssessment> assessments;  ///< one per fringe pattern, in the same order
  std::optional<RelativePhase> relative;     ///< of a spatially unwrapped scan
  std::vector<ProfilePoint> profile;         ///< of the laser sheet, where the scan has one
  AbsolutePhase phase;                       ///< of the finest fringes
  std::optional<ImageBlur> blur;             ///< of the camera, for which `phase` was corrected
  std::optional<SequenceCheck> check;        ///< of the patterns with each other; none without maps
  /// What explains the frames of the fringe patterns, coarse to fine; empty where frames are merged
  /// from several exposures.
  std::vector<FrameVerdict> frames;
  std::vector<UnresolvedRegion> unresolved;  ///< regions without a fringe order
};

/// The directions of fringes of one view.
struct DecodedView {
  /// In the order of the plan: the one that later stages refer to first.
  std::vector<DecodedDirection> directions = std::vector<DecodedDirection>(1);
  Image<Rgb> color;  ///< of each pixel; empty unless `colors` asks for it
};

/// The blur of the camera's image that a direction was corrected for, sigma in px; 0 where none
/// was.
[[nodiscard]] double blur_px_of(const DecodedView& view);

/// The assessments of all directions, each coarse to fine, those of the first direction last.
[[nodiscard]] std::vector<FrameAssessment> assessments_of(const DecodedView& view);

/// The same without the directions whose frames are at fault, so that nothing is measured with
/// them.
[[nodiscard]] std::vector<FrameAssessment> assessments_of_used(const DecodedView& view);

/// What is corrected in the phases of a view, a clause for each.
[[nodiscard]] std::vector<std::string> corrections_of(const DecodedView& view);

/// What the patterns of the directions do not fit, as `describe` says it; empty if all fits.
[[nodiscard]] std::string misfit_of(const DecodedView& view);

/// Computes the absolute phase of one view from its frames, as `plan` says.
///
/// The patterns of each direction are compared with each other; `check` holds the result, and the
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
