#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/decode/decode_view.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/algorithm/fit_algorithm.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// The frames of a view and how one direction of it is decoded.
struct DirectionInput {
  std::span<const FrameStack> stacks;  ///< all of the view, also those of the other direction
  const DirectionPlan& plan;
  const Rig& rig;
  const Image<Eigen::Vector2f>& rays;
  const DecodeOptions& options;
  const Run& run;
  NoiseModel noise{};  ///< of the camera
  /// Uncertainty of the phase by what nothing explains in the frames of a pattern, by its name.
  std::map<std::string, double> unexplained_rad{};
  /// Equal explanations of the frames of a pattern, as `SequenceFrames::orders_rad`, by its name.
  std::map<std::string, std::vector<std::vector<double>>> orders_rad{};
};

/// The fringes of one direction, the algorithms that fit their frames, and what they show.
struct DirectionMaps {
  std::vector<const FrameStack*> fringes;  ///< coarse to fine, each at its first exposure
  std::vector<FittedAlgorithm> fits;       ///< one for each of the fringes
  DecodedDirection view;                   ///< its phase is still open
};

/// What wrapping keeps of each map.
enum class WrappedParts {
  All,       ///< phase, noise, modulation and mean
  PhaseOnly  ///< phase and noise: the memory of the others serves the next pattern
};

/// Selects the fringes and fits their algorithms. Nothing is wrapped.
///
/// @errors   Error(Input) when the stacks are not those of the plan
[[nodiscard]] DirectionMaps fit_maps(const DirectionInput& input);

/// Adds the wrapped maps, their assessments and their comparison with each other.
[[nodiscard]] DirectionMaps wrap_maps(const DirectionInput& input,
                                      DirectionMaps fitted,
                                      WrappedParts parts = WrappedParts::All);

/// Removes the error of the phase of `maps` that the blur of the camera makes where the brightness
/// changes or the surface bends, if two of its patterns, or its fringes and a Gray code, show how
/// wide it is, and else that of the area of the pixels.
void undo_blur(const DirectionInput& input, DirectionMaps& maps);

/// Whether the frames can be decoded in one pass: nothing but their algorithms is applied to them,
/// and nobody asks for the maps.
[[nodiscard]] bool allow_one_pass(const DirectionInput& input, const DirectionMaps& fitted);

/// Decodes all patterns in one pass, without maps; the assessments are computed from a sample of
/// rows.
[[nodiscard]] DirectionMaps decode_in_one_pass(const DirectionInput& input, DirectionMaps fitted);

}  // namespace frangia
