#include "frangia/calibrate/internal/point_sigma.h"

#include <cmath>
#include <vector>

#include <Eigen/LU>
#include <Eigen/QR>
#include <ceres/rotation.h>

namespace frangia {
namespace {

/// Camera pixel and projector column of a point in the camera frame.
Eigen::Vector3d coordinates_of(const RigParameters& parameters, const Eigen::Vector3d& point) {
  const Eigen::Vector2d camera = project_point(parameters.camera.data(), point);
  Eigen::Vector3d moved;
  ceres::AngleAxisRotatePoint(parameters.projector_from_camera.data(), point.data(), moved.data());
  moved += Eigen::Vector3d::Map(parameters.projector_from_camera.data() + 3);
  return {camera.x(), camera.y(), project_point(parameters.projector.data(), moved).x()};
}

/// The parameters of camera, projector and relative pose, in the order of the covariance.
std::vector<double*> all_parameters(RigParameters& parameters) {
  std::vector<double*> values;
  for (double& value : parameters.camera)
    values.push_back(&value);
  for (double& value : parameters.projector)
    values.push_back(&value);
  for (double& value : parameters.projector_from_camera)
    values.push_back(&value);
  return values;
}

/// Derivative of a triangulated point with respect to the parameters, 3 x parameters.
Eigen::MatrixXd response_at(const Eigen::Vector3d& point,
                            const RigParameters& parameters,
                            const Eigen::MatrixXd& covariance) {
  Eigen::Matrix3d by_point;
  const double step_mm = 1e-4 * point.norm();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = step_mm * Eigen::Vector3d::Unit(i);
    by_point.col(i) =
        (coordinates_of(parameters, point + step) - coordinates_of(parameters, point - step)) /
        (2.0 * step_mm);
  }
  RigParameters changed = parameters;
  const std::vector<double*> values = all_parameters(changed);
  Eigen::MatrixXd by_parameter(3, covariance.cols());
  for (Eigen::Index i = 0; i < covariance.cols(); ++i) {
    double& value = *values[static_cast<std::size_t>(i)];
    const double kept = value;
    const double step = std::sqrt(covariance(i, i));
    value = kept + step;
    const Eigen::Vector3d above = coordinates_of(changed, point);
    value = kept - step;
    by_parameter.col(i) = (above - coordinates_of(changed, point)) / (2.0 * step);
    value = kept;
  }
  return -by_point.partialPivLu().solve(by_parameter);
}

/// Removes from the columns of `response`, displacements of all points one below the other, what a
/// rigid motion of all points explains.
void remove_rigid_motions(const std::vector<Eigen::Vector3d>& points, Eigen::MatrixXd& response) {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points)
    center += point / static_cast<double>(points.size());
  Eigen::MatrixXd motions(response.rows(), 6);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(3 * i);
    for (int axis = 0; axis < 3; ++axis) {
      motions.block<3, 1>(row, axis) = Eigen::Vector3d::Unit(axis);
      motions.block<3, 1>(row, 3 + axis) =
          Eigen::Vector3d::Unit(axis).cross(points[i] - center) / center.norm();
    }
  }
  response -= motions * motions.householderQr().solve(response);
}

}  // namespace

ShapeResponse shape_response(const Board& board,
                             const RigParameters& parameters,
                             const RigSolution& solution) {
  const double half_x = 0.5 * (board.columns - 1) * board.square_mm;
  const double half_y = 0.5 * (board.rows - 1) * board.square_mm;
  std::vector<Eigen::Vector3d> points;
  ShapeResponse result;
  for (const Eigen::Isometry3d& camera_from_board : solution.camera_from_board) {
    for (const double x : {-half_x, 0.0, half_x}) {
      for (const double y : {-half_y, 0.0, half_y}) {
        points.emplace_back(camera_from_board * Eigen::Vector3d(x, y, 0.0));
        result.distance_mm += points.back().norm();
      }
    }
  }
  const Eigen::MatrixXd& covariance = solution.covariance;
  result.by_parameter.resize(3 * static_cast<Eigen::Index>(points.size()), covariance.cols());
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.by_parameter.middleRows<3>(static_cast<Eigen::Index>(3 * i)) =
        response_at(points[i], parameters, covariance);
  }
  remove_rigid_motions(points, result.by_parameter);
  result.distance_mm /= static_cast<double>(points.size());
  return result;
}

void add_point_sigma(const ShapeResponse& shape, RigSolution& solution) {
  const Eigen::MatrixXd& response = shape.by_parameter;
  const double sum = (response * solution.covariance).cwiseProduct(response).sum();
  solution.point_sigma_mm = std::sqrt(3.0 * sum / static_cast<double>(response.rows()));
  solution.distance_mm = shape.distance_mm;
}

}  // namespace frangia
