#pragma once

#include <cstddef>
#include <span>
#include <string>

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

/// What one view of a scan measured.
struct ViewSummary {
  std::string name;            ///< folder of the view, as scan.toml gives it
  double angle_rad = 0.0;      ///< commanded turntable angle
  int setup = 0;               ///< number of the setup in scan.toml
  std::size_t points = 0;      ///< measured, before the background is removed
  double sigma_mm = kMissing;  ///< median noise of the points along their rays; NaN without points
  bool left_out = false;       ///< not part of the mesh; a warning gives the reason
  std::string reason{};   ///< why its frames, or parts of them, are not used; empty if they are
  std::string same_as{};  ///< an earlier view with the same phase at every pixel, to the last
                          ///< bit; empty for none
  ViewQuality quality{};  ///< of the frames of the reference camera
};

}  // namespace frangia
