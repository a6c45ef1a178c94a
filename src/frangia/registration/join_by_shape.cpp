#include "frangia/registration/join_by_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/registration/internal/find_pose_hypotheses.h"
#include "frangia/registration/internal/surface_features.h"

namespace frangia {
namespace {

/// Radius of the features that are tried where the usual ones find no pose, as a share of theirs.
constexpr double kFinerFeatures = 0.5;

/// A pose of one group on another that may be right.
struct JoinCandidate {
  std::size_t to = 0;
  std::size_t from = 0;
  PoseHypothesis hypothesis;
};

/// Whether distances determine a pose, or all of it but a turn where that may be open.
bool is_determined(const GroupFit& fit, const JoinByShapeOptions& options, double slack) {
  const double least = options.min_eigenvalue / slack;
  return fit.smallest_eigenvalue >= least ||
         (options.may_turn && fit.second_eigenvalue >= least && fit.weakest_axis());
}

bool may_be_valid(const GroupFit& fit, const JoinByShapeOptions& options) {
  return fit.overlap >= options.min_overlap &&
         fit.free_space_violation() <= options.max_violation && is_determined(fit, options, 1.0);
}

/// The features of all groups at one size.
std::vector<Eigen::MatrixXf> features_of(std::span<const ViewGroup> groups, double radius_mm) {
  std::vector<Eigen::MatrixXf> features;
  for (const ViewGroup& group : groups)
    features.push_back(surface_features(group.points, radius_mm));
  return features;
}

/// The best pose hypotheses of every two groups, a few each.
std::vector<JoinCandidate> find_join_candidates(std::span<const ViewGroup> groups,
                                                const GroupViews& views,
                                                const JoinByShapeOptions& options,
                                                const Run& run) {
  const PoseSearchScale scale{options.spacing_mm};
  const double radius_mm = options.feature_radius * scale.spacing_mm;
  const std::vector<Eigen::MatrixXf> usual = features_of(groups, radius_mm);
  std::vector<Eigen::MatrixXf> finer;
  const auto hypotheses_of = [&](std::size_t to, std::size_t from, const auto& features) {
    return find_pose_hypotheses(
        {groups[to], features[to]}, {groups[from], features[from]}, views, scale);
  };
  std::vector<JoinCandidate> candidates;
  const auto pairs = static_cast<double>(groups.size() * (groups.size() - 1)) / 2.0;
  double done = 0.0;
  for (std::size_t to = 0; to < groups.size(); ++to) {
    for (std::size_t from = to + 1; from < groups.size(); ++from) {
      run.report(done / pairs);
      done += 1.0;
      auto hypotheses = hypotheses_of(to, from, usual);
      // Large features of edged parts are alike in wrong poses that contradict each other.
      if (std::none_of(hypotheses.begin(), hypotheses.end(), [&](const PoseHypothesis& one) {
            return may_be_valid(one.fit, options);
          })) {
        run.check();
        if (finer.empty()) finer = features_of(groups, kFinerFeatures * radius_mm);
        for (PoseHypothesis& hypothesis : hypotheses_of(to, from, finer))
          hypotheses.push_back(std::move(hypothesis));
        sort_hypotheses(hypotheses, std::numeric_limits<double>::infinity());
      }
      for (std::size_t i = 0; i < std::min(hypotheses.size(), options.max_candidates); ++i)
        candidates.push_back({to, from, hypotheses[i]});
    }
  }
  return candidates;
}

/// Distance at which corresponding surfaces come to lie: the least residual of all candidates with
/// sufficient overlap and no violations. Infinite when there is none.
double typical_residual_mm(std::span<const JoinCandidate> candidates,
                           const JoinByShapeOptions& options) {
  double least = std::numeric_limits<double>::infinity();
  for (const JoinCandidate& candidate : candidates) {
    if (may_be_valid(candidate.hypothesis.fit, options))
      least = std::min(least, candidate.hypothesis.fit.residual_mm);
  }
  return least;
}

/// Whether two groups of one view each show the same surface from the same viewpoint.
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

/// Joins clusters of groups, the best fit first, until no two clusters fit.
class ClusterJoiner {
 public:
  ClusterJoiner(std::span<const ViewGroup> groups,
                const GroupViews& views,
                std::vector<JoinCandidate> candidates,
                const JoinByShapeOptions& options)
      : views_(views),
        options_(options),
        typical_mm_(typical_residual_mm(candidates, options)),
        candidates_(std::move(candidates)),
        clusters_(groups.begin(), groups.end()),
        cluster_from_group_(groups.size(), Eigen::Isometry3d::Identity()) {
    for (std::size_t i = 0; i < groups.size(); ++i)
      cluster_of_.push_back(i);
    sort_candidates();
  }

