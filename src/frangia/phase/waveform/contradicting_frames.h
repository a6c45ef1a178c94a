#pragma once

#include <string>

#include "frangia/core/image.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/algorithm/fit_algorithm.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Standard uncertainty of the phase at each pixel by what the frames around it leave beyond their
/// noise, harmonics and gains: a hand or a shadow in some of the frames, rows that were lost, edges
/// of a frame that shook. What is alike all over the image is `FittedAlgorithm::unexplained_rad`.
///
/// The residual is a mean over windows of 7 x 7 pixels: some phases hide a fault of two frames from
/// a single pixel. What is covered is a region, so that pixels whose surroundings contradict each
/// other count as these do.
///
/// @shape    four frames or more of w x h, of one exposure; w x h out, empty for three frames:
///           they leave no residual
/// @units    rad
/// @missing  0 where noise explains the residual, and where there are no fringes
[[nodiscard]] Image<float> unexplained_phase(const FrameStack& stack,
                                             const FittedAlgorithm& fitted,
                                             const NoiseModel& noise);

/// How the unexplained uncertainty of one pattern enters a phase.
struct UnexplainedUse {
  double counted_rad = 0.0;    ///< part of it that `systematic_rad` has already, at all pixels
  float max_sigma_rad = 0.1F;  ///< beyond which a pixel is not measured
  double weight = 1.0;         ///< of the error of the pattern in the phase
};

/// The images of a phase of any kind.
struct PhaseImages {
  Image<float>& phase_rad;       ///< NaN where it is not measured
  Image<float>& sigma_rad;       ///< its noise
  Image<PixelStatus>& status;    ///< of each pixel
  Image<float>& systematic_rad;  ///< empty for none
};

/// Adds the local uncertainty to the systematic part, and discards the pixels where it is too
/// large; they count as unmodulated. Beyond twice the limit, which few levels or compression do not
/// explain, they count as contradicting: returns the share of these of the measured pixels.
///
/// @shape    `unexplained_rad` as unexplained_phase returns it; an empty one changes nothing
double count_unexplained(const Image<float>& unexplained_rad,
                         const UnexplainedUse& use,
                         const PhaseImages& images);

/// Where most pixels lie whose uncertainty is larger than twice this, for people: "columns 210 to
/// 330 and rows 120 to 380".
///
/// @missing  empty without such pixels
[[nodiscard]] std::string place_of_unexplained(const Image<float>& unexplained_rad,
                                               float max_sigma_rad);

/// The warning about pixels of a pattern that are discarded, and their place; empty where they are
/// few.
[[nodiscard]] std::string describe_contradicting(const std::string& pattern,
                                                 double share,
                                                 const std::string& place);

}  // namespace frangia
