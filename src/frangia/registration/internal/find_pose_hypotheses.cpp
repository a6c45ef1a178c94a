#include "frangia/registration/internal/find_pose_hypotheses.h"

#include <algorithm>
#include <limits>

#include "frangia/core/angles.h"
#include "frangia/registration/internal/find_motion_hypotheses.h"
#include "frangia/registration/internal/surface_features.h"

namespace frangia {
namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();

/// Adds a hypothesis unless its score is 0 or less, or its pose is known already.
void add_new(std::vector<PoseHypothesis>& hypotheses,
             const PoseHypothesis& hypothesis,
             const PoseSearchScale& scale) {
  const Eigen::Vector3d center = hypothesis.to_from.inverse() * hypothesis.fit.center_mm;
  const bool known =
      std::any_of(hypotheses.begin(), hypotheses.end(), [&](const PoseHypothesis& other) {
        return is_same_motion(
            hypothesis.to_from, other.to_from, center, hypothesis.fit.arm_mm, scale.distinct_mm());
      });
  if (!known && hypothesis.score(kAny) > 0.0) hypotheses.push_back(hypothesis);
}

}  // namespace

double PoseHypothesis::score(double typical_mm) const {
  constexpr double kViolationWeight =
      3.0;  // a wrong pose violates free space seldom, a right one never
  const double points =
      static_cast<double>(fit.agree) - kViolationWeight * static_cast<double>(fit.violations);
  return fit.residual_mm > typical_mm ? points * typical_mm / fit.residual_mm : points;
}

void sort_hypotheses(std::vector<PoseHypothesis>& hypotheses, double typical_mm) {
  std::stable_sort(
      hypotheses.begin(), hypotheses.end(), [&](const PoseHypothesis& a, const PoseHypothesis& b) {
        return a.score(typical_mm) > b.score(typical_mm);
      });
}

std::vector<PoseHypothesis> refine_pose_hypotheses(const ViewGroup& to,
                                                   const ViewGroup& from,
                                                   std::span<const Eigen::Isometry3d> starts,
                                                   const GroupViews& views,
                                                   const PoseSearchScale& scale) {
  std::vector<PoseHypothesis> hypotheses;
  for (const Eigen::Isometry3d& start : starts) {
    PoseHypothesis hypothesis;
    hypothesis.to_from =
        refine_fit(to, from, start, views, {scale.coarse_gate_mm(), scale.gate_mm()});
    hypothesis.fit = compare_groups(to, from, hypothesis.to_from, views, scale.gate_mm());
    add_new(hypotheses, hypothesis, scale);
  }
  sort_hypotheses(hypotheses, kAny);
  return hypotheses;
}

std::vector<Eigen::Isometry3d> neighboring_poses(const PoseHypothesis& hypothesis,
                                                 const PoseSearchScale& scale) {
  std::vector<Eigen::Isometry3d> neighbors;
  for (Eigen::Index direction = 0; direction < 2; ++direction) {
    for (const double spacings : {-6.0, -3.0, -1.5, 1.5, 3.0, 6.0}) {
      const Eigen::Matrix<double, 6, 1> step =
          spacings * scale.spacing_mm * hypothesis.fit.weakest_directions.col(direction);
      neighbors.push_back(hypothesis.fit.motion(step) * hypothesis.to_from);
    }
  }
  return neighbors;
}

bool differs_by_turn(const PoseHypothesis& hypothesis,
                     const Eigen::Isometry3d& other,
                     const PoseSearchScale& scale) {
  const auto axis = hypothesis.fit.weakest_axis();
  if (!axis) return false;
  const Eigen::Isometry3d between = other * hypothesis.to_from.inverse();
  const auto stays = [&](const Eigen::Vector3d& point) {
    return (between * point - point).norm() < scale.distinct_mm();
  };
  return stays(axis->pointAt(-hypothesis.fit.arm_mm)) &&
         stays(axis->pointAt(hypothesis.fit.arm_mm));
}

std::vector<Eigen::Isometry3d> turned_poses(const PoseHypothesis& hypothesis) {
  constexpr int kTurns = 36;  // a keyway draws the pose to it over some degrees
  const auto axis = hypothesis.fit.weakest_axis();
  std::vector<Eigen::Isometry3d> turned;
  for (int i = 1; axis && i < kTurns; ++i) {
    const Eigen::Isometry3d turn = Eigen::Translation3d(axis->origin()) *
                                   Eigen::AngleAxisd(kTwoPi * i / kTurns, axis->direction()) *
                                   Eigen::Translation3d(-axis->origin());
    turned.push_back(turn * hypothesis.to_from);
  }
  return turned;
}

std::vector<PoseHypothesis> find_pose_hypotheses(const DescribedGroup& to,
                                                 const DescribedGroup& from,
                                                 const GroupViews& views,
                                                 const PoseSearchScale& scale) {
  constexpr std::size_t kRefined = 8;  // poses; each costs up to 25 comparisons
  const auto matches = match_features(from.features, to.features);
  std::vector<PoseHypothesis> rough;
  for (const MotionHypothesis& motion :
       find_motion_hypotheses(from.group.points,
                              to.group.points,
                              matches,
                              {.tolerance_mm = scale.match_tolerance_mm()})) {
    PoseHypothesis hypothesis{motion.to_from, {}};
    hypothesis.fit =
        compare_groups(to.group, from.group, hypothesis.to_from, views, scale.coarse_gate_mm());
    add_new(rough, hypothesis, scale);
  }
  sort_hypotheses(rough, kAny);
  std::vector<Eigen::Isometry3d> starts;
  for (std::size_t i = 0; i < std::min(rough.size(), kRefined); ++i)
    starts.push_back(rough[i].to_from);
  return refine_pose_hypotheses(to.group, from.group, starts, views, scale);
}

}  // namespace frangia
