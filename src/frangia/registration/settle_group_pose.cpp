#include "frangia/registration/settle_group_pose.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/registration/compare_groups.h"
#include "frangia/registration/pose_contradictions.h"

namespace frangia {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Natural logarithm of the odds from which on another pose is taken: 100 : 1.
constexpr double kDecided = 4.605;
/// Information below which a motion hardly changes distances, over that of a motion along the
/// normals: as `JoinByShapeOptions::well_constrained`. A keyway holds the turn of a shaft by 0.005.
constexpr double kWeak = 0.02;
constexpr double kGate = 0.3;  ///< spacings, as in the pose search
constexpr double kStep = 1.0;  ///< spacings from pose to pose: refined poses agree within a gate

/// Some of a group's points, which follow a motion.
ViewGroup with_some_points(const ViewGroup& group) {
  constexpr std::size_t kSome = 500;
  const std::size_t every = std::max<std::size_t>(1, group.points.size() / kSome);
  ViewGroup some{group.members, {}};
  for (std::size_t i = 0; i < group.points.size(); i += every)
    some.points.add(group.points.points_mm[i], group.points.normals[i]);
  return some;
}

/// Root mean square way of points from one pose to another.
double way_mm(const SurfacePoints& points,
              const Eigen::Isometry3d& one,
              const Eigen::Isometry3d& other) {
  double squares = 0.0;
  for (const Eigen::Vector3f& point : points.points_mm)
    squares += (one * point.cast<double>() - other * point.cast<double>()).squaredNorm();
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, points.size())));
}

/// The motions that hardly change the distances of a fit: an orthonormal basis, the weakest first.
Eigen::Matrix<double, 6, Eigen::Dynamic> weak_motions(const GroupFit& fit) {
  const double weight = fit.information.topLeftCorner<3, 3>().trace();  // normals are unit
  if (!(weight > 0.0)) return Eigen::Matrix<double, 6, Eigen::Dynamic>(6, 0);
  const auto eigen = symmetric_eigen(Eigen::MatrixXd(fit.information / weight));
  Eigen::Index count = 0;
  while (count < 6 && eigen.values[count] < kWeak)
    ++count;
  return eigen.vectors.leftCols(count);
}

/// A pose on the way along a weak motion.
struct PoseOnWay {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  double way_mm = 0.0;    ///< from the start, signed
  double share_mm = 0.0;  ///< of the way for which it stands
  PatchCount count;
};

/// Follows one weak motion of a group on another.
class OpenWay {
 public:
  OpenWay(const ViewGroup& to, const ViewGroup& from, const GroupViews& views, double spacing_mm)
      : to_(with_some_points(to)),
        from_(with_some_points(from)),
        views_(views),
        spacing_mm_(spacing_mm) {}

  [[nodiscard]] GroupFit fit(const Eigen::Isometry3d& pose) const {
    return compare_groups(to_, from_, pose, views_, kGate * spacing_mm_);
  }
  [[nodiscard]] Eigen::Isometry3d refined(const Eigen::Isometry3d& pose) const {
    return refine_fit(to_, from_, pose, views_, {2.0 * kGate * spacing_mm_, kGate * spacing_mm_});
  }
  [[nodiscard]] double way(const Eigen::Isometry3d& one, const Eigen::Isometry3d& other) const {
    return way_mm(from_.points, one, other);
  }

  /// Poses from the start along a motion, both ways or once around; the start is not among them.
  [[nodiscard]] std::vector<PoseOnWay> follow(const Eigen::Isometry3d& start,
                                              const Vector6& motion,
                                              const Run& run) const {
    bool closed = false;
    std::vector<PoseOnWay> all = follow_one_way(start, motion, closed, run);
    if (closed) return all;
    for (PoseOnWay& pose : follow_one_way(start, -motion, closed, run)) {
      pose.way_mm = -pose.way_mm;
      all.push_back(pose);
    }
    return all;
  }

 private:
  [[nodiscard]] std::vector<PoseOnWay> follow_one_way(const Eigen::Isometry3d& start,
                                                      Vector6 motion,
                                                      bool& closed,
                                                      const Run& run) const {
    constexpr double kLeftOver = 0.5;  // of the overlap: beyond, the group has slid off
    constexpr std::size_t kMost = 400;
    std::vector<PoseOnWay> poses;
    const double step_mm = kStep * spacing_mm_;
    GroupFit at = fit(start);
    const double least_overlap = kLeftOver * at.overlap;
    Eigen::Isometry3d pose = start;
    double so_far_mm = 0.0;
    const double turn_mm = kTwoPi * at.arm_mm;
    while (poses.size() < kMost && so_far_mm < turn_mm) {
      run.check();
      const Eigen::Isometry3d next = next_pose(pose, at, motion, step_mm);
      const double stepped_mm = way(next, pose);
      pose = next;
      at = fit(pose);
      if (at.overlap < least_overlap) break;
      so_far_mm += stepped_mm;
      if (poses.size() > 6 && way(pose, start) < 0.75 * step_mm) {
        closed = true;
        break;
      }
      poses.push_back({pose, so_far_mm, stepped_mm, {}});
      const auto weak = weak_motions(at);
      if (weak.cols() == 0) break;
      const Vector6 along = weak * (weak.transpose() * motion);
      if (along.norm() < 0.3) break;
      motion = along.normalized();
    }
    return poses;
  }

