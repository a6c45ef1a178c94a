#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/fringe_order/resolve_regions.h"
#include "frangia/phase/assess_frames.h"
#include "frangia/phase/fill_enclosed.h"
#include "frangia/phase/phase_map.h"
#include "frangia/phase/unwrap_spatially.h"
#include "frangia/phase/unwrap_temporally.h"
#include "frangia/phase/wrap_phase.h"
#include "frangia/pipeline/survey_scan.h"
#include "frangia/range/laser_profile.h"
#include "frangia/rig/rig.h"

namespace frangia {

struct DecodeOptions {
  std::string algorithm = "auto";  ///< see `fit_algorithm`
  /// Recover the one saturated frame of four, instead of discarding the pixel as the paper does.
  bool recover_saturated = false;
  /// Of a projector that showed the patterns without its look-up table: undone in the phase.
  std::optional<ResponseCurve> response;
  /// Keep the wrapped maps. Without them a sequence is decoded in one pass over its frames, where
  /// its steps are safe for all pixels that `wrap` keeps.
  bool keep_maps = true;
  ScanSurvey survey;  ///< what the other views say, too
  WrapOptions wrap;
  TemporalUnwrapOptions temporal;
  SpatialUnwrapOptions spatial;
  LaserProfileOptions line;
  FringeOrderOptions fringe_order;
  FillOptions fill;
};

/// Everything that the frames of one view say about its phase, stage by stage.
struct DecodedView {
  NoiseModel noise;
  Pattern coarsest;                          ///< of the fringes
  std::vector<WrappedPhase> wrapped;         ///< coarse to fine; empty where they were not kept
  std::vector<FrameAssessment> assessments;  ///< of the frames, one a wrapped phase
  std::optional<RelativePhase> relative;     ///< of a scan that is unwrapped in space
  std::vector<ProfilePoint> profile;         ///< of a scan with the laser sheet
  AbsolutePhase phase;                       ///< of the finest fringes
  std::vector<UnresolvedRegion> unresolved;  ///< regions whose fringe is not known yet
};

/// Frames to absolute phase: unwrapped in time from an absolute pattern where there is one, else in
/// space, the whole number of fringes from the laser sheet, or, with neither, from where the
/// axes of camera and projector come together.
///
/// errors   Error(Input) when no pattern holds fringes
[[nodiscard]] DecodedView decode_view(std::span<const FrameStack> stacks,
                                      const Rig& rig,
                                      const Image<Eigen::Vector2f>& rays,
                                      const DecodeOptions& options = {},
                                      const Run& run = {});

/// Whether the scan's phase can be told from its patterns alone: it holds an absolute pattern or
/// the laser sheet. If not, a reconstruction is relative to the fringe through the projection
/// axis.
[[nodiscard]] bool has_absolute_phase(std::span<const Pattern> patterns,
                                      const Projector& projector);

}  // namespace frangia
