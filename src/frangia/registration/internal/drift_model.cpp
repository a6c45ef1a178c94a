#include "frangia/registration/internal/drift_model.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include <Eigen/Geometry>

#include "frangia/core/linear_algebra.h"
#include "frangia/range/triangulate.h"
#include "frangia/rig/rig_covariance.h"

namespace frangia {
namespace {

/// Step of the central differences, in standard deviations of the prior.
constexpr double kDriftStep = 0.1;

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

/// The changes of rotation vector and translation of `p = R X + t` per rotation about the
/// projector's own axes and per shift of its center along the axes of the rig.
Eigen::Matrix<double, 6, 6> pose_by_drift(const Projector& projector) {
  constexpr double kSmall_rad = 1e-6;
  const Eigen::Vector3d translation = -(projector.rotation * projector.position_mm);
  const Eigen::Vector3d vector = rotation_vector(projector.rotation);
  Eigen::Matrix<double, 6, 6> by = Eigen::Matrix<double, 6, 6>::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
    const Eigen::Matrix3d turned = Eigen::AngleAxisd(kSmall_rad, axis) * projector.rotation;
    by.block<3, 1>(0, i) = (rotation_vector(turned) - vector) / kSmall_rad;
    by.block<3, 1>(3, i) = axis.cross(translation);
  }
  by.bottomRightCorner<3, 3>() = -projector.rotation;
  return by;
}

/// Standard deviation of k1 that displaces the ends of a row by a share of the width: k1 displaces
/// a point at the distance r from the centre, in focal lengths, by f k1 r^3.
double k1_sigma(double relative_distortion, const CameraModel& model) {
  const double half_width = 0.5 * model.width_px / model.focal_px.x();
  return 2.0 * relative_distortion / std::pow(half_width, 2);
}

std::size_t index_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Adds the covariance of the names that `to` holds.
void add_covariance(Eigen::MatrixXd& sum,
                    const std::vector<std::string>& to,
                    const Eigen::MatrixXd& covariance,
                    const std::vector<std::string>& from) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    const std::size_t row = index_of(to, from[i]);
    if (row == to.size()) continue;
    for (std::size_t j = 0; j < from.size(); ++j) {
      const std::size_t column = index_of(to, from[j]);
      if (column == to.size()) continue;
      sum(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) +=
          covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
}

}  // namespace

DriftModel::DriftModel(const Rig& given,
                       const RefineRigOptions& options,
                       double working_distance_mm,
                       const Eigen::VectorXd& widening)
    : given_(given) {
  std::vector<double> sigmas;  // of the parameters that are not of the pose
  const auto add_intrinsics = [&](const std::string& of, const CameraModel& model) {
    const double principal_px = options.relative_principal_sigma * model.width_px;
    const auto first = static_cast<Eigen::Index>(parameters_.size());
    groups_.insert(groups_.end(), {{first}, {first + 1, first + 2}, {first + 3}});
    parameters_.insert(
        parameters_.end(),
        {of + ".focal_px", of + ".principal_x_px", of + ".principal_y_px", of + ".k1"});
    sigmas.insert(sigmas.end(),
                  {options.relative_focal_sigma * model.focal_px.x(),
                   principal_px,
                   principal_px,
                   k1_sigma(options.relative_distortion_sigma, model)});
  };
  add_intrinsics("camera", given.reference().model);
  if (const auto* pinhole = std::get_if<PinholeModel>(&given.projector.model))
    add_intrinsics("projector", *pinhole);
  for (const char* name :
       {"rotation_x_rad", "rotation_y_rad", "rotation_z_rad", "x_mm", "y_mm", "z_mm"})
    parameters_.push_back(std::string("projector.") + name);
  const auto count = static_cast<Eigen::Index>(parameters_.size());
  groups_.push_back({count - 6, count - 5, count - 4, count - 3, count - 2, count - 1});
  Eigen::MatrixXd physical = Eigen::MatrixXd::Zero(count, count);
  for (std::size_t i = 0; i < sigmas.size(); ++i)
    physical(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) = sigmas[i];
  Eigen::Matrix<double, 6, 1> pose;
  pose.head<3>().setConstant(options.rotation_sigma_rad);
  pose.tail<3>().setConstant(options.relative_position_sigma * working_distance_mm);
  physical.bottomRightCorner<6, 6>() = pose_by_drift(given.projector) * pose.asDiagonal();
  if (widening.size() == count) physical *= widening.asDiagonal();
  drift_ = product_transposed(physical, physical);
  if (!given.calibration || given.calibration->covariance.empty()) {
    factor_ = physical;
    return;
  }
  const RigCovariance& known = given.calibration->covariance;
  RigCovariance both{parameters_, drift_};
  add_covariance(both.covariance, parameters_, known.covariance, known.parameters);
  factor_ = covariance_factor(both);
}

