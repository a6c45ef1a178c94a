#pragma once

#include <span>

#include "frangia/core/missing.h"
#include "frangia/phase/waveform/assess_frames.h"

namespace frangia {

/// The quality of the fringe frames of a view: of each measure the worst of its patterns.
///
/// @units    shares of 1
/// @missing  NaN where the view has no fringe frames
struct ViewQuality {
  double contrast = kMissing;         ///< lowest median of modulation over mean
  double measured_share = kMissing;   ///< lowest share of pixels with a phase modulo 2 pi
  double saturated_share = kMissing;  ///< highest share of saturated pixels
  /// Highest residual variance of the fringe fit over the variance of the camera noise, of patterns
  /// of four or more frames; 1 is expected. NaN where three frames leave no residual.
  double residual_ratio = kMissing;
  bool needs_attention = false;  ///< an assessment deserves a warning, see `needs_attention`
};

/// Combines the assessments of the patterns of one view.
[[nodiscard]] ViewQuality view_quality(std::span<const FrameAssessment> assessments);

}  // namespace frangia