  /// Joins the two clusters that fit best. Returns false when no two fit.
  bool join_next(JoinedGroups& out) {
    for (const JoinCandidate& candidate : candidates_) {
      const std::size_t to = std::min(cluster_of_[candidate.to], cluster_of_[candidate.from]);
      const std::size_t from = std::max(cluster_of_[candidate.to], cluster_of_[candidate.from]);
      if (to == from || !tried_.insert(stage_of(to, from)).second) continue;
      const std::vector<PoseHypothesis> hypotheses = hypotheses_of(to, from);
      if (hypotheses.empty() || !is_valid(hypotheses[0].fit, 1.0)) continue;
      if (is_ambiguous(hypotheses)) {
        out.ambiguous[candidate.from] = out.ambiguous[candidate.to] = true;
        continue;
      }
      out.joins.push_back({from, to, hypotheses[0].fit});
      join(to, from, hypotheses[0].to_from);
      return true;
    }
    return false;
  }

  /// Leaves out the second of two duplicate views.
  void leave_out_duplicates(JoinedGroups& out) {
    for (const JoinCandidate& candidate : candidates_) {
      const auto& [to, from, hypothesis] = candidate;
      if (out.duplicate_of[to] || out.duplicate_of[from] || !is_valid(hypothesis.fit, 1.0))
        continue;
      if (are_duplicates(clusters_[to], clusters_[from], hypothesis)) out.duplicate_of[from] = to;
    }
    const auto is_left_out = [&](const JoinCandidate& candidate) {
      return out.duplicate_of[candidate.to] || out.duplicate_of[candidate.from];
    };
    std::erase_if(candidates_, is_left_out);
    for (std::size_t i = 0; i < clusters_.size(); ++i)
      if (out.duplicate_of[i]) clusters_[i] = {};
  }

  /// Searches poses of whole clusters on each other, which overlap more than their groups do.
  void search_clusters(const Run& run) {
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < clusters_.size(); ++i) {
      if (!clusters_[i].members.empty()) left.push_back(i);
    }
    std::vector<ViewGroup> thinned;
    thinned.reserve(left.size());
    for (const std::size_t i : left) {
      thinned.push_back(
          {clusters_[i].members, voxel_downsample(clusters_[i].points, options_.spacing_mm)});
    }
    for (JoinCandidate& found : find_join_candidates(thinned, views_, options_, run)) {
      found.to = first_of(left[found.to]);
      found.from = first_of(left[found.from]);
      found.hypothesis.to_from = cluster_from_group_[found.to].inverse() *
                                 found.hypothesis.to_from * cluster_from_group_[found.from];
      candidates_.push_back(found);
    }
    sort_candidates();
    tried_.clear();
  }

  /// Expresses all poses of the largest cluster in the frame of its first group.
  void write_poses(JoinedGroups& out) const {
    const auto main =
        static_cast<std::size_t>(std::max_element(clusters_.begin(),
                                                  clusters_.end(),
                                                  [](const ViewGroup& a, const ViewGroup& b) {
                                                    return a.members.size() < b.members.size();
                                                  }) -
                                 clusters_.begin());
    out.reference = first_of(main);
    const Eigen::Isometry3d reference_from_cluster = cluster_from_group_[out.reference].inverse();
    out.reference_from_group.resize(cluster_of_.size());
    for (std::size_t i = 0; i < cluster_of_.size(); ++i) {
      if (cluster_of_[i] == main)
        out.reference_from_group[i] = reference_from_cluster * cluster_from_group_[i];
    }
  }

 private:
  /// Two clusters and their sizes: a pair that does not fit is tried again only when one has grown.
  using Stage = std::array<std::size_t, 4>;
  [[nodiscard]] Stage stage_of(std::size_t a, std::size_t b) const {
    return {a, clusters_[a].members.size(), b, clusters_[b].members.size()};
  }

  void sort_candidates() {
    std::stable_sort(candidates_.begin(),
                     candidates_.end(),
                     [&](const JoinCandidate& a, const JoinCandidate& b) {
                       return a.hypothesis.score(typical_mm_) > b.hypothesis.score(typical_mm_);
                     });
  }
  /// Index of the first group of a cluster.
  [[nodiscard]] std::size_t first_of(std::size_t cluster) const {
    return static_cast<std::size_t>(std::find(cluster_of_.begin(), cluster_of_.end(), cluster) -
                                    cluster_of_.begin());
  }

