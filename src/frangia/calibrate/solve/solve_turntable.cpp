#include "frangia/calibrate/solve/solve_turntable.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"

namespace frangia {
namespace {

constexpr Eigen::Index kAxisParameters = 4;                     // two turns, two shifts
constexpr Eigen::Index kTableParameters = kAxisParameters + 6;  // and the pose of the board
using TableStep = Eigen::Matrix<double, kTableParameters, 1>;

/// The turning board.
struct TableModel {
  Eigen::Vector3d point_mm;
  Eigen::Vector3d axis;
  Eigen::Isometry3d rig_from_board;  ///< at angle 0

  [[nodiscard]] Eigen::Isometry3d at(double angle_rad) const {
    return Eigen::Translation3d(point_mm) * Eigen::AngleAxisd(angle_rad, axis) *
           Eigen::Translation3d(-point_mm) * rig_from_board;
  }

  /// Two directions across the axis.
  [[nodiscard]] Eigen::Matrix<double, 3, 2> across() const {
    Eigen::Matrix<double, 3, 2> directions;
    directions.col(0) = axis.unitOrthogonal();
    directions.col(1) = axis.cross(directions.col(0));
    return directions;
  }

  [[nodiscard]] TableModel moved(const TableStep& step) const {
    TableModel out = *this;
    const Eigen::Matrix<double, 3, 2> sides = across();
    out.axis = (axis + sides * step.head<2>()).normalized();
    out.point_mm += sides * step.segment<2>(2);
    const Eigen::Vector3d turn = step.segment<3>(4);
    const double angle = turn.norm();
    if (angle > 0.0) {
      out.rig_from_board.linear() =
          Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * rig_from_board.linear();
    }
    out.rig_from_board.translation() += step.tail<3>();
    return out;
  }
};

/// @errors   Error(Input) for views of a turning board that are too few or span too small an angle
void check_table_views(std::span<const BoardView> views, std::span<const double> angles_rad) {
  constexpr std::size_t kFewest = 3;
  constexpr double kLeast_rad = 0.35;  // 20 degrees; the axis is extrapolated from a shorter arc
  if (views.size() < kFewest) {
    throw Error(ErrorKind::Input,
                fmt::format("the board is found in {} of at least {} views; turn the table by "
                            "smaller steps, so that camera and projector see the board",
                            views.size(),
                            kFewest));
  }
  double widest = 0.0;
  for (const double a : angles_rad)
    for (const double b : angles_rad)
      widest = std::max(widest, std::abs(std::remainder(a - b, kTwoPi)));
  if (widest >= kLeast_rad) return;
  throw Error(ErrorKind::Input,
              fmt::format("the angles of the views span {:.1f} degrees; state angle_deg of each "
                          "view in scan.toml, and turn the table by 60 to 90 degrees in all",
                          deg_from_rad(widest)));
}

/// What the residuals are computed from.
struct TableProblem {
  std::vector<Eigen::Vector3d> places;  ///< of the board's points, about its center
  std::span<const BoardView> views;
  std::span<const double> angles_rad;
  const Rig& rig;
  const PinholeModel& projector;
};

/// Calls `visit(observed, predicted, by_projector)` for each pixel of a view.
template <typename Visit>
void for_each_pixel(const TableProblem& problem,
                    std::size_t view,
                    const Eigen::Isometry3d& rig_from_board,
                    const Visit& visit) {
  for (const BoardPoint& point : problem.views[view].points) {
    const Eigen::Vector3d place =
        rig_from_board * problem.places[static_cast<std::size_t>(point.index)];
    visit(point.camera_px, problem.rig.reference().model.project(place), false);
    if (point.projector_px.allFinite()) {
      visit(point.projector_px,
            problem.projector.project(problem.rig.projector.from_rig(place)),
            true);
    }
  }
}

Eigen::VectorXd residuals_of(const TableProblem& problem, const TableModel& model) {
  std::vector<double> residuals;
  for (std::size_t view = 0; view < problem.views.size(); ++view) {
    for_each_pixel(problem,
                   view,
                   model.at(problem.angles_rad[view]),
                   [&](const Eigen::Vector2d& observed, const Eigen::Vector2d& predicted, bool) {
                     residuals.push_back(predicted.x() - observed.x());
                     residuals.push_back(predicted.y() - observed.y());
                   });
  }
  return Eigen::VectorXd::Map(residuals.data(), static_cast<Eigen::Index>(residuals.size()));
}

Eigen::MatrixXd table_jacobian(const TableProblem& problem,
                               const TableModel& model,
                               const Eigen::VectorXd& residuals) {
  constexpr double kTurn = 1e-6;   // rad
  constexpr double kShift = 1e-4;  // mm
  TableStep steps;
  steps << kTurn, kTurn, kShift, kShift, kTurn, kTurn, kTurn, kShift, kShift, kShift;
  Eigen::MatrixXd jacobian(residuals.size(), kTableParameters);
  for (Eigen::Index i = 0; i < kTableParameters; ++i) {
    TableStep step = TableStep::Zero();
    step[i] = steps[i];
    jacobian.col(i) = (residuals_of(problem, model.moved(step)) - residuals) / steps[i];
  }
  return jacobian;
}

/// Adjusts `model` and returns the final residuals.
Eigen::VectorXd adjust_table(const TableProblem& problem, TableModel& model) {
  Eigen::VectorXd residuals = residuals_of(problem, model);
  double damping = 1e-4;
  constexpr int kMost = 60;
  constexpr double kSettled = 1e-10;
  for (int i = 0; i < kMost; ++i) {
    const Eigen::MatrixXd jacobian = table_jacobian(problem, model, residuals);
    Eigen::MatrixXd normal = transposed_product(jacobian, jacobian);
    normal.diagonal() *= 1.0 + damping;
    const TableStep step = -solve_symmetric(normal, transposed_product(jacobian, residuals));
    const TableModel tried = model.moved(step);
    const Eigen::VectorXd next = residuals_of(problem, tried);
    if (next.squaredNorm() < residuals.squaredNorm()) {
      const double gain = 1.0 - next.squaredNorm() / residuals.squaredNorm();
      model = tried;
      residuals = next;
      damping *= 0.2;
      if (gain < kSettled) break;
    } else {
      damping *= 5.0;
      if (damping > 1e8) break;
    }
  }
  return residuals;
}

/// The pose of the board in one view, by the camera alone.
Eigen::Isometry3d seen_pose(const TableProblem& problem, const BoardView& view) {
  std::vector<cv::Point3d> plane;
  std::vector<cv::Point2d> rays;
  for (const BoardPoint& point : view.points) {
    const Eigen::Vector3d& place = problem.places[static_cast<std::size_t>(point.index)];
    const Eigen::Vector2d ray = problem.rig.reference().model.ray(point.camera_px);
    plane.emplace_back(place.x(), place.y(), 0.0);
    rays.emplace_back(ray.x(), ray.y());
  }
  cv::Mat turn;
  cv::Mat shift;
  const cv::Mat identity = cv::Mat::eye(3, 3, CV_64F);
  cv::solvePnP(plane, rays, identity, cv::noArray(), turn, shift, false, cv::SOLVEPNP_IPPE);
  cv::solvePnP(plane, rays, identity, cv::noArray(), turn, shift, true);
  const Eigen::Vector3d rotation(turn.at<double>(0), turn.at<double>(1), turn.at<double>(2));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (rotation.norm() > 0.0)
    pose.linear() = Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix();
  pose.translation() << shift.at<double>(0), shift.at<double>(1), shift.at<double>(2);
  return pose;
}

/// Axis, point and pose of the board from the poses of all views; the sign of the axis is that of
/// the turning, whatever the angles state.
TableModel start_of(const TableProblem& problem) {
  std::vector<Eigen::Isometry3d> poses;
  for (const BoardView& view : problem.views)
    poses.push_back(seen_pose(problem, view));
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const Eigen::Isometry3d step = poses[i] * poses[k].inverse();
      const Eigen::AngleAxisd turn(step.linear());
      const double stated = problem.angles_rad[i] - problem.angles_rad[k];
      const double wrapped = std::remainder(stated, kTwoPi);
      axis += (wrapped > 0.0 ? 1.0 : -1.0) * std::sin(turn.angle()) * turn.axis();
      // A point on the axis stays: (I - R) p = t.
      const Eigen::Matrix3d moved = Eigen::Matrix3d::Identity() - step.linear();
      normal += moved.transpose() * moved;
      right += moved.transpose() * step.translation();
    }
  }
  TableModel model;
  model.axis = axis.normalized();
  // Along the axis the point is free; it stays near the board.
  const Eigen::Vector3d board = poses.front().translation();
  const double weight = 1e-6 * normal.trace();
  normal += weight * model.axis * model.axis.transpose();
  right += weight * model.axis * model.axis.dot(board);
  model.point_mm = solve_symmetric(normal, right);
  model.rig_from_board = Eigen::Isometry3d::Identity();
  const TableModel turn_only = model;
  model.rig_from_board = turn_only.at(-problem.angles_rad[0]) * poses.front();
  return model;
}

