#pragma once

#include <vector>

#include <Eigen/Core>

namespace frangia {

/// The coefficients of mean, cosine and sine in a frame: I = A + B cos(phi) cos(shift) - B sin(phi)
/// sin(shift), linear in three unknowns.
[[nodiscard]] Eigen::Vector3d fringe_model_row(double shift_rad);

/// The normal matrix of the least-squares fit of the fringe model.
///
/// @errors   Error(Input) when fewer than three shifts differ, so that the phase is undetermined
[[nodiscard]] Eigen::Matrix3d fringe_normal_matrix(const std::vector<double>& shifts_rad);

}  // namespace frangia
