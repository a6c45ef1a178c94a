#include "frangia/registration/explain/internal/moved_rig.h"

namespace frangia {
namespace {

/// How the points of a view move in the object frame when the table moves in the rig's frame by
/// each unit: their pose is taken for the one before.
Eigen::Matrix<double, 6, 6> motions_by_table(const PoseSetting& setting,
                                             const Eigen::Isometry3d& object_from_rig) {
  Eigen::Matrix<double, 6, 6> by = Eigen::Matrix<double, 6, 6>::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = object_from_rig.linear() * Eigen::Vector3d::Unit(i);
    by.block<3, 1>(0, i) = -setting.tilt_rad * axis;
    by.block<3, 1>(3, i) = setting.tilt_rad * axis.cross(object_from_rig.translation());
    by.block<3, 1>(3, 3 + i) = -setting.shift_mm * axis;
  }
  return by;
}

}  // namespace

bool knows_each_view(const PoseSetting& setting) {
  return setting.rig_changes > 0 && setting.projector_moves.cols() > 0 &&
         setting.rig_basis.cols() == static_cast<Eigen::Index>(setting.views);
}

Eigen::MatrixXd motions_in_rig(const PoseSetting& setting,
                               const Eigen::VectorXd& shares,
                               Eigen::Index unknowns) {
  const bool has_rig = knows_each_view(setting);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(unknowns, has_rig ? 12 : 6);
  for (Eigen::Index view = 0; view < shares.size(); ++view) {
    all.block<6, 6>(6 * view, 0) =
        shares[view] *
        motions_by_table(setting, setting.object_from_rig[static_cast<std::size_t>(view)]);
  }
  if (!has_rig) return all;
  const Eigen::VectorXd functions = setting.rig_basis.transpose() * shares;
  const Eigen::Index terms = setting.rig_changes;
  const Eigen::Index first = unknowns - terms * functions.size();
  for (Eigen::Index i = 0; i < functions.size(); ++i)
    all.block(first + terms * i, 6, terms, 6) = functions[i] * setting.projector_moves;
  return all;
}

Eigen::MatrixXd motions_of_knock(MovedRig moved) {
  // A knock bends what it moves, and large motions are not linear.
  constexpr double kBesides = 0.02;
  Eigen::MatrixXd all(12, 18);
  all << Eigen::MatrixXd::Zero(12, 6), kBesides * Eigen::MatrixXd::Identity(12, 12);
  all.block<6, 6>(6, 0).setIdentity();
  if (moved == MovedRig::Camera) all.block<6, 6>(0, 0).setIdentity();
  return all;
}

}  // namespace frangia
