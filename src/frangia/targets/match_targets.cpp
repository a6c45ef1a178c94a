#include "frangia/targets/match_targets.h"

#include <algorithm>

#include <Eigen/LU>
#include <fmt/format.h>

#include "frangia/core/error.h"

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

}  // namespace frangia