  /// Whether a fit passes the options' limits, widened by `slack`. The limit of free-space
  /// violations is never widened.
  [[nodiscard]] bool is_valid(const GroupFit& fit, double slack) const {
    return is_determined(fit, options_, slack) && fits(fit, slack);
  }
  [[nodiscard]] bool fits(const GroupFit& fit, double slack) const {
    return fit.overlap >= options_.min_overlap / slack &&
           fit.free_space_violation() <= options_.max_violation &&
           fit.residual_mm <= slack * options_.max_residual * typical_mm_;
  }
  /// Whether distances hardly show the turn of a hypothesis about an axis, which may be open.
  [[nodiscard]] bool may_turn(const PoseHypothesis& hypothesis) const {
    return options_.may_turn && hypothesis.fit.smallest_eigenvalue < options_.well_constrained;
  }
  /// Whether another pose fits nearly as well as the first, even if it slides.
  [[nodiscard]] bool is_ambiguous(const std::vector<PoseHypothesis>& hypotheses) const {
    return std::any_of(hypotheses.begin() + 1, hypotheses.end(), [&](const PoseHypothesis& other) {
      const bool turned = may_turn(hypotheses[0]) &&
                          differs_by_turn(hypotheses[0], other.to_from, {options_.spacing_mm});
      return !turned && fits(other.fit, options_.runner_up_slack) &&
             other.score(typical_mm_) > options_.max_runner_up * hypotheses[0].score(typical_mm_);
    });
  }

  /// Poses of one cluster on another: those of their groups' candidates, refined by all views.
  [[nodiscard]] std::vector<PoseHypothesis> hypotheses_of(std::size_t to, std::size_t from) const {
    std::vector<Eigen::Isometry3d> starts;
    for (const JoinCandidate& candidate : candidates_) {
      const std::size_t a = cluster_of_[candidate.to];
      const std::size_t b = cluster_of_[candidate.from];
      if (std::min(a, b) != to || std::max(a, b) != from || starts.size() == options_.max_starts)
        continue;
      const Eigen::Isometry3d a_from_b = cluster_from_group_[candidate.to] *
                                         candidate.hypothesis.to_from *
                                         cluster_from_group_[candidate.from].inverse();
      starts.push_back(a == to ? a_from_b : a_from_b.inverse());
    }
    const PoseSearchScale scale{options_.spacing_mm};
    auto hypotheses = refine_pose_hypotheses(clusters_[to], clusters_[from], starts, views_, scale);
    if (hypotheses.empty()) return hypotheses;
    sort_hypotheses(hypotheses, typical_mm_);
    if (hypotheses[0].fit.smallest_eigenvalue < options_.well_constrained) {
      for (const Eigen::Isometry3d& start : neighboring_poses(hypotheses[0], scale))
        starts.push_back(start);
    }
    // A small feature that is turned away contradicts the other group.
    if (may_turn(hypotheses[0])) {
      for (const Eigen::Isometry3d& start : turned_poses(hypotheses[0]))
        starts.push_back(start);
    }
    hypotheses = refine_pose_hypotheses(clusters_[to], clusters_[from], starts, views_, scale);
    sort_hypotheses(hypotheses, typical_mm_);
    std::stable_partition(
        hypotheses.begin(), hypotheses.end(), [&](const PoseHypothesis& hypothesis) {
          return is_valid(hypothesis.fit, 1.0);
        });
    return hypotheses;
  }

  void join(std::size_t to, std::size_t from, const Eigen::Isometry3d& to_from) {
    clusters_[to] = join_groups(clusters_[to], clusters_[from], to_from);
    clusters_[from] = {};
    for (std::size_t group = 0; group < cluster_of_.size(); ++group) {
      if (cluster_of_[group] != from) continue;
      cluster_of_[group] = to;
      cluster_from_group_[group] = to_from * cluster_from_group_[group];
    }
  }

  GroupViews views_;
  JoinByShapeOptions options_;
  double typical_mm_;
  std::vector<JoinCandidate> candidates_;
  std::vector<ViewGroup> clusters_;
  std::vector<std::size_t> cluster_of_;
  std::vector<Eigen::Isometry3d> cluster_from_group_;
  std::set<Stage> tried_;
};

}  // namespace

void JoinByShapeOptions::check() const {
  require(spacing_mm > 0.0, "JoinByShapeOptions: spacing_mm must be above 0");
  require(min_overlap > 0.0 && min_overlap <= 1.0,
          "JoinByShapeOptions: min_overlap must be above 0 and at most 1");
  require(max_runner_up > 0.0 && max_runner_up <= 1.0,
          "JoinByShapeOptions: max_runner_up must be above 0 and at most 1");
  require(max_residual >= 1.0, "JoinByShapeOptions: max_residual must be at least 1");
}

JoinedGroups join_by_shape(std::span<const ViewGroup> groups,
                           const GroupViews& views,
                           const JoinByShapeOptions& options,
                           const Run& run) {
  options.check();
  JoinedGroups out;
  out.ambiguous.assign(groups.size(), false);
  out.duplicate_of.assign(groups.size(), std::nullopt);
  ClusterJoiner joiner(groups, views, find_join_candidates(groups, views, options, run), options);
  if (options.leave_out_duplicates) joiner.leave_out_duplicates(out);
  for (bool again = true; again;) {
    const std::size_t joins = out.joins.size();
    while (joiner.join_next(out))
      run.check();
    again = out.joins.size() > joins && out.joins.size() + 1 < groups.size();
    if (again) joiner.search_clusters(run);
  }
  joiner.write_poses(out);
  return out;
}

}  // namespace frangia
