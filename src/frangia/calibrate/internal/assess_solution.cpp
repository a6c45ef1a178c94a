#include "frangia/calibrate/internal/assess_solution.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <ceres/rotation.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/core/statistics.h"

namespace frangia {
namespace {

/// Poses whose error exceeds this multiple of the median are named.
constexpr double kOutlierRms = 3.0;

/// Reprojection error below which a pose is never named: corners of sharp images have up to this.
constexpr double kOutlierFloor_px = 0.3;

double median_rms_px(const std::vector<ResidualSummary>& by_view) {
  std::vector<double> errors;
  for (const ResidualSummary& summary : by_view)
    if (summary.points > 0) errors.push_back(summary.rms_px);
  return errors.empty() ? 0.0 : median(errors);
}

void warn_of_poses(const std::vector<BoardView>& views,
                   const std::vector<ResidualSummary>& by_view,
                   const std::string& device,
                   const Run& run) {
  const double typical = median_rms_px(by_view);
  for (const std::size_t i : outlier_views(by_view)) {
    run.warn(fmt::format(
        "{}: the reprojection error of {} is {:.2f} px, {:.1f} times the median of all poses; "
        "the board or the camera moved during its capture, or its corners are blurred or badly lit",
        views[i].name,
        device,
        by_view[i].rms_px,
        by_view[i].rms_px / typical));
  }
}

std::string in_words(const SolvedCamera& camera) {
  return camera.name.empty() ? "the camera" : "camera \"" + camera.name + "\"";
}

std::string worst_view(const std::vector<BoardView>& views,
                       const std::vector<ResidualSummary>& by_view) {
  const auto worst =
      std::max_element(by_view.begin(), by_view.end(), [](const auto& a, const auto& b) {
        return a.rms_px < b.rms_px;
      });
  return views[static_cast<std::size_t>(worst - by_view.begin())].name;
}

/// Fails where a camera contradicts the board.
void check_camera(const std::string& device,
                  const ResidualSummary& residuals,
                  const std::vector<ResidualSummary>& by_view,
                  const std::vector<BoardView>& views,
                  double max_rms_px) {
  if (residuals.rms_px <= max_rms_px) return;
  throw Error(ErrorKind::Input,
              fmt::format("the poses contradict each other: the reprojection error of {} is {:.1f} "
                          "px, largest in {}; check board.corners and that the board is stiff",
                          device,
                          residuals.rms_px,
                          worst_view(views, by_view)));
}

/// Fails where the phases that a camera reads contradict the board.
void check_fringes(const std::string& device,
                   const ResidualSummary& residuals,
                   const std::vector<ResidualSummary>& by_view,
                   const std::vector<BoardView>& views,
                   double max_rms_px) {
  if (residuals.rms_px <= max_rms_px) return;
  throw Error(ErrorKind::Input,
              fmt::format("the fringes contradict the board: the projector's reprojection error, "
                          "seen by {}, is {:.1f} px, largest in {}; check the order of the frames, "
                          "shifts_deg and that nothing moved during the capture",
                          device,
                          residuals.rms_px,
                          worst_view(views, by_view)));
}

/// Compares the distance of a device from the reference camera with the one that was stated.
/// Returns whether it was stated.
bool compare_distance(const char* device,
                      const char* key,
                      const Eigen::Vector3d& stated_mm,
                      double found_mm,
                      const Board& board,
                      double max_error,
                      const Run& run) {
  if (!stated_mm.allFinite() || stated_mm.norm() == 0.0) return false;
  const double ratio = stated_mm.norm() / found_mm;
  if (std::abs(ratio - 1.0) < max_error) return true;
  const bool circles = board.kind == BoardKind::Circles;
  run.warn(
      fmt::format("{} is {:.1f} mm from the camera, but {} in rig.toml states {:.1f} mm: if that "
                  "is right, board.{} is {:.3g} mm, not {:g} mm",
                  device,
                  found_mm,
                  key,
                  stated_mm.norm(),
                  circles ? "spacing_mm" : "square_mm",
                  ratio * board.square_mm,
                  board.square_mm));
  return true;
}

}  // namespace

std::vector<std::size_t> outlier_views(const std::vector<ResidualSummary>& by_view) {
  const double limit = std::max(kOutlierRms * median_rms_px(by_view), kOutlierFloor_px);
  std::vector<std::size_t> outliers;
  for (std::size_t i = 0; i < by_view.size(); ++i)
    if (by_view[i].rms_px > limit) outliers.push_back(i);
  return outliers;
}

void warn_of_outliers(const std::vector<BoardView>& views,
                      const RigSolution& solution,
                      const Run& run) {
  for (const SolvedCamera& camera : solution.cameras) {
    const std::string device = in_words(camera);
    const std::string projector =
        camera.name.empty() ? "the projector" : "the projector, seen by " + device + ",";
    warn_of_poses(views, camera.by_view, device, run);
    warn_of_poses(views, camera.projector_by_view, projector, run);
  }
}

void warn_of_scale(const Scan& scan,
                   const RigSolution& solution,
                   double max_error,
                   const Run& run) {
  const double projector_mm = solution.projector_from_camera.translation().norm();
  if (solution.has_projector && compare_distance("the projector",
                                                 "projector.position_mm",
                                                 scan.rig.projector.position_mm,
                                                 projector_mm,
                                                 *scan.board,
                                                 max_error,
                                                 run))
    return;
  for (std::size_t i = 1; i < solution.cameras.size(); ++i) {
    const bool stated = compare_distance(in_words(solution.cameras[i]).c_str(),
                                         fmt::format("more_cameras[{}].position_mm", i - 1).c_str(),
                                         scan.rig.cameras[i].position_mm,
                                         solution.cameras[i].camera_from_rig.translation().norm(),
                                         *scan.board,
                                         max_error,
                                         run);
    if (stated) return;
  }
}

void check_solution(const RigSolution& solution,
                    const std::vector<BoardView>& views,
                    double max_rms_px) {
  if (!solution.undetermined.empty()) {
    throw Error(
        ErrorKind::Input,
        fmt::format("the poses do not determine {}; capture more poses that fill the image and "
                    "are tilted by 20 to 40 degrees, each another way",
                    fmt::join(solution.undetermined, ", ")));
  }
  for (const SolvedCamera& camera : solution.cameras) {
    const std::string device = in_words(camera);
    check_camera(device, camera.residuals, camera.by_view, views, max_rms_px);
    check_fringes(device, camera.projector_residuals, camera.projector_by_view, views, max_rms_px);
  }
}

NormalInverse invert_normal(const Eigen::MatrixXd& normal, double least) {
  const Eigen::VectorXd scale = normal.diagonal().unaryExpr(
      [](double square) { return square > 0.0 ? 1.0 / std::sqrt(square) : 0.0; });
  const auto eigen =
      symmetric_eigen(Eigen::MatrixXd(scale.asDiagonal() * normal * scale.asDiagonal()));
  const double threshold = least * eigen.values.tail<1>()[0];
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(scale.size(), scale.size());
  Eigen::VectorXd open = Eigen::VectorXd::Zero(scale.size());
  for (Eigen::Index i = 0; i < eigen.values.size(); ++i) {
    const Eigen::VectorXd direction = eigen.vectors.col(i);
    if (eigen.values[i] > threshold) {
      inverse += direction * direction.transpose() / eigen.values[i];
    } else {
      open += direction.cwiseAbs2();
    }
  }
  return {scale.asDiagonal() * inverse * scale.asDiagonal(), open};
}

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
