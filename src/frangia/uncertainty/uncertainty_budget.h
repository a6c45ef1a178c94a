#pragma once

#include <span>
#include <string_view>

namespace frangia {

/// A source of error of a measured point.
enum class UncertaintyTerm {
  CameraNoise,          ///< shot noise and read noise of the camera
  LateralLocalization,  ///< position of a pixel on the surface, response within the pixel
  Speckle,              ///< grain of laser light, whose phase differs from pixel to pixel
  Registration,         ///< differences between the views after registration
  Harmonics,            ///< response of projector and camera that was not corrected
  StepErrors,           ///< phase steps that differ from the nominal ones
  Flicker,              ///< light or exposure that changes between frames
  Quantization,         ///< whole counts of the frames
  IndirectLight,        ///< light that reaches a point by way of other parts of the surface
  Calibration,          ///< covariance of the parameters of the rig
  Turntable,            ///< axis and angles of the turntable, as far as views do not determine them
  Resolution,           ///< edges and creases that points and voxels do not resolve
  Temperature,          ///< thermal expansion of the part
};

/// The part of the uncertainty that a term belongs to.
enum class UncertaintyPart {
  Noise,      ///< random; averaging reduces it with the square root of the number of observations
  Systematic  ///< shared by the observations that are averaged; averaging does not reduce it
};

/// What the errors of a term have in common.
enum class ErrorCorrelation {
  None,     ///< errors of different pixels and views are independent
  View,     ///< errors of neighbouring pixels of one view are alike, those of views are not
  AllViews  ///< errors are alike in all views of a scan
};

/// A term of the budget and how it combines with itself.
struct UncertaintyTermInfo {
  UncertaintyTerm term{};          ///< the term
  std::string_view name;           ///< as in files and reports, for example "camera_noise"
  std::string_view cause;          ///< what causes it, as a phrase
  UncertaintyPart part{};          ///< the part of the uncertainty that it enters
  ErrorCorrelation correlation{};  ///< what its errors have in common
};

/// Returns all terms of the budget, in the order in which they arise. docs/uncertainty.md states
/// where each one is computed.
[[nodiscard]] std::span<const UncertaintyTermInfo> uncertainty_terms();

/// Returns the entry of a term.
[[nodiscard]] const UncertaintyTermInfo& info_of(UncertaintyTerm term);

/// Combines independent standard uncertainties to the root of the sum of their squares.
///
/// @units    those of the terms
/// @missing  NaN when a term is NaN; 0 without terms
/// @source   GUM (JCGM 100:2008), 5.1.2
[[nodiscard]] double root_sum_square(std::span<const double> terms);

/// A standard uncertainty in its two parts.
struct SigmaParts {
  double noise = 0.0;       ///< random part
  double systematic = 0.0;  ///< systematic part

  /// Returns the combined standard uncertainty.
  [[nodiscard]] double combined() const;
};

/// An observation of a quantity and its weight in a mean.
struct WeightedSigma {
  SigmaParts sigma;     ///< of the observation
  double weight = 1.0;  ///< in the mean; 1 / noise^2 minimizes the noise of the mean
};

/// Returns the standard uncertainty of a weighted mean. Noise of the observations is independent
/// and averages out. Their systematic parts may be alike, so they do not: the part of the mean is
/// the weighted mean of the parts, which is exact for errors that are fully correlated and an upper
/// bound for all others. Fusion of views follows the same rule, except for errors that are known to
/// differ from view to view.
///
/// @units    those of the observations
/// @missing  NaN without observations, and where the sum of the weights is 0
/// @source   GUM (JCGM 100:2008), 5.2.2, with correlation coefficients 0 and 1
[[nodiscard]] SigmaParts sigma_of_mean(std::span<const WeightedSigma> observations);

}  // namespace frangia
