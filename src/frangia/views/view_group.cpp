#include "frangia/views/view_group.h"

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
struct Verdict {
  bool agrees = false;
  bool against = false;
  double distance_mm = 0.0;  ///< of the nearest surface that agrees, with sign
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/// One direction of a comparison.
struct Tally {
  std::size_t agree = 0;
  std::size_t against = 0;
  std::vector<double> distances_mm;
  double weight = 0.0;
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> pull = Eigen::Matrix<double, 6, 1>::Zero();

  void add(const Tally& other) {
    agree += other.agree;
    against += other.against;
    distances_mm.insert(distances_mm.end(), other.distances_mm.begin(), other.distances_mm.end());
    weight += other.weight;
    information += other.information;
    pull += other.pull;
  }
};

const PlaneMap::Spot* spot_at(const PlaneMap& map,
                              const FastLens& lens,
                              const Eigen::Vector3d& at) {
  if (!(at.z() > 0.0)) return nullptr;
  const Eigen::Vector3f point = at.cast<float>();
  float u = 0.0F;
  float v = 0.0F;
  lens.project(point.x(), point.y(), point.z(), u, v);
  const auto stride = static_cast<float>(map.stride);
  const float column = std::round(u / stride);
  const float row = std::round(v / stride);
  const bool within = column >= 0.0F && row >= 0.0F &&
                      column < static_cast<float>(map.spots.width()) &&
                      row < static_cast<float>(map.spots.height());
  if (!within) return nullptr;
  const PlaneMap::Spot& spot = map.spots(static_cast<int>(column), static_cast<int>(row));
  return spot.sigma_mm > 0.0F ? &spot : nullptr;
}

/// Asks every view of a group about a point of its frame.
Verdict ask(const ViewGroup& group,
            const Eigen::Vector3d& point,
            const Eigen::Vector3d& facing,
            const GroupViews& views,
            double gate_mm) {
  Verdict verdict;
  for (const ViewGroup::Member& member : group.members) {
    const Eigen::Vector3d seen = member.rig_from_group * point;
    const PlaneMap::Spot* spot = spot_at(views.maps[member.view], views.lens, seen);
    if (spot == nullptr) continue;
    const Eigen::Vector3d normal = spot->normal.cast<double>();
    const Eigen::Vector3d turned = member.rig_from_group.linear() * facing;
    const Eigen::Vector3d away = seen - spot->point_mm.cast<double>();
    if (std::abs(normal.dot(away)) < gate_mm && normal.dot(turned) > kSameSide) {
      const Eigen::Vector3d between = (normal + turned).normalized();
      const double distance_mm = between.dot(away);
      if (!verdict.agrees || std::abs(distance_mm) < std::abs(verdict.distance_mm)) {
        verdict.distance_mm = distance_mm;
        verdict.normal = member.rig_from_group.linear().transpose() * between;
      }
      verdict.agrees = true;
    } else if (normal.dot(away) > gate_mm && -away.z() > gate_mm) {
      verdict.against = true;  // nearer to the camera than what it saw
    }
  }
  return verdict;
}

/// Points of one group asked of the other; `sign` is -1 when it is the other that is to be moved.
struct Direction {
  const SurfacePoints& points;
  Eigen::Isometry3d asked_from_points;
  const ViewGroup& asked;
  Eigen::Isometry3d fixed_from_asked;
  double sign;
};

Tally tally(const Direction& way, const GroupViews& views, double gate_mm, const GroupFit& fit) {
  const std::size_t count = way.points.size();
  std::vector<Tally> parts((count + kChunk - 1) / kChunk);
  parallel_chunks(count, kChunk, [&](std::size_t begin, std::size_t end) {
    Tally& part = parts[begin / kChunk];
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d point = way.asked_from_points * way.points.points_mm[i].cast<double>();
      const Eigen::Vector3d facing =
          way.asked_from_points.linear() * way.points.normals[i].cast<double>();
      const Verdict verdict = ask(way.asked, point, facing, views, gate_mm);
      if (!verdict.agrees) {
        part.against += verdict.against ? 1U : 0U;
        continue;
      }
      ++part.agree;
      part.distances_mm.push_back(std::abs(verdict.distance_mm));
      const double ratio = verdict.distance_mm / gate_mm;
      if (!(std::abs(ratio) < 1.0)) continue;
      const double trust = (1.0 - ratio * ratio) * (1.0 - ratio * ratio);
      const Eigen::Vector3d normal = way.fixed_from_asked.linear() * verdict.normal;
      const Eigen::Vector3d arm = way.fixed_from_asked * point - fit.centre_mm;
      Eigen::Matrix<double, 6, 1> row;
      row << normal, arm.cross(normal) / fit.arm_mm;
      row *= way.sign;
      part.weight += trust;
      part.information += trust * row * row.transpose();
      part.pull += trust * verdict.distance_mm * row;
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

void find_middle(GroupFit& fit, const SurfacePoints& points, const Eigen::Isometry3d& move) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares = 0.0;
  for (const auto& point : points.points_mm)
    sum += point.cast<double>();
  const auto count = static_cast<double>(std::max<std::size_t>(1, points.size()));
  const Eigen::Vector3d middle = sum / count;
  for (const auto& point : points.points_mm)
    squares += (point.cast<double>() - middle).squaredNorm();
  fit.centre_mm = move * middle;
  fit.arm_mm = std::max(1e-9, std::sqrt(squares / count));
}

/// Of all members, in the group's frame.
SurfacePoints points_of(const std::vector<ViewGroup::Member>& members,
                        std::span<const PlaneMap> maps) {
  constexpr std::size_t kSpots = 40000;
  SurfacePoints points;
  for (const ViewGroup::Member& member : members) {
    const Eigen::Isometry3f group_from_rig = member.rig_from_group.inverse().cast<float>();
    for (const PlaneMap::Spot& spot : pick_spots(maps[member.view], kSpots))
      points.add(group_from_rig * spot.point_mm, group_from_rig.linear() * spot.normal);
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
                     std::span<const PlaneMap> maps,
                     double spacing_mm) {
  ViewGroup group;
  group.points = thin_points(points_of(members, maps), spacing_mm);
  group.members = std::move(members);
  return group;
}

double spacing_for(std::span<const std::vector<ViewGroup::Member>> groups,
                   std::span<const PlaneMap> maps) {
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
  move.translation() = centre_mm + step.head<3>() - move.linear() * centre_mm;
  return move;
}

GroupFit compare_groups(const ViewGroup& to,
                        const ViewGroup& from,
                        const Eigen::Isometry3d& to_from,
                        const GroupViews& views,
                        double gate_mm) {
  GroupFit fit;
  find_middle(fit, from.points, to_from);
  const Eigen::Isometry3d still = Eigen::Isometry3d::Identity();
  Tally all = tally({from.points, to_from, to, still, 1.0}, views, gate_mm, fit);
  all.add(tally({to.points, to_from.inverse(), from, to_from, -1.0}, views, gate_mm, fit));
  fit.agree = all.agree;
  fit.against = all.against;
  const std::size_t smaller = std::min(to.points.size(), from.points.size());
  if (smaller > 0) {
    fit.overlap =
        std::min(1.0, 0.5 * static_cast<double>(all.agree) / static_cast<double>(smaller));
  }
  fit.residual_mm = median(all.distances_mm);
  fit.information = all.information;
  fit.pull = all.pull;
  if (all.weight > 0.0) {
    const auto eigen = symmetric_eigen(Eigen::MatrixXd(all.information / all.weight));
    fit.firmness = std::max(0.0, eigen.values[0]);
    fit.loosest = eigen.vectors.leftCols<2>();
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
    const Eigen::Matrix<double, 6, 1> step = -solve_symmetric(information, fit.pull);
    to_from = fit.motion(step) * to_from;
    const double closed = std::max(gate.least_mm, kTukey * fit.residual_mm);
    const bool rests = closed > 0.9 * gate_mm;
    gate_mm = std::min(gate_mm, closed);
    if (rests && step.norm() < 1e-3 * gate.least_mm) break;
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