  /// The next pose along a motion, with the rest fitted again. What holds the motion itself, such
  /// as a keyway that comes near, must not draw the group back.
  [[nodiscard]] Eigen::Isometry3d next_pose(const Eigen::Isometry3d& pose,
                                            const GroupFit& at,
                                            const Vector6& motion,
                                            double step_mm) const {
    const Eigen::Isometry3d there = at.motion(step_mm * motion) * pose;
    const Eigen::Isometry3d by = refined(there) * there.inverse();
    const Eigen::AngleAxisd turn(by.rotation());
    Vector6 step;
    step << by * at.center_mm - at.center_mm, at.arm_mm * turn.angle() * turn.axis();
    const auto weak = weak_motions(at);
    step -= weak * (weak.transpose() * step);
    step -= motion * motion.dot(step);
    return at.motion(step) * there;
  }

  ViewGroup to_;
  ViewGroup from_;
  GroupViews views_;
  double spacing_mm_;
};

/// The motion of one standard deviation along a weak motion. `way`: of the points for each mm of
/// the motion.
OpenMotion open_motion(const GroupFit& at, const Vector6& motion, double spread_mm, double way) {
  OpenMotion open;
  const Eigen::Vector3d turn = spread_mm / way * motion.tail<3>() / at.arm_mm;
  const Eigen::Vector3d shift = spread_mm / way * motion.head<3>();
  open.motion << turn, shift - turn.cross(at.center_mm);
  open.spread_mm = spread_mm;
  open.turns = motion.tail<3>().norm() > motion.head<3>().norm();
  open.axis = (open.turns ? motion.tail<3>() : motion.head<3>()).normalized();
  return open;
}

/// Settles the pose along each weak motion in turn.
class PoseSettler {
 public:
  PoseSettler(const ViewGroup& to,
              const ViewGroup& from,
              const Eigen::Isometry3d& start,
              const GroupViews& views,
              const SettleOptions& options,
              const Run& run)
      : options_(options),
        run_(run),
        start_(start),
        way_(to, from, views, options.spacing_mm),
        contradictions_(to, from, views, options.spacing_mm, start) {
    settled_.to_from = start;
  }

  SettledPose settle() {
    const GroupFit first = way_.fit(start_);
    const auto weak = weak_motions(first);
    if (weak.cols() == 0) return settled_;
    start_count_ = count_ = contradictions_.count(start_);
    constexpr int kRounds = 3;  // where one motion is wrong, the others cannot be settled
    bool moved = true;
    for (int round = 0; round < kRounds && moved; ++round) {
      settled_.open.clear();
      settled_.held.clear();
      moved = false;
      for (Eigen::Index i = 0; i < weak.cols(); ++i)
        moved = settle_along(i) || moved;
    }
    settled_.log_odds = log_odds_of(count_, start_count_);
    if (!settled_.to_from.isApprox(start_, 0.0))
      settled_.moved_mm = way_.way(settled_.to_from, start_);
    return settled_;
  }

 private:
  /// Settles one weak motion. Returns whether the group moved.
  bool settle_along(Eigen::Index number) {
    GroupFit at = way_.fit(settled_.to_from);
    auto weak = weak_motions(at);
    if (number >= weak.cols()) return false;
    Vector6 motion = weak.col(number);
    std::vector<PoseOnWay> poses = way_.follow(settled_.to_from, motion, run_);
    for (PoseOnWay& pose : poses) {
      pose.count = contradictions_.count(pose.pose);
      // Within reach of what holds the motion, the fit of all finds it.
      const Eigen::Isometry3d held = way_.refined(pose.pose);
      const PatchCount count = contradictions_.count(held);
      if (count.contradicting >= pose.count.contradicting) continue;
      pose.pose = held;
      pose.count = count;
    }
    const bool moved = take_better(poses, motion);
    if (moved) {
      at = way_.fit(settled_.to_from);
      weak = weak_motions(at);
      if (weak.cols() == 0) return true;
      motion = (weak * (weak.transpose() * motion)).normalized();
    }
    const double step_mm = kStep * options_.spacing_mm;
    const double way =
        way_.way(at.motion(step_mm * motion) * settled_.to_from, settled_.to_from) / step_mm;
    if (!(way > 0.0)) return moved;
    const double spread_mm = spread_along(poses, at, motion, way);
    constexpr double kNoticed = 10.0;  // standard deviations of a distance
    const bool open = spread_mm > kNoticed * contradictions_.sigma_mm();
    (open ? settled_.open : settled_.held).push_back(open_motion(at, motion, spread_mm, way));
    return moved;
  }

