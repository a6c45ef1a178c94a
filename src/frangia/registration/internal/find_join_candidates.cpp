#include "frangia/registration/internal/find_join_candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "frangia/core/angles.h"
#include "frangia/registration/internal/surface_features.h"

namespace frangia {
namespace {

bool may_be_valid(const GroupFit& fit, const JoinByShapeOptions& options) {
  return fit.overlap >= options.min_overlap &&
         fit.free_space_violation() <= options.max_violation &&
         fit.smallest_eigenvalue >= options.min_eigenvalue;
}

}  // namespace

std::vector<JoinCandidate> find_join_candidates(std::span<const ViewGroup> groups,
                                                const GroupViews& views,
                                                const JoinByShapeOptions& options,
                                                const Run& run) {
  const PoseSearchScale scale{options.spacing_mm};
  std::vector<Eigen::MatrixXf> features;
  for (const ViewGroup& group : groups)
    features.push_back(surface_features(group.points, options.feature_radius * scale.spacing_mm));
  std::vector<JoinCandidate> candidates;
  const auto pairs = static_cast<double>(groups.size() * (groups.size() - 1)) / 2.0;
  double done = 0.0;
  for (std::size_t to = 0; to < groups.size(); ++to) {
    for (std::size_t from = to + 1; from < groups.size(); ++from) {
      run.report(done / pairs);
      done += 1.0;
      const auto hypotheses = find_pose_hypotheses(
          {groups[to], features[to]}, {groups[from], features[from]}, views, scale);
      for (std::size_t i = 0; i < std::min(hypotheses.size(), options.max_candidates); ++i)
        candidates.push_back({to, from, hypotheses[i]});
    }
  }
  return candidates;
}

double typical_residual_mm(std::span<const JoinCandidate> candidates,
                           const JoinByShapeOptions& options) {
  double least = std::numeric_limits<double>::infinity();
  for (const JoinCandidate& candidate : candidates) {
    if (may_be_valid(candidate.hypothesis.fit, options))
      least = std::min(least, candidate.hypothesis.fit.residual_mm);
  }
  return least;
}

bool are_duplicates(const ViewGroup& to, const ViewGroup& from, const PoseHypothesis& hypothesis) {
  constexpr double kSameOverlap = 0.85;                 // of the points: the rest are silhouettes
  constexpr double kSameDirection = rad_from_deg(3.0);  // between the lines of sight
  constexpr double kSameDistance = 0.05;                // of the distance from the camera
  if (to.members.size() != 1 || from.members.size() != 1 || hypothesis.fit.overlap < kSameOverlap)
    return false;
  const Eigen::Vector3d one = to.members[0].rig_from_group.inverse().translation();
  const Eigen::Vector3d other =
      hypothesis.to_from * from.members[0].rig_from_group.inverse().translation();
  const Eigen::Vector3d to_one = one - hypothesis.fit.center_mm;
  const Eigen::Vector3d to_other = other - hypothesis.fit.center_mm;
  const double turned = std::atan2(to_one.cross(to_other).norm(), to_one.dot(to_other));
  return turned < kSameDirection &&
         std::abs(to_other.norm() - to_one.norm()) < kSameDistance * to_one.norm();
}

}  // namespace frangia