Eigen::MatrixXd DriftModel::by_motions_of_projector(double tilt_rad, double shift_mm) const {
  const Projector& projector = given_.projector;
  Eigen::Matrix<double, 6, 6> own = Eigen::Matrix<double, 6, 6>::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
    own.block<3, 1>(0, i) = -tilt_rad * (projector.rotation * axis);
    own.block<3, 1>(3, i) = tilt_rad * axis.cross(projector.position_mm);
    own(3 + i, 3 + i) = shift_mm;
  }
  Eigen::MatrixXd changes = Eigen::MatrixXd::Zero(factor_.rows(), 6);
  changes.bottomRows<6>() = pose_by_drift(projector) * own;
  return least_squares(factor_, changes);
}

Rig DriftModel::rig_at(const Eigen::VectorXd& w) const {
  return change_parameters(given_, parameters_, product(factor_, w));
}

RigCovariance DriftModel::updated(const Eigen::MatrixXd& information) const {
  RigCovariance all;
  const bool calibrated = given_.calibration && !given_.calibration->covariance.empty();
  for (const std::string& name : rig_parameter_names(given_)) {
    const auto holds = [&](const std::vector<std::string>& names) {
      return index_of(names, name) < names.size();
    };
    if (holds(parameters_) || (calibrated && holds(given_.calibration->covariance.parameters)))
      all.parameters.push_back(name);
  }
  const auto count = static_cast<Eigen::Index>(all.parameters.size());
  all.covariance = Eigen::MatrixXd::Zero(count, count);
  add_covariance(all.covariance, all.parameters, drift_, parameters_);
  if (calibrated) {
    const RigCovariance& known = given_.calibration->covariance;
    add_covariance(all.covariance, all.parameters, known.covariance, known.parameters);
  }
  // Conditioned on a measurement of w = inverse(factor) (refined parameters): C - G' (H^-1 + 1)^-1
  // G with G = cov(w, all), and (H^-1 + 1)^-1 = (1 + H)^-1 H, which needs no inverse of H.
  Eigen::MatrixXd of_refined = Eigen::MatrixXd::Zero(factor_.rows(), count);
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    of_refined.row(static_cast<Eigen::Index>(i)) =
        all.covariance.row(static_cast<Eigen::Index>(index_of(all.parameters, parameters_[i])));
  }
  const Eigen::MatrixXd of_w = least_squares(factor_, of_refined);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(this->count(), this->count());
  const Eigen::MatrixXd gained = least_squares(identity + information, information);
  all.covariance -= congruence(of_w, gained);
  all.covariance = (0.5 * (all.covariance + all.covariance.transpose())).eval();
  return all;
}

PointDrift::PointDrift(const DriftModel& model, const Eigen::VectorXd& w) : rig_(model.rig_at(w)) {
  for (Eigen::Index i = 0; i < model.count(); ++i) {
    for (const double side : {kDriftStep, -kDriftStep}) {
      Eigen::VectorXd changed = w;
      changed[i] += side;
      changed_.push_back(model.rig_at(changed));
    }
  }
}

PointDrift::Derivative PointDrift::of(const Eigen::Vector3d& point_mm,
                                      const Pattern& pattern) const {
  constexpr double kRelativeStep = 1e-4;  // of the depth, for the gradient of the phase
  const Eigen::Index changes = count();
  const double depth_mm = point_mm.z();
  const Eigen::Vector3d direction = point_mm / depth_mm;
  Eigen::Vector3d gradient;  // of the phase, rad/mm
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = kRelativeStep * depth_mm * Eigen::Vector3d::Unit(i);
    gradient[i] = (phase_at(point_mm + step, pattern, rig_.projector) -
                   phase_at(point_mm - step, pattern, rig_.projector)) /
                  (2.0 * kRelativeStep * depth_mm);
  }
  const CameraModel& camera = rig_.reference().model;
  const Eigen::Matrix2d ray_by_pixel =
      (camera.focal_px.asDiagonal() * camera.distort_jacobian(direction.head<2>())).inverse();
  Derivative by(3, changes);
  for (Eigen::Index i = 0; i < changes; ++i) {
    const Rig& more = changed_[static_cast<std::size_t>(2 * i)];
    const Rig& less = changed_[static_cast<std::size_t>(2 * i + 1)];
    const Eigen::Vector2d pixel =
        (more.reference().model.project(point_mm) - less.reference().model.project(point_mm)) /
        (2.0 * kDriftStep);
    const double phase = (phase_at(point_mm, pattern, more.projector) -
                          phase_at(point_mm, pattern, less.projector)) /
                         (2.0 * kDriftStep);
    // The ray turns so that the pixel stays, and the point moves along it so that the phase stays.
    Eigen::Vector3d across = Eigen::Vector3d::Zero();
    across.head<2>() = -depth_mm * (ray_by_pixel * pixel);
    const double deeper = -(phase + gradient.dot(across)) / gradient.dot(direction);
    by.col(i) = (across + deeper * direction).cast<float>();
  }
  if (!by.allFinite()) by.setZero();
  return by;
}

}  // namespace frangia
