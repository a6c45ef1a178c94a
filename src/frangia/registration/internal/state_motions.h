#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "frangia/registration/internal/table_state.h"
#include "frangia/registration/view_motions.h"

namespace frangia {

/// Poses of the object in the rig frame, by view.
[[nodiscard]] std::vector<Eigen::Isometry3d> object_poses(const TableState& state);

/// The motions of the views by each unknown, for a change of 1.
[[nodiscard]] ViewMotions motions_by_unknown(const TableState& state);

/// Standard deviations of the unknowns, part poses being unknown by `prior_sigma`.
[[nodiscard]] Eigen::VectorXd sigmas_of(const TableState& state,
                                        const TurntableSigma& sigma,
                                        const Eigen::VectorXd& prior_sigma);

/// Returns the motions of the views by what is left of `prior_sigma` where pairs of views add the
/// `information`. Where these pairs fit best at an `offset` from the state that is kept, the part
/// of it that they and the prior agree on is one motion more,
/// in directions that they determine badly.
///
/// @shape    `prior_sigma`: the unknowns of the state, 0 for what is exact; `information`: a square
///           matrix of them, or empty for none; `offset`: the unknowns
[[nodiscard]] ViewMotions state_motions(const TableState& state,
                                        const Eigen::VectorXd& prior_sigma,
                                        const Eigen::MatrixXd& information,
                                        const Eigen::VectorXd& offset);

}  // namespace frangia
