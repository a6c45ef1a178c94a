#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/algorithm/estimate_step.h"
#include "frangia/phase/algorithm/fit_algorithm.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Quality measures of the frames of one pattern.
struct FrameAssessment {
  std::string pattern;              ///< name of the pattern
  std::string algorithm;            ///< name of the algorithm that decoded it
  int frames = 0;                   ///< number of frames
  double nominal_deg = 0.0;         ///< nominal step; 0 if the step was not estimated
  double step_deg = 0.0;            ///< estimated step
  double step_sigma_deg = 0.0;      ///< standard deviation of `step_deg`
  double jitter_deg = 0.0;          ///< rms error of single steps; 0 if none is detected
  double contrast = 0.0;            ///< median of modulation over mean, of the measured pixels
  double measured_fraction = 0.0;   ///< of all pixels
  double saturated_fraction = 0.0;  ///< of all pixels
  /// Residual variance of the fringe fit relative to the camera noise, mean over the measured
  /// pixels. 1 is expected; 0 for three frames, which leave no residual. For four frames 90 degrees
  /// apart the residual is I1 - I2 + I3 - I4.
  double residual_ratio = 0.0;
  /// `residual_ratio` without the residuals that harmonics and the gains of the frames explain.
  double unexplained_ratio = 0.0;
  int harmonic = 0;                  ///< order of the largest significant harmonic; 0 for none
  double harmonic_share = 0.0;       ///< its amplitude relative to that of the fringes
  double harmonic_error_rad = 0.0;   ///< rms phase error due to all harmonics; 0 if corrected
  bool harmonics_corrected = false;  ///< the effect of the harmonics is removed from the phase
  double flicker = 0.0;              ///< rms gain of the frames, which the algorithm compensates
  double flicker_error_rad = 0.0;    ///< rms phase error due to flicker that is not compensated
  bool is_flicker = true;            ///< the frames do not suggest that this is motion instead
  /// `unexplained_ratio` exceeds the limit. What explains it is not asked here (`explain_frames`).
  bool exceeds_noise = false;
};

/// Limits and sampling of the assessment of frames.
struct AssessmentOptions {
  /// Unexplained residual ratio above which the frames differ beyond their noise. The residuals of
  /// good frames give 1 with a noise model that is accurate to about 10 %, as an estimated one is.
  double max_residual_ratio = 1.6;
  /// Approximate number of sampled pixels. The mean ratio then has a standard error below 0.5 %.
  std::size_t samples = 100'000;
};

/// Assesses the frames of a pattern from its fitted algorithm and wrapped phase. The number of
/// operations is linear in pixels and frames.
///
/// @shape    `stack` and `map` have the same size
[[nodiscard]] FrameAssessment assess_frames(const FrameStack& stack,
                                            const FittedAlgorithm& fitted,
                                            const WrappedPhase& map,
                                            const NoiseModel& noise,
                                            const AssessmentOptions& options = {});

/// Returns whether frames differ beyond their noise, or by light that shifts the phase and is not
/// compensated.
[[nodiscard]] bool differs_between_frames(const FrameAssessment& assessment);

/// Returns whether an assessment deserves a warning: frames that differ beyond their noise, flicker
/// that is not compensated, harmonics that shift the phase, or a contrast above 1.
[[nodiscard]] bool needs_attention(const FrameAssessment& assessment);

/// Describes harmonics, flicker and an impossible contrast, one clause each, with what to do.
[[nodiscard]] std::vector<std::string> findings(const FrameAssessment& assessment);

/// One clause about the harmonics that are corrected in the phases of a view; empty where none are.
[[nodiscard]] std::string describe_corrections(std::span<const FrameAssessment> assessments);

/// Formats an assessment as one sentence.
[[nodiscard]] std::string describe(const FrameAssessment& assessment);

/// Estimates the relative gain error of a phase shifter from one or more views; 0 when no step was
/// found.
///
/// The gain is the same in all views. Independent errors of single shifts also change the apparent
/// step, differently in each view. The unevenness of the shifts within the views and the scatter
/// between views therefore determine by how much the mean is shrunk towards 0: pure jitter gives
/// almost 0, a true gain error is kept.
///
/// @shape    one estimate per view, of one pattern; estimates that are not `found` are ignored
/// @source   James and Stein 1961, positive part, with a factor similar to Student's for few views
[[nodiscard]] double pooled_gain_error(std::span<const StepEstimate> views);

}  // namespace frangia