/// Root mean square of the turns by which each view fits better than at its stated angle, about
/// their mean.
double angle_deviation_rad(const TableProblem& problem, const TableModel& model) {
  constexpr double kStep = 1e-5;  // rad
  std::vector<double> deviations;
  for (std::size_t view = 0; view < problem.views.size(); ++view) {
    std::vector<Eigen::Vector2d> here;
    std::vector<Eigen::Vector2d> there;
    std::vector<Eigen::Vector2d> observed;
    const double angle = problem.angles_rad[view];
    for_each_pixel(
        problem, view, model.at(angle), [&](const auto& seen, const auto& predicted, bool) {
          observed.push_back(seen);
          here.push_back(predicted);
        });
    for_each_pixel(
        problem, view, model.at(angle + kStep), [&](const auto&, const auto& predicted, bool) {
          there.push_back(predicted);
        });
    double product = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < here.size(); ++i) {
      const Eigen::Vector2d slope = (there[i] - here[i]) / kStep;
      product += slope.dot(observed[i] - here[i]);
      square += slope.squaredNorm();
    }
    deviations.push_back(product / square);
  }
  double mean = 0.0;
  for (const double deviation : deviations)
    mean += deviation / static_cast<double>(deviations.size());
  double sum = 0.0;
  for (const double deviation : deviations)
    sum += (deviation - mean) * (deviation - mean);
  return std::sqrt(sum / static_cast<double>(deviations.size()));
}

}  // namespace

