#pragma once

#include <span>

#include "frangia/align/internal/fit_pose.h"
#include "frangia/align/internal/measured_samples.h"
#include "frangia/uncertainty/pose_uncertainty.h"

namespace frangia {

/// The covariance of a fitted pose from the residuals of its samples. Residuals of neighbouring
/// samples are alike, so the spread of the gradients of 64 compact blocks is propagated. Directions
/// that the samples hardly determine are held and have no variance.
///
/// @source   Liang & Zeger 1986 (clustered errors)
[[nodiscard]] PoseUncertainty pose_covariance(std::span<const MeasuredSample> samples,
                                              const FindFoot& find_foot,
                                              const PoseFit& fit);

}  // namespace frangia
