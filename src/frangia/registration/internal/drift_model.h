#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/pattern/pattern.h"
#include "frangia/registration/refine_rig.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// The changes that a rig may undergo after its calibration, in units of their prior: a vector w
/// with independent elements of unit variance gives the changes `factor() * w` of the parameters.
class DriftModel {
 public:
  /// @shape    `widening`: factors of the standard deviations of the drift, one for each parameter,
  ///           in the order of `parameters`; the pose's are about the projector's own axes
  DriftModel(const Rig& given,
             const RefineRigOptions& options,
             double working_distance_mm,
             const Eigen::VectorXd& widening = {});

  [[nodiscard]] const std::vector<std::string>& parameters() const { return parameters_; }
  /// @shape    parameters x independent changes
  [[nodiscard]] const Eigen::MatrixXd& factor() const { return factor_; }
  [[nodiscard]] Eigen::Index count() const { return factor_.cols(); }
  /// Parameters that change together, by their indices: those of a lens or of the pose.
  [[nodiscard]] const std::vector<std::vector<Eigen::Index>>& groups() const { return groups_; }
  /// The changes by small motions of the projector in the rig's frame: rotations about the
  /// camera by an angle, then shifts.
  ///
  /// @shape    count x 6
  [[nodiscard]] Eigen::MatrixXd by_motions_of_projector(double tilt_rad, double shift_mm) const;
  /// The rig after a change.
  [[nodiscard]] Rig rig_at(const Eigen::VectorXd& w) const;
  /// The covariance of all known parameters after a measurement of w.
  ///
  /// @shape    `information`: count x count, of the measurement alone
  [[nodiscard]] RigCovariance updated(const Eigen::MatrixXd& information) const;

 private:
  Rig given_;
  std::vector<std::string> parameters_;
  std::vector<std::vector<Eigen::Index>> groups_;
  Eigen::MatrixXd drift_;   ///< covariance of `parameters_` due to drift
  Eigen::MatrixXd factor_;  ///< of the covariance due to drift and calibration
};

/// Derivatives of triangulated points by the changes of a rig.
class PointDrift {
 public:
  /// @shape    3 x changes
  using Derivative = Eigen::Matrix3Xf;

  /// Linearizes about the state `w` of a model.
  PointDrift(const DriftModel& model, const Eigen::VectorXd& w);

  /// The derivative of a point that stays on its pixel and its phase of `pattern`.
  ///
  /// @missing  zero where the changed rigs do not measure the point
  [[nodiscard]] Derivative of(const Eigen::Vector3d& point_mm, const Pattern& pattern) const;
  /// Of the changes.
  [[nodiscard]] Eigen::Index count() const {
    return static_cast<Eigen::Index>(changed_.size() / 2);
  }

 private:
  Rig rig_;
  std::vector<Rig> changed_;  ///< in pairs: by +kStep and by -kStep
};

}  // namespace frangia
