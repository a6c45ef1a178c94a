#include "frangia/registration/view_group.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "frangia/core/parallel.h"
#include "frangia/core/solve_symmetric.h"
#include "frangia/core/symmetric_eigen.h"

namespace frangia {
namespace {

constexpr double kSameSide = 0.7;  // cosine between normals of one surface
constexpr std::size_t kChunk = 256;

/// What the views of a group say to one point.
struct PointComparison {
  bool agrees = false;
  bool violates = false;
  double distance_mm = 0.0;  ///< of the nearest surface that agrees, with sign
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/// One direction of a comparison.
struct Tally {
  std::size_t agree = 0;
  std::size_t violations = 0;
  std::vector<double> distances_mm;
  double weight = 0.0;
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();

  void add(const Tally& other) {
    agree += other.agree;
    violations += other.violations;
    distances_mm.insert(distances_mm.end(), other.distances_mm.begin(), other.distances_mm.end());
    weight += other.weight;
    information += other.information;
    gradient += other.gradient;
  }
};

const SurfelMap::Surfel* surfel_at(const SurfelMap& map,
                                   const FastCameraModel& model,
                                   const Eigen::Vector3d& at) {
  if (!(at.z() > 0.0)) return nullptr;
  const Eigen::Vector3f point = at.cast<float>();
  float u = 0.0F;
  float v = 0.0F;
  model.project(point.x(), point.y(), point.z(), u, v);
  const auto stride = static_cast<float>(map.stride);
  const float column = std::round(u / stride);
  const float row = std::round(v / stride);
  const bool within = column >= 0.0F && row >= 0.0F &&
                      column < static_cast<float>(map.surfels.width()) &&
                      row < static_cast<float>(map.surfels.height());
  if (!within) return nullptr;
  const SurfelMap::Surfel& surfel = map.surfels(static_cast<int>(column), static_cast<int>(row));
  return surfel.sigma_mm > 0.0F ? &surfel : nullptr;
}

/// Asks every view of a group about a point of its frame.
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
    const Eigen::Vector3d normal = surfel->normal.cast<double>();
    const Eigen::Vector3d turned = member.rig_from_group.linear() * facing;
    const Eigen::Vector3d away = seen - surfel->point_mm.cast<double>();
    if (std::abs(normal.dot(away)) < gate_mm && normal.dot(turned) > kSameSide) {
      const Eigen::Vector3d between = (normal + turned).normalized();
      const double distance_mm = between.dot(away);
      if (!comparison.agrees || std::abs(distance_mm) < std::abs(comparison.distance_mm)) {
        comparison.distance_mm = distance_mm;
        comparison.normal = member.rig_from_group.linear().transpose() * between;
      }
      comparison.agrees = true;
    } else if (normal.dot(away) > gate_mm && -away.z() > gate_mm) {
      comparison.violates = true;  // nearer to the camera than what it saw
    }
  }
  return comparison;
}

/// Points of one group target of the other; `sign` is -1 when it is the other that is to be moved.
struct Direction {
  const SurfacePoints& points;
  Eigen::Isometry3d target_from_points;
  const ViewGroup& target;
  Eigen::Isometry3d fixed_from_target;
  double sign;
};

Tally tally(const Direction& way, const GroupViews& views, double gate_mm, const GroupFit& fit) {
  const std::size_t count = way.points.size();
  std::vector<Tally> parts((count + kChunk - 1) / kChunk);
  parallel_chunks(count, kChunk, [&](std::size_t begin, std::size_t end) {
    Tally& part = parts[begin / kChunk];
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
      const double ratio = comparison.distance_mm / gate_mm;
      if (!(std::abs(ratio) < 1.0)) continue;
      const double tukey_weight = (1.0 - ratio * ratio) * (1.0 - ratio * ratio);
      const Eigen::Vector3d normal = way.fixed_from_target.linear() * comparison.normal;
      const Eigen::Vector3d arm = way.fixed_from_target * point - fit.center_mm;
      Eigen::Matrix<double, 6, 1> row;
      row << normal, arm.cross(normal) / fit.arm_mm;
      row *= way.sign;
      part.weight += tukey_weight;
      part.information += tukey_weight * row * row.transpose();
      part.gradient += tukey_weight * comparison.distance_mm * row;
    }
  });
  Tally all;
  for (const Tally& part : parts)
    all.add(part);
  return all;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void find_center(GroupFit& fit, const SurfacePoints& points, const Eigen::Isometry3d& move) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares = 0.0;
  for (const auto& point : points.points_mm)
    sum += point.cast<double>();
  const auto count = static_cast<double>(std::max<std::size_t>(1, points.size()));
  const Eigen::Vector3d middle = sum / count;
  for (const auto& point : points.points_mm)
    squares += (point.cast<double>() - middle).squaredNorm();
  fit.center_mm = move * middle;
  fit.arm_mm = std::max(1e-9, std::sqrt(squares / count));
}

