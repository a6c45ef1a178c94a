#pragma once

#include <functional>
#include <span>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/algorithm/fit_algorithm.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Functions of the caller that replace stages of `decode_view`; an empty one leaves the stage as
/// it is. They are called one at a time, on any thread; what they throw leaves `decode_view`.
struct OwnStages {
  /// Wraps the frames of one pattern, with the algorithm that fits them at hand. Where the result
  /// holds a systematic part, it is kept.
  std::function<WrappedPhase(const FrameStack&, const FittedAlgorithm&, const NoiseModel&)> wrap;
  /// Unwraps a map in space. Each region keeps an unknown whole number of fringes, which the laser
  /// sheet, other views or the distance determine afterwards.
  std::function<RelativePhase(const WrappedPhase&)> unwrap_spatially;
  /// Computes the absolute phase of the finest fringes from the maps of one direction, coarse to
  /// fine. It takes precedence over Gray code, temporal and spatial unwrapping.
  std::function<AbsolutePhase(std::span<const WrappedPhase>)> unwrap;

  /// Whether a stage is replaced that needs whole maps.
  [[nodiscard]] bool any() const { return wrap || unwrap_spatially || unwrap; }
};

}  // namespace frangia