TurntableSolution solve_turntable(const Board& board,
                                  std::span<const BoardView> views,
                                  std::span<const double> angles_rad,
                                  const Rig& rig) {
  check_board(board);
  require(views.size() == angles_rad.size(), "each view needs one angle");
  check_table_views(views, angles_rad);
  const auto* projector = std::get_if<PinholeModel>(&rig.projector.model);
  require(projector != nullptr, "a board on the turntable needs a digital projector");
  TableProblem problem{{}, views, angles_rad, rig, *projector};
  const std::vector<Eigen::Vector2d> nominal = board_points_mm(board);
  const Eigen::Vector2d center = 0.5 * (nominal.front() + nominal.back());
  for (const Eigen::Vector2d& place : nominal)
    problem.places.emplace_back(place.x() - center.x(), place.y() - center.y(), 0.0);

  TableModel model = start_of(problem);
  const Eigen::VectorXd residuals = adjust_table(problem, model);
  if (!residuals.allFinite())
    throw Error(ErrorKind::Numeric, "the axis of the turntable does not converge");
  TurntableSolution out;
  out.rig_from_board = model.rig_from_board;
  for (std::size_t view = 0; view < views.size(); ++view) {
    for_each_pixel(problem,
                   view,
                   model.at(angles_rad[view]),
                   [&](const auto& observed, const auto& predicted, bool by_projector) {
                     ResidualSummary& summary =
                         by_projector ? out.projector_residuals : out.camera_residuals;
                     const double distance = (observed - predicted).norm();
                     summary.rms_px += distance * distance;
                     summary.max_px = std::max(summary.max_px, distance);
                     ++summary.points;
                   });
  }
  for (ResidualSummary* summary : {&out.camera_residuals, &out.projector_residuals}) {
    if (summary->points > 0)
      summary->rms_px = std::sqrt(summary->rms_px / static_cast<double>(summary->points));
  }
  const Eigen::MatrixXd jacobian = table_jacobian(problem, model, residuals);
  const double variance =
      residuals.squaredNorm() / static_cast<double>(residuals.size() - kTableParameters);
  const Eigen::MatrixXd covariance =
      variance *
      solve_symmetric_columns(transposed_product(jacobian, jacobian),
                              Eigen::MatrixXd::Identity(kTableParameters, kTableParameters));
  out.axis_sigma_rad = std::sqrt(covariance.diagonal().head<2>().maxCoeff());
  out.point_sigma_mm = std::sqrt(covariance.diagonal().segment<2>(2).maxCoeff());
  out.angle_rms_rad = angle_deviation_rad(problem, model);
  // The foot of the axis below the board's lowest point.
  double lowest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& place : problem.places)
    lowest = std::min(lowest, model.axis.dot(model.rig_from_board * place - model.point_mm));
  out.turntable.axis = model.axis;
  out.turntable.axis_sigma_rad = out.axis_sigma_rad;
  out.turntable.point_sigma_mm = out.point_sigma_mm;
  out.turntable.angle_sigma_rad = out.angle_rms_rad;
  out.turntable.point_mm = model.point_mm + lowest * model.axis;
  return out;
}

}  // namespace frangia