/// Of all members, in the group's frame.
SurfacePoints points_of(const std::vector<ViewGroup::Member>& members,
                        std::span<const SurfelMap> maps) {
  constexpr std::size_t kSurfels = 40000;
  SurfacePoints points;
  for (const ViewGroup::Member& member : members) {
    const Eigen::Isometry3f group_from_rig = member.rig_from_group.inverse().cast<float>();
    for (const SurfelMap::Surfel& surfel : pick_surfels(maps[member.view], kSurfels))
      points.add(group_from_rig * surfel.point_mm, group_from_rig.linear() * surfel.normal);
  }
  return points;
}

/// Enough to settle a place: about 1200 of the points, evenly.
ViewGroup with_fewer_points(const ViewGroup& group) {
  constexpr std::size_t kEnough = 1200;
  const std::size_t every = std::max<std::size_t>(1, group.points.size() / kEnough);
  ViewGroup fewer{group.members, {}};
  for (std::size_t i = 0; i < group.points.size(); i += every)
    fewer.points.add(group.points.points_mm[i], group.points.normals[i]);
  return fewer;
}

}  // namespace

ViewGroup make_group(std::vector<ViewGroup::Member> members,
                     std::span<const SurfelMap> maps,
                     double spacing_mm) {
  ViewGroup group;
  group.points = voxel_downsample(points_of(members, maps), spacing_mm);
  group.members = std::move(members);
  return group;
}

double spacing_for(std::span<const std::vector<ViewGroup::Member>> groups,
                   std::span<const SurfelMap> maps) {
  constexpr double kShare = 1.0 / 50.0;
  std::vector<double> sizes;
  for (const auto& members : groups) {
    Eigen::AlignedBox3f box;
    for (const auto& point : points_of(members, maps).points_mm)
      box.extend(point);
    if (!box.isEmpty()) sizes.push_back(static_cast<double>(box.diagonal().norm()));
  }
  if (sizes.empty()) return 1.0;
  std::nth_element(
      sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2), sizes.end());
  return kShare * sizes[sizes.size() / 2];
}

Eigen::Isometry3d GroupFit::motion(const Eigen::Matrix<double, 6, 1>& step) const {
  const Eigen::Vector3d turn = step.tail<3>() / arm_mm;
  Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
  if (turn.norm() > 0.0)
    move.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  move.translation() = center_mm + step.head<3>() - move.linear() * center_mm;
  return move;
}

GroupFit compare_groups(const ViewGroup& to,
                        const ViewGroup& from,
                        const Eigen::Isometry3d& to_from,
                        const GroupViews& views,
                        double gate_mm) {
  GroupFit fit;
  find_center(fit, from.points, to_from);
  const Eigen::Isometry3d still = Eigen::Isometry3d::Identity();
  Tally all = tally({from.points, to_from, to, still, 1.0}, views, gate_mm, fit);
  all.add(tally({to.points, to_from.inverse(), from, to_from, -1.0}, views, gate_mm, fit));
  fit.agree = all.agree;
  fit.violations = all.violations;
  const std::size_t smaller = std::min(to.points.size(), from.points.size());
  if (smaller > 0) {
    fit.overlap =
        std::min(1.0, 0.5 * static_cast<double>(all.agree) / static_cast<double>(smaller));
  }
  fit.residual_mm = median(all.distances_mm);
  fit.information = all.information;
  fit.gradient = all.gradient;
  if (all.weight > 0.0) {
    const auto eigen = symmetric_eigen(Eigen::MatrixXd(all.information / all.weight));
    fit.smallest_eigenvalue = std::max(0.0, eigen.values[0]);
    fit.weakest_directions = eigen.vectors.leftCols<2>();
  }
  return fit;
}

Eigen::Isometry3d refine_fit(const ViewGroup& all_to,
                             const ViewGroup& all_from,
                             Eigen::Isometry3d to_from,
                             const GroupViews& views,
                             const GateRange& gate) {
  const ViewGroup to = with_fewer_points(all_to);
  const ViewGroup from = with_fewer_points(all_from);
  constexpr double kTukey = 4.685 * 1.4826;
  constexpr int kMost = 25;
  double gate_mm = gate.widest_mm;
  for (int i = 0; i < kMost; ++i) {
    const GroupFit fit = compare_groups(to, from, to_from, views, gate_mm);
    if (fit.agree < 6) break;
    Eigen::Matrix<double, 6, 6> information = fit.information;
    information.diagonal().array() += 1e-6 * information.trace();  // what slides stays
    const Eigen::Matrix<double, 6, 1> step = -solve_symmetric(information, fit.gradient);
    to_from = fit.motion(step) * to_from;
    const double closed = std::max(gate.least_mm, kTukey * fit.residual_mm);
    const bool gate_converged = closed > 0.9 * gate_mm;
    gate_mm = std::min(gate_mm, closed);
    if (gate_converged && step.norm() < 1e-3 * gate.least_mm) break;
  }
  return to_from;
}

ViewGroup join_groups(const ViewGroup& to,
                      const ViewGroup& from,
                      const Eigen::Isometry3d& to_from) {
  ViewGroup both = to;
  for (const ViewGroup::Member& member : from.members)
    both.members.push_back({member.view, member.rig_from_group * to_from.inverse()});
  both.points.add(from.points, to_from);
  return both;
}

}  // namespace frangia
