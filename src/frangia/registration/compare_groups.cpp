#include "frangia/registration/compare_groups.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "frangia/core/linear_algebra.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/robust_gauss_newton.h"
#include "frangia/registration/internal/surfel_pair.h"

namespace frangia {
namespace {

constexpr std::size_t kPointsPerChunk =
    256;  // points; fixed, so that sums do not depend on threads

/// A point compared with all views of a group.
struct PointComparison {
  bool agrees = false;
  bool violates = false;
  double distance_mm = 0.0;                          ///< signed, of the nearest surface that agrees
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< in the group's frame
};

/// Sums over the points of one group.
struct GroupTally {
  std::size_t agree = 0;
  std::size_t violations = 0;
  std::vector<double> distances_mm;
  double weight = 0.0;
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();

  void add(const GroupTally& other) {
    agree += other.agree;
    violations += other.violations;
    distances_mm.insert(distances_mm.end(), other.distances_mm.begin(), other.distances_mm.end());
    weight += other.weight;
    information += other.information;
    gradient += other.gradient;
  }
};

PointComparison compare_point(const ViewGroup& group,
                              const Eigen::Vector3d& point,
                              const Eigen::Vector3d& facing,
                              const GroupViews& views,
                              double gate_mm) {
  PointComparison comparison;
  for (const ViewGroup::Member& member : group.members) {
    const Eigen::Vector3d seen = member.rig_from_group * point;
    const SurfelMap::Surfel* surfel = surfel_at(views.maps[member.view], views.model, seen);
    if (surfel == nullptr) continue;
    const SurfelPair pair(seen, member.rig_from_group.linear() * facing, *surfel);
    if (std::abs(pair.target_normal.dot(pair.offset)) < gate_mm && pair.faces_alike()) {
      const double distance_mm = pair.distance_mm();
      if (!comparison.agrees || std::abs(distance_mm) < std::abs(comparison.distance_mm)) {
        comparison.distance_mm = distance_mm;
        comparison.normal = member.rig_from_group.linear().transpose() * pair.normal;
      }
      comparison.agrees = true;
    } else if (pair.violates_free_space(gate_mm)) {
      comparison.violates = true;
    }
  }
  return comparison;
}

/// Points of one group compared with the views of the target group. `sign` is -1 when the target
/// is the group that moves.
struct Direction {
  const SurfacePoints& points;
  Eigen::Isometry3d target_from_points;
  const ViewGroup& target;
  Eigen::Isometry3d fixed_from_target;
  double sign;
};

GroupTally tally(const Direction& way,
                 const GroupViews& views,
                 double gate_mm,
                 const GroupFit& fit) {
  const std::size_t count = way.points.size();
  std::vector<GroupTally> parts((count + kPointsPerChunk - 1) / kPointsPerChunk);
  parallel_chunks(count, kPointsPerChunk, [&](std::size_t begin, std::size_t end) {
    GroupTally& part = parts[begin / kPointsPerChunk];
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d point = way.target_from_points * way.points.points_mm[i].cast<double>();
      const Eigen::Vector3d facing =
          way.target_from_points.linear() * way.points.normals[i].cast<double>();
      const PointComparison comparison = compare_point(way.target, point, facing, views, gate_mm);
      if (!comparison.agrees) {
        part.violations += comparison.violates ? 1U : 0U;
        continue;
      }
      ++part.agree;
      part.distances_mm.push_back(std::abs(comparison.distance_mm));
      const double weight = tukey_weight(comparison.distance_mm, gate_mm);
      const Eigen::Vector3d normal = way.fixed_from_target.linear() * comparison.normal;
      const Eigen::Vector3d arm = way.fixed_from_target * point - fit.center_mm;
      Eigen::Matrix<double, 6, 1> row;
      row << normal, arm.cross(normal) / fit.arm_mm;
      row *= way.sign;
      part.weight += weight;
      part.information += weight * row * row.transpose();
      part.gradient += weight * comparison.distance_mm * row;
    }
  });
  GroupTally all;
  for (const GroupTally& part : parts)
    all.add(part);
  return all;
}

void find_center(GroupFit& fit, const SurfacePoints& points, const Eigen::Isometry3d& move) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares = 0.0;
  for (const auto& point : points.points_mm)
    sum += point.cast<double>();
  const auto count = static_cast<double>(std::max<std::size_t>(1, points.size()));
  const Eigen::Vector3d centroid = sum / count;
  for (const auto& point : points.points_mm)
    squares += (point.cast<double>() - centroid).squaredNorm();
  fit.center_mm = move * centroid;
  fit.arm_mm = squares > 0.0 ? std::sqrt(squares / count) : 1.0;
}

