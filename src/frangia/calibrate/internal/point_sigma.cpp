#include "frangia/calibrate/internal/point_sigma.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include <ceres/rotation.h>

#include "frangia/core/least_squares.h"
#include "frangia/core/matrix_products.h"

namespace frangia {
namespace {

Eigen::Vector3d moved_by(const RigParameters::Pose& pose, const Eigen::Vector3d& point) {
  Eigen::Vector3d moved;
  ceres::AngleAxisRotatePoint(pose.data(), point.data(), moved.data());
  return moved + Eigen::Vector3d::Map(pose.data() + 3);
}

Eigen::Vector2d lit_pixel(const RigParameters& parameters, const Eigen::Vector3d& point) {
  return project_point(parameters.projector.data(),
                       moved_by(parameters.projector_from_camera, point));
}

/// The coordinate of the projector that changes most along the ray of the camera: 0 for columns,
/// 1 for rows, as of a projector above the camera.
int depth_coordinate(const RigParameters& parameters, const Eigen::Vector3d& point) {
  const Eigen::Vector2d change =
      lit_pixel(parameters, 1.001 * point) - lit_pixel(parameters, 0.999 * point);
  return std::abs(change.x()) >= std::abs(change.y()) ? 0 : 1;
}

/// What determines a point of the reference camera's frame: its camera pixel and its projector
/// coordinate `measured` or, with a label, its pixels in all cameras.
Eigen::VectorXd coordinates_of(const RigLayout& layout,
                               const RigParameters& parameters,
                               const Eigen::Vector3d& point,
                               int measured) {
  Eigen::VectorXd out(layout.has_projector ? 3 : 2 * static_cast<Eigen::Index>(layout.cameras));
  out.head<2>() = project_point(parameters.cameras.front().intrinsics.data(), point);
  if (layout.has_projector) {
    out[2] = lit_pixel(parameters, point)[measured];
    return out;
  }
  for (std::size_t i = 1; i < parameters.cameras.size(); ++i) {
    const RigParameters::PosedIntrinsics& camera = parameters.cameras[i];
    out.segment<2>(2 * static_cast<Eigen::Index>(i)) =
        project_point(camera.intrinsics.data(), moved_by(camera.from_reference, point));
  }
  return out;
}

/// Derivative of a triangulated point with respect to the parameters, 3 x parameters.
Eigen::MatrixXd response_at(const Eigen::Vector3d& point,
                            const RigLayout& layout,
                            const RigParameters& parameters,
                            const Eigen::MatrixXd& covariance) {
  const int measured = layout.has_projector ? depth_coordinate(parameters, point) : 0;
  const auto seen = [&](const RigParameters& by, const Eigen::Vector3d& at) {
    return coordinates_of(layout, by, at, measured);
  };
  Eigen::MatrixXd by_point(seen(parameters, point).size(), 3);
  const double step_mm = 1e-4 * point.norm();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = step_mm * Eigen::Vector3d::Unit(i);
    by_point.col(i) =
        (seen(parameters, point + step) - seen(parameters, point - step)) / (2.0 * step_mm);
  }
  RigParameters changed = parameters;
  Eigen::MatrixXd by_parameter(by_point.rows(), covariance.cols());
  Eigen::Index column = 0;
  for (const auto& [block, size] : blocks_of(layout, changed)) {
    for (int i = 0; i < size && column < covariance.cols(); ++i, ++column) {
      double& value = block[i];  // NOLINT(*-pointer-arithmetic) a block of `size` numbers
      const double kept = value;
      const double step = std::sqrt(covariance(column, column));
      value = kept + step;
      const Eigen::VectorXd above = seen(changed, point);
      value = kept - step;
      by_parameter.col(column) = (above - seen(changed, point)) / (2.0 * step);
      value = kept;
    }
  }
  return -least_squares(by_point, by_parameter);
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
  response -= product(motions, least_squares(motions, response));
}

}  // namespace

ShapeResponse shape_response(const Board& board,
                             const RigLayout& layout,
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
        response_at(points[i], layout, parameters, covariance);
  }
  remove_rigid_motions(points, result.by_parameter);
  result.distance_mm /= static_cast<double>(points.size());
  return result;
}

double point_sigma_mm(const ShapeResponse& shape, const Eigen::MatrixXd& covariance) {
  const Eigen::MatrixXd& response = shape.by_parameter;
  const double sum = product(response, covariance).cwiseProduct(response).sum();
  return std::sqrt(3.0 * sum / static_cast<double>(response.rows()));
}

}  // namespace frangia
