#include "frangia/targets/match_targets.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/rigid_motion.h"

namespace frangia {
namespace {

/// Of two faces that meet at a corner the targets are distinct.
constexpr double kMinNormalCosine = 0.5;

/// A sighting in the object frame.
struct Placed {
  Eigen::Vector3d center_mm;
  Eigen::Vector3d normal;
  Eigen::Matrix3d information;
};

Placed placed_in_object(const TargetSighting& sighting, const Eigen::Isometry3d& rig_from_object) {
  const Eigen::Isometry3d object_from_rig = rig_from_object.inverse();
  const Eigen::Matrix3d turn = object_from_rig.linear();
  return {object_from_rig * sighting.center_mm,
          turn * sighting.normal,
          turn * sighting.covariance_mm2.inverse() * turn.transpose()};
}

/// Sets place and normal of a target from its sightings.
void place(Target& target, std::span<const TargetView> views) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const Target::Sighting& seen : target.seen) {
    const TargetView& view = views[seen.view];
    const Placed at = placed_in_object(view.sightings[seen.index], view.rig_from_object);
    information += at.information;
    sum += at.information * at.center_mm;
    normal += at.normal;
  }
  target.covariance_mm2 = information.inverse();
  target.center_mm = target.covariance_mm2 * sum;
  target.normal = normal.normalized();
}

[[noreturn]] void refuse_twice(int code,
                               const std::string& first,
                               const std::string& second,
                               double away_mm) {
  throw Error(ErrorKind::Input,
              fmt::format("two targets have the code {}: they are {:.1f} mm apart in {}; give each "
                          "target on the part a code of its own",
                          code,
                          away_mm,
                          first == second ? first : fmt::format("{} and {}", first, second)));
}

/// The target that a sighting belongs to; none for one that was not seen before.
Target* target_of(std::vector<Target>& all,
                  const TargetSighting& sighting,
                  const Placed& at,
                  std::size_t view,
                  std::span<const TargetView> views,
                  const TargetSet& targets) {
  constexpr double kNear = 0.75;  // diameters: two stickers lie side by side, at least one apart
  constexpr double kFar = 3.0;    // sides of a marker: no table is that wrong
  Target* nearest = nullptr;
  double least_mm = kNear * targets.diameter_mm;
  for (Target& target : all) {
    if (target.code != sighting.code) continue;
    const double away_mm = (target.center_mm - at.center_mm).norm();
    if (sighting.code >= 0) {
      const bool again = target.seen.back().view == view;
      if (again || away_mm > kFar * targets.marker_mm)
        refuse_twice(
            sighting.code, views[target.seen.front().view].name, views[view].name, away_mm);
      return &target;
    }
    if (away_mm >= least_mm || target.normal.dot(at.normal) < kMinNormalCosine ||
        target.seen.back().view == view)
      continue;
    least_mm = away_mm;
    nearest = &target;
  }
  return nearest;
}

}  // namespace

std::vector<Target> match_targets(std::span<const TargetView> views, const TargetSet& targets) {
  std::vector<Target> all;
  for (std::size_t view = 0; view < views.size(); ++view) {
    for (std::size_t i = 0; i < views[view].sightings.size(); ++i) {
      const TargetSighting& sighting = views[view].sightings[i];
      const Placed at = placed_in_object(sighting, views[view].rig_from_object);
      Target* target = target_of(all, sighting, at, view, views, targets);
      if (target == nullptr) {
        target = &all.emplace_back();
        target->code = sighting.code;
      }
      target->seen.push_back({view, i});
      place(*target, views);
    }
  }
  return all;
}