/// About 1200 of the points, evenly picked: enough for the refinement of a pose.
ViewGroup with_fewer_points(const ViewGroup& group) {
  constexpr std::size_t kEnough = 1200;
  const std::size_t every = std::max<std::size_t>(1, group.points.size() / kEnough);
  ViewGroup fewer{group.members, {}};
  for (std::size_t i = 0; i < group.points.size(); i += every)
    fewer.points.add(group.points.points_mm[i], group.points.normals[i]);
  return fewer;
}

}  // namespace

Eigen::Isometry3d GroupFit::motion(const Eigen::Matrix<double, 6, 1>& step) const {
  const Eigen::Vector3d turn = step.tail<3>() / arm_mm;
  Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
  if (turn.norm() > 0.0)
    move.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  move.translation() = center_mm + step.head<3>() - move.linear() * center_mm;
  return move;
}

std::optional<Eigen::ParametrizedLine<double, 3>> GroupFit::weakest_axis() const {
  constexpr double kSlides = 0.1;  // way along the axis, over that of the turn
  const Eigen::Vector3d shift = weakest_directions.col(0).head<3>();
  const Eigen::Vector3d arc = weakest_directions.col(0).tail<3>();
  if (arc.norm() <= shift.norm() || std::abs(shift.dot(arc)) >= kSlides * arc.squaredNorm())
    return std::nullopt;
  const Eigen::Vector3d turn = arc / arm_mm;
  return Eigen::ParametrizedLine<double, 3>(center_mm + turn.cross(shift) / turn.squaredNorm(),
                                            turn.normalized());
}

GroupFit compare_groups(const ViewGroup& to,
                        const ViewGroup& from,
                        const Eigen::Isometry3d& to_from,
                        const GroupViews& views,
                        double gate_mm) {
  GroupFit fit;
  find_center(fit, from.points, to_from);
  const Eigen::Isometry3d identity = Eigen::Isometry3d::Identity();
  GroupTally all = tally({from.points, to_from, to, identity, 1.0}, views, gate_mm, fit);
  all.add(tally({to.points, to_from.inverse(), from, to_from, -1.0}, views, gate_mm, fit));
  fit.agree = all.agree;
  fit.violations = all.violations;
  const std::size_t smaller = std::min(to.points.size(), from.points.size());
  if (smaller > 0) {
    fit.overlap =
        std::min(1.0, 0.5 * static_cast<double>(all.agree) / static_cast<double>(smaller));
  }
  fit.residual_mm = median(std::move(all.distances_mm));
  fit.information = all.information;
  fit.gradient = all.gradient;
  if (all.weight > 0.0) {
    const auto eigen = symmetric_eigen(Eigen::MatrixXd(all.information / all.weight));
    fit.smallest_eigenvalue = std::max(0.0, eigen.values[0]);
    fit.second_eigenvalue = std::max(0.0, eigen.values[1]);
    fit.weakest_directions = eigen.vectors.leftCols<2>();
  }
  return fit;
}

Eigen::Isometry3d refine_fit(const ViewGroup& all_to,
                             const ViewGroup& all_from,
                             Eigen::Isometry3d to_from,
                             const GroupViews& views,
                             const GateRange& gate) {
  constexpr std::size_t kFewest = 6;           // points that agree: as many as unknowns
  constexpr double kSigmaFromMedian = 1.4826;  // of the absolute values of normal residuals
  const ViewGroup to = with_fewer_points(all_to);
  const ViewGroup from = with_fewer_points(all_from);
  GroupFit fit;
  const auto linearize = [&](double gate_mm) {
    fit = compare_groups(to, from, to_from, views, gate_mm);
    return Linearization{fit.information,
                         fit.gradient,
                         fit.residual_mm,
                         kSigmaFromMedian * fit.residual_mm,
                         fit.agree >= kFewest};
  };
  const auto update = [&](const Eigen::VectorXd& step) { to_from = fit.motion(step) * to_from; };
  // A start for a registration of all views needs no more than half a standard deviation. The
  // damping holds groups that slide on each other.
  static_cast<void>(minimize_robustly({linearize, update},
                                      {.gate = gate.widest_mm,
                                       .min_gate = gate.least_mm,
                                       .max_iterations = 25,
                                       .tolerance = 0.5,
                                       .damping = 1e-5}));
  return to_from;
}

}  // namespace frangia