  /// Natural logarithm of the odds of a pose over the present one, by what they contradict and by
  /// how far they are from the start.
  [[nodiscard]] double log_odds(const PoseOnWay& pose) const {
    const auto prior = [&](const Eigen::Isometry3d& at) {
      return -0.5 * std::pow(way_.way(at, start_) / options_.prior_mm, 2);
    };
    return log_odds_of(pose.count, count_) + prior(pose.pose) - prior(settled_.to_from);
  }

  /// Moves to the pose on the way that is the most probable one, if it is decidedly so.
  bool take_better(std::vector<PoseOnWay>& poses, const Vector6& motion) {
    constexpr std::size_t kTried = 3;
    std::vector<const PoseOnWay*> least;
    for (const PoseOnWay& pose : poses)
      least.push_back(&pose);
    std::stable_sort(least.begin(), least.end(), [&](const PoseOnWay* a, const PoseOnWay* b) {
      return log_odds(*a) > log_odds(*b);
    });
    std::optional<PoseOnWay> best;
    const auto consider = [&](const Eigen::Isometry3d& pose, const PoseOnWay& near) {
      PoseOnWay one{pose, near.way_mm, near.share_mm, contradictions_.count(pose)};
      if (!best || log_odds(one) > log_odds(*best)) best = one;
    };
    for (std::size_t i = 0; i < std::min(kTried, least.size()); ++i) {
      consider(least[i]->pose, *least[i]);
      const GroupFit at = way_.fit(least[i]->pose);
      const auto weak = weak_motions(at);
      if (weak.cols() == 0) continue;
      for (const double steps : {-0.5, -0.25, 0.25, 0.5}) {
        const Vector6 along = (weak * (weak.transpose() * motion)).normalized();
        const Vector6 step = steps * kStep * options_.spacing_mm * along;
        consider(way_.refined(at.motion(step) * least[i]->pose), *least[i]);
      }
    }
    if (!best || log_odds(*best) < kDecided) return false;
    const double shift_mm = best->way_mm;
    poses.push_back({settled_.to_from, 0.0, kStep * options_.spacing_mm, count_});
    for (PoseOnWay& pose : poses)
      pose.way_mm -= shift_mm;
    settled_.to_from = best->pose;
    count_ = best->count;
    return true;
  }

  /// Standard deviation of the pose along a motion: of the poses by their odds.
  double spread_along(std::vector<PoseOnWay> poses,
                      const GroupFit& at,
                      const Vector6& motion,
                      double way) const {
    constexpr double kNear[] = {0.125, 0.25, 0.5};  // of a step
    const double step_mm = kStep * options_.spacing_mm;
    // What a pose stands for is the way of the points, as that of the poses on the way.
    std::erase_if(
        poses, [&](const PoseOnWay& pose) { return std::abs(pose.way_mm) < 0.6 * way * step_mm; });
    for (const double sign : {-1.0, 1.0}) {
      for (const double steps : kNear) {
        PoseOnWay near{at.motion(sign * steps * step_mm * motion) * settled_.to_from,
                       sign * steps * way * step_mm,
                       0.5 * steps * way * step_mm,
                       {}};
        near.count = contradictions_.count(near.pose);
        poses.push_back(near);
      }
    }
    double all = kNear[0] * way * step_mm;
    double squares = 0.0;
    for (const PoseOnWay& pose : poses) {
      const double prior = -0.5 * std::pow(pose.way_mm / options_.prior_mm, 2);
      const double odds = -std::max(0.0, log_odds_of(count_, pose.count)) + prior;
      const double share = pose.share_mm * std::exp(odds);
      all += share;
      // The way around a turn is far, but the points are not.
      const double away_mm = std::min(std::abs(pose.way_mm), way_.way(pose.pose, settled_.to_from));
      squares += share * away_mm * away_mm;
    }
    return std::sqrt(squares / all);
  }

  SettleOptions options_;
  const Run& run_;
  Eigen::Isometry3d start_;
  OpenWay way_;
  PoseContradictions contradictions_;
  PatchCount start_count_;
  PatchCount count_;
  SettledPose settled_;
};

}  // namespace

std::string OpenMotion::words() const {
  return fmt::format("{} ({:.2f}, {:.2f}, {:.2f})",
                     turns ? "its turn about the axis" : "its shift along",
                     axis.x(),
                     axis.y(),
                     axis.z());
}

SettledPose settle_group_pose(const ViewGroup& to,
                              const ViewGroup& from,
                              const Eigen::Isometry3d& start,
                              const GroupViews& views,
                              const SettleOptions& options,
                              const Run& run) {
  require(options.spacing_mm > 0.0, "settle_group_pose: spacing_mm must be above 0");
  return PoseSettler(to, from, start, views, options, run).settle();
}

}  // namespace frangia
