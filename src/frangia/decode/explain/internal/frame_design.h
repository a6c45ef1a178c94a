#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/decode/explain/frame_hypothesis.h"

namespace frangia {

/// The frames that show fringes as a linear function of mean, B cos(phi) and B sin(phi) of a pixel.
struct FrameDesign {
  std::vector<Eigen::Index> shown;  ///< frames that show fringes
  Eigen::MatrixXd design;           ///< one row per shown frame
  Eigen::MatrixXd inverse;  ///< least squares; empty if the frames do not determine the pixel
  Eigen::MatrixXd span;     ///< orthonormal basis of what the design explains
  Eigen::MatrixXd rest;     ///< orthonormal basis of what it does not
};

[[nodiscard]] FrameDesign design_of(const FrameHypothesis& hypothesis);

/// Whether frames with these shifts determine the phase with at most twice the noise of as many
/// equal steps.
[[nodiscard]] bool determine_phase(const std::vector<double>& shifts_rad);

/// The projection on what the hypothesis explains, 0 for free frames.
///
/// @shape    N x N for N frames
[[nodiscard]] Eigen::MatrixXd explained_space(const FrameHypothesis& hypothesis);

}  // namespace frangia
