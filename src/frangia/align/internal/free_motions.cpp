#include "frangia/align/internal/free_motions.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frangia/align/internal/search_poses.h"
#include "frangia/core/angles.h"
#include "frangia/core/linear_algebra.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

constexpr double kWeak = 0.08;       ///< eigenvalue of a weak direction, of the largest
constexpr double kMostLost = 0.004;  ///< share of the samples that a free motion may cost
constexpr double kStayed = 0.5;      ///< share of the motion that must remain after the fit

std::string vector_text(const Vector3d& v, int decimals) {
  const auto number = [&](double value) {
    const std::string text = fmt::format("{:.{}f}", value, decimals);
    return text.find_first_not_of("-0.") == std::string::npos
               ? fmt::format("{:.{}f}", 0.0, decimals)
               : text;
  };
  return fmt::format("({}, {}, {})", number(v.x()), number(v.y()), number(v.z()));
}

}  // namespace

std::string FreeMotion::text() const {
  const Vector3d turn = twist.head<3>() / lever_mm;
  const Vector3d shift = twist.tail<3>();
  constexpr double kMostTurn = 0.05;  // of a translation
  if (twist.head<3>().norm() < kMostTurn)
    return fmt::format("translation along {}", vector_text(shift.normalized(), 4));
  const Vector3d axis = turn.normalized();
  // The point of the axis nearest to the center.
  const Vector3d point = center + turn.cross(shift) / turn.squaredNorm();
  const double pitch = shift.dot(axis) / turn.norm();
  const std::string place =
      fmt::format("about {} through {} mm", vector_text(axis, 4), vector_text(point, 3));
  return std::abs(pitch) > kMostTurn * lever_mm ? "screw motion " + place : "rotation " + place;
}

double share_within(std::span<const MeasuredSample> samples,
                    const FindFoot& find_foot,
                    const Eigen::Isometry3d& pose,
                    double within_mm) {
  std::size_t count = 0;
  for (const MeasuredSample& sample : samples) {
    const auto foot = find_foot(pose * sample.point_mm, within_mm);
    if (foot && (pose.linear() * sample.normal).dot(foot->normal) > 0.5) ++count;
  }
  return static_cast<double>(count) / static_cast<double>(samples.size());
}

std::vector<FreeMotion> free_motions(std::span<const MeasuredSample> samples,
                                     const FindFoot& find_foot,
                                     const PoseFit& fit,
                                     double within_mm,
                                     const Run& run) {
  const auto eigen = symmetric_eigen(Eigen::MatrixXd(fit.hessian));
  const double share = share_within(samples, find_foot, fit.pose, within_mm);
  std::vector<FreeMotion> motions;
  for (Eigen::Index i = 0; i < 6 && eigen.values[i] < kWeak * eigen.values[5]; ++i) {
    run.check();
    FreeMotion motion{eigen.vectors.col(i), fit.center, fit.lever_mm};
    bool free = true;
    for (const double sign : {1.0, -1.0}) {
      const double moved_mm = sign * std::max(0.12 * fit.lever_mm, 8.0 * within_mm);
      const Eigen::Isometry3d there = motion.by(moved_mm) * fit.pose;
      const PoseFit back = fit_pose(
          samples, find_foot, there, {.gate_mm = 8.0 * within_mm, .least_gate_mm = within_mm}, run);
      const double stayed = pose_distance_mm(samples, fit.pose, back.pose);
      free = free && stayed > kStayed * std::abs(moved_mm) &&
             share_within(samples, find_foot, back.pose, within_mm) > share - kMostLost;
    }
    if (free) motions.push_back(motion);
  }
  return motions;
}

bool is_reached(std::span<const MeasuredSample> samples,
                const std::vector<FreeMotion>& motions,
                const Eigen::Isometry3d& from,
                const Eigen::Isometry3d& to,
                double near_mm) {
  if (motions.empty()) return false;
  const std::size_t count = std::min<std::size_t>(samples.size(), 64);
  const auto columns = static_cast<Eigen::Index>(motions.size());
  constexpr int kStarts = 8;  // of a full turn of the first motion
  for (int start = 0; start < kStarts; ++start) {
    const double turn = std::max(motions.front().twist.head<3>().norm(), 0.1);
    Eigen::Isometry3d pose =
        motions.front().by(kTwoPi * start / kStarts * motions.front().lever_mm / turn) * from;
    for (int round = 0; round < 40; ++round) {
      // The combination of the free motions that brings the samples nearest to their goals.
      Eigen::MatrixXd left = Eigen::MatrixXd::Zero(columns, columns);
      Eigen::VectorXd right = Eigen::VectorXd::Zero(columns);
      for (std::size_t i = 0; i < count; ++i) {
        const Vector3d point = pose * samples[i].point_mm;
        const Vector3d way = to * samples[i].point_mm - point;
        Eigen::Matrix<double, 3, Eigen::Dynamic> flow(3, columns);
        for (Eigen::Index k = 0; k < columns; ++k) {
          const FreeMotion& motion = motions[static_cast<std::size_t>(k)];
          flow.col(k) = (motion.twist.head<3>() / motion.lever_mm).cross(point - motion.center) +
                        Vector3d(motion.twist.tail<3>());
        }
        left += flow.transpose() * flow;
        right += flow.transpose() * way;
      }
      left.diagonal().array() += 1e-9 * left.trace();
      const Eigen::VectorXd step = solve_symmetric(left, right);
      Eigen::Matrix<double, 6, 1> twist = Eigen::Matrix<double, 6, 1>::Zero();
      for (Eigen::Index k = 0; k < columns; ++k)
        twist += step[k] * motions[static_cast<std::size_t>(k)].twist;
      pose = motion_of(twist, motions.front().center, motions.front().lever_mm) * pose;
      if (step.norm() < 1e-3 * near_mm) break;
    }
    if (pose_distance_mm(samples, pose, to) < near_mm) return true;
  }
  return false;
}

}  // namespace frangia
