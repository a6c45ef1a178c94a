#include "frangia/registration/find_view_poses.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/registration/internal/view_pairs.h"
#include "frangia/registration/join_by_shape.h"

namespace frangia {
namespace {

using Members = std::vector<std::vector<ViewGroup::Member>>;

std::vector<ViewGroup> groups_of(const Members& members,
                                 std::span<const SurfelMap> maps,
                                 double spacing_mm) {
  std::vector<ViewGroup> groups;
  for (const auto& group : members)
    groups.push_back(make_group(group, maps, spacing_mm));
  return groups;
}

/// Why the pose of a view was not found.
std::string reason(const JoinedGroups& joined,
                   std::size_t view,
                   std::span<const std::string> names) {
  if (const auto duplicate = joined.duplicate_of[view]) {
    return fmt::format(
        "looks the same as {}: either the part was not moved between them, or it looks alike from "
        "two sides, and then its poses must be given in a .conf",
        names[*duplicate]);
  }
  return joined.ambiguous[view]
             ? "fits the others in more than one pose, because the part looks alike from several "
               "sides"
             : "fits none of the others in a pose that their shape determines: it overlaps too "
               "little with them, or slides on them";
}

void leave_out(std::size_t view, ViewStore& views, std::vector<SurfelMap>& maps) {
  views.clear(view);
  for (auto& surfel : maps[view].surfels.pixels())
    surfel = {};
}

}  // namespace

std::string FoundPoses::text() const {
  return fmt::format(
      "the poses of {} scans are found from their shape; joined scans overlap by {:.0f} % or more",
      found,
      100.0 * least_overlap);
}

ProposedPoses propose_view_poses(const ViewStore& views,
                                 std::span<const SurfelMap> maps,
                                 const CameraModel& camera,
                                 std::span<const std::string> names,
                                 const Run& run) {
  require(maps.size() == views.size() && names.size() == views.size(),
          "find_view_poses: each view needs its map and its name");
  Members members;
  for (std::size_t i = 0; i < views.size(); ++i)
    members.push_back({{i, Eigen::Isometry3d::Identity()}});
  const double spacing_mm = spacing_for(members, maps);
  const auto groups = groups_of(members, maps, spacing_mm);
  const FastCameraModel model(camera);
  const JoinedGroups joined = join_by_shape(
      groups, {maps, model}, {.spacing_mm = spacing_mm, .leave_out_duplicates = true}, run);
  if (joined.joins.empty()) {
    throw Error(ErrorKind::Input,
                "no two scans fit together in exactly one pose: they overlap too little, or look "
                "alike from several sides; add scans between them, or give poses in a .conf");
  }
  ProposedPoses out;
  out.found.reference = joined.reference;
  out.found.accuracy_mm = spacing_mm;
  out.found.least_overlap = 1.0;
  for (const GroupJoin& group_join : joined.joins)
    out.found.least_overlap = std::min(out.found.least_overlap, group_join.fit.overlap);
  const Eigen::Isometry3d held = views.rig_from_object(joined.reference);
  out.rig_from_object.resize(views.size());
  out.reasons.resize(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (const auto& pose = joined.reference_from_group[i]) {
      out.rig_from_object[i] = pose->inverse() * held;
      ++out.found.found;
    } else {
      out.reasons[i] = reason(joined, i, names);
      out.found.left_out.push_back(i);
    }
  }
  return out;
}

void take_view_poses(ViewStore& views,
                     std::vector<SurfelMap>& maps,
                     const ProposedPoses& proposed,
                     std::span<const std::string> names,
                     const Run& run) {
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (const auto& pose = proposed.rig_from_object[i]) {
      views.set_rig_from_object(i, *pose);
    } else {
      run.warn(fmt::format("{}: {}; it is left out", names[i], proposed.reasons[i]));
      leave_out(i, views, maps);
    }
  }
}

FoundPoses find_view_poses(ViewStore& views,
                           std::vector<SurfelMap>& maps,
                           const CameraModel& camera,
                           std::span<const std::string> names,
                           const Run& run) {
  ProposedPoses proposed = propose_view_poses(views, maps, camera, names, run);
  take_view_poses(views, maps, proposed, names, run);
  return std::move(proposed.found);
}

double PoseSupport::score() const {
  constexpr double kViolationWeight = 3.0;  // as in the search
  return static_cast<double>(agree) - kViolationWeight * static_cast<double>(violations);
}

double PoseSupport::contradiction() const {
  return static_cast<double>(violations) /
         static_cast<double>(std::max<std::size_t>(1, agree + violations));
}

PoseSupport support_of_poses(std::span<const std::optional<Eigen::Isometry3d>> rig_from_object,
                             std::span<const SurfelMap> maps,
                             const CameraModel& camera) {
  constexpr double kGate = 0.3;  // spacings, as in the search
  Members members;
  for (std::size_t i = 0; i < maps.size(); ++i)
    members.push_back({{i, rig_from_object[i].value_or(Eigen::Isometry3d::Identity())}});
  const double spacing_mm = spacing_for(members, maps);
  const auto groups = groups_of(members, maps, spacing_mm);
  const FastCameraModel model(camera);
  PoseSupport support;
  for (std::size_t a = 0; a < groups.size(); ++a) {
    for (std::size_t b = a + 1; b < groups.size(); ++b) {
      if (!rig_from_object[a] || !rig_from_object[b]) continue;
      const GroupFit fit = compare_groups(
          groups[a], groups[b], Eigen::Isometry3d::Identity(), {maps, model}, kGate * spacing_mm);
      support.agree += fit.agree;
      support.violations += fit.violations;
    }
  }
  return support;
}

bool are_poses_plausible(const ViewStore& views,
                         std::span<const SurfelMap> maps,
                         const CameraModel& camera,
                         double reach_mm) {
  constexpr double kMaxViolation = 0.1;  // of the compared points; poses at random reach a third
  constexpr double kNoticed = 0.03;      // of the smaller view's points: fewer are stray
  constexpr double kWidest = 2.0;        // spacings: poses that are farther off do not converge
  Members members;
  for (std::size_t i = 0; i < views.size(); ++i)
    members.push_back({{i, views.rig_from_object(i)}});
  const double spacing_mm = spacing_for(members, maps);
  const auto groups = groups_of(members, maps, spacing_mm);
  const double gate_mm = std::min(reach_mm, kWidest * spacing_mm);
  const FastCameraModel model(camera);
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i < views.size(); ++i)
    poses.push_back(views.rig_from_object(i));
  const ViewPairs pairs = choose_view_pairs(maps, model, poses);
  for (std::size_t a = 0; a < groups.size(); ++a) {
    for (const std::size_t b : pairs[a]) {
      if (b < a) continue;
      const GroupFit fit = compare_groups(
          groups[a], groups[b], Eigen::Isometry3d::Identity(), {maps, model}, gate_mm);
      const double smaller =
          static_cast<double>(std::min(groups[a].points.size(), groups[b].points.size()));
      if (fit.free_space_violation() > kMaxViolation &&
          static_cast<double>(fit.violations) > kNoticed * smaller)
        return false;
    }
  }
  return true;
}

}  // namespace frangia