std::vector<PointTie> ties_of(std::span<const Target> targets, std::span<const TargetView> views) {
  std::vector<PointTie> ties;
  for (const Target& target : targets) {
    const double share = 2.0 / static_cast<double>(target.seen.size());
    for (std::size_t i = 0; i < target.seen.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Target::Sighting& from = target.seen[i];
        const Target::Sighting& to = target.seen[j];
        const TargetSighting& one = views[from.view].sightings[from.index];
        const TargetSighting& other = views[to.view].sightings[to.index];
        ties.push_back({from.view,
                        to.view,
                        one.center_mm,
                        other.center_mm,
                        one.covariance_mm2,
                        other.covariance_mm2,
                        share});
      }
    }
  }
  return ties;
}

namespace {

constexpr double kFacesAlike = 0.8;

/// Two targets of a setup and their distance.
struct Side {
  std::size_t first = 0;
  std::size_t second = 0;
  double length_mm = 0.0;
};

std::vector<Side> sides_of(std::span<const Target> targets, bool both_ways) {
  std::vector<Side> sides;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    for (std::size_t j = 0; j < targets.size(); ++j) {
      if (i == j || (!both_ways && j < i)) continue;
      sides.push_back({i, j, (targets[i].center_mm - targets[j].center_mm).norm()});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& one, const Side& other) {
    return one.length_mm < other.length_mm;
  });
  return sides;
}

/// Finds motions that bring targets of one setup onto those of another.
class TargetJoiner {
 public:
  TargetJoiner(std::span<const Target> to, std::span<const Target> from, double limit_mm)
      : to_(to), from_(from), limit_mm_(limit_mm) {}

  std::optional<TargetJoin> find() {
    const std::vector<Side> sides = sides_of(to_, false);
    const std::vector<Side> others = sides_of(from_, true);
    for (const Side& other : others) {
      const auto first = std::lower_bound(
          sides.begin(), sides.end(), other.length_mm - limit_mm_, [](const Side& side, double at) {
            return side.length_mm < at;
          });
      for (auto side = first; side != sides.end() && side->length_mm < other.length_mm + limit_mm_;
           ++side)
        try_side(*side, other);
    }
    if (!best_) return std::nullopt;
    best_->second = second_;
    return best_;
  }

 private:
  [[nodiscard]] bool may_be(std::size_t to, std::size_t from) const {
    return to_[to].code == from_[from].code;
  }

  /// Completes a pair of targets to triangles.
  void try_side(const Side& side, const Side& other) {
    if (!may_be(side.first, other.first) || !may_be(side.second, other.second)) return;
    constexpr double kSlim = 0.1;  // height over length: a slimmer triangle does not hold a turn
    const Eigen::Vector3d origin = to_[side.first].center_mm;
    const Eigen::Vector3d along = (to_[side.second].center_mm - origin).normalized();
    for (std::size_t k = 0; k < to_.size(); ++k) {
      if (k == side.first || k == side.second) continue;
      const Eigen::Vector3d away = to_[k].center_mm - origin;
      if ((away - along * along.dot(away)).norm() < kSlim * side.length_mm) continue;
      for (std::size_t n = 0; n < from_.size(); ++n) {
        if (n == other.first || n == other.second || !may_be(k, n)) continue;
        if (is_apart(k, side.first, n, other.first) || is_apart(k, side.second, n, other.second))
          continue;
        consider({{side.first, other.first}, {side.second, other.second}, {k, n}});
      }
    }
  }

