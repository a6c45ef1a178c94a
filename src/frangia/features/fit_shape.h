#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/features/feature_points.h"
#include "frangia/features/shape.h"

namespace frangia {

/// Robustness and limits of a fit.
struct ShapeFitOptions {
  double gate_mm = 0.0;     ///< points farther from the start are ignored; required
  bool robust = true;       ///< false: plain least squares over the points within the gate
  int max_iterations = 30;  ///< of the optimizer
};

/// A shape of least squares and what is known about it.
struct ShapeFit {
  Shape shape;             ///< its center lies amid the points
  bool converged = false;  ///< false: the points do not determine the shape
  std::size_t points = 0;  ///< with a weight above 0
  double rms_mm = 0.0;     ///< root mean square residual of these
  double form_mm = 0.0;    ///< range of their residuals: the largest minus the smallest
  double gate_mm = 0.0;    ///< largest residual of a point with a weight above 0
};

/// Fits a shape to some of the points by weighted least squares on the orthogonal distances, with
/// Tukey's biweight. The weight is one over the sum of the variance of a point's noise and its
/// median, since no point's residual is as small as the noise of the best points.
///
/// @units    mm
/// @errors   Error(Input) for a line or a circle; Error(Cancelled)
/// @source   Forbes 1991, Least-squares best-fit geometric elements
[[nodiscard]] ShapeFit fit_shape(const FeaturePoints& points,
                                 std::span<const std::uint32_t> chosen,
                                 const Shape& start,
                                 const ShapeFitOptions& options,
                                 const Run& run = {});

}  // namespace frangia