  [[nodiscard]] bool is_apart(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const {
    return std::abs((to_[a].center_mm - to_[b].center_mm).norm() -
                    (from_[c].center_mm - from_[d].center_mm).norm()) > limit_mm_;
  }

  [[nodiscard]] Eigen::Isometry3d motion_of(const std::vector<TargetJoin::Pair>& pairs) const {
    Eigen::Matrix3Xd source(3, static_cast<Eigen::Index>(pairs.size()));
    Eigen::Matrix3Xd target = source;
    for (Eigen::Index i = 0; i < source.cols(); ++i) {
      source.col(i) = from_[pairs[static_cast<std::size_t>(i)].from].center_mm;
      target.col(i) = to_[pairs[static_cast<std::size_t>(i)].to].center_mm;
    }
    return rigid_motion(source, target);
  }

  /// The targets that a motion brings together, each with the nearest that is left.
  [[nodiscard]] std::vector<TargetJoin::Pair> pairs_in(const Eigen::Isometry3d& to_from) const {
    std::vector<TargetJoin::Pair> pairs;
    std::vector<bool> taken(to_.size(), false);
    for (std::size_t n = 0; n < from_.size(); ++n) {
      const Eigen::Vector3d at = to_from * from_[n].center_mm;
      const Eigen::Vector3d normal = to_from.linear() * from_[n].normal;
      std::optional<std::size_t> nearest;
      double least_mm = limit_mm_;
      for (std::size_t k = 0; k < to_.size(); ++k) {
        const double away_mm = (to_[k].center_mm - at).norm();
        if (taken[k] || !may_be(k, n) || away_mm >= least_mm ||
            normal.dot(to_[k].normal) < kFacesAlike)
          continue;
        least_mm = away_mm;
        nearest = k;
      }
      if (!nearest) continue;
      taken[*nearest] = true;
      pairs.push_back({*nearest, n});
    }
    return pairs;
  }

  [[nodiscard]] double rms_of(const TargetJoin& join) const {
    double sum = 0.0;
    for (const TargetJoin::Pair& pair : join.pairs)
      sum += (to_[pair.to].center_mm - join.to_from * from_[pair.from].center_mm).squaredNorm();
    return std::sqrt(sum / static_cast<double>(join.pairs.size()));
  }

  /// Whether two motions place a target differently.
  [[nodiscard]] bool differ(const Eigen::Isometry3d& one, const Eigen::Isometry3d& other) const {
    constexpr double kApart = 3.0;  // limits
    return std::any_of(from_.begin(), from_.end(), [&](const Target& target) {
      return (one * target.center_mm - other * target.center_mm).norm() > kApart * limit_mm_;
    });
  }

  void consider(const std::vector<TargetJoin::Pair>& triangle) {
    TargetJoin join;
    join.to_from = motion_of(triangle);
    join.pairs = pairs_in(join.to_from);
    if (join.pairs.size() < 3) return;
    join.to_from = motion_of(join.pairs);
    join.pairs = pairs_in(join.to_from);
    if (join.pairs.size() < 3) return;
    join.rms_mm = rms_of(join);
    const bool better = !best_ || join.pairs.size() > best_->pairs.size() ||
                        (join.pairs.size() == best_->pairs.size() && join.rms_mm < best_->rms_mm);
    if (better) {
      if (best_ && differ(join.to_from, best_->to_from))
        second_ = std::max(second_, best_->pairs.size());
      best_ = std::move(join);
    } else if (differ(join.to_from, best_->to_from)) {
      second_ = std::max(second_, join.pairs.size());
    }
  }

  std::span<const Target> to_;
  std::span<const Target> from_;
  double limit_mm_;
  std::optional<TargetJoin> best_;
  std::size_t second_ = 0;
};

}  // namespace

std::optional<TargetJoin> join_targets(std::span<const Target> to,
                                       std::span<const Target> from,
                                       const TargetSet& targets) {
  // Of a diameter: what the places of the views of a setup add to a target's own sigma.
  constexpr double kLimit = 0.1;
  const double size_mm = targets.diameter_mm > 0.0 ? targets.diameter_mm : targets.marker_mm;
  auto join = TargetJoiner(to, from, kLimit * size_mm).find();
  if (!join) return std::nullopt;
  const auto coded = std::count_if(join->pairs.begin(), join->pairs.end(), [&](const auto& pair) {
    return to[pair.to].code >= 0;
  });
  // Three distances agree by chance among a dozen targets; six hardly do.
  constexpr std::size_t kFewestUncoded = 4;
  if (coded < 3 && join->pairs.size() < kFewestUncoded) return std::nullopt;
  return join;
}

}  // namespace frangia
