#include "frangia/registration/view_group.h"

#include <utility>

#include <Eigen/Geometry>

#include "frangia/core/statistics.h"

namespace frangia {
namespace {

/// Surfels of all members, in the group's frame.
SurfacePoints points_of(const std::vector<ViewGroup::Member>& members,
                        std::span<const SurfelMap> maps) {
  constexpr std::size_t kSurfels = 40000;  // of a view: denser than any spacing
  SurfacePoints points;
  for (const ViewGroup::Member& member : members) {
    const Eigen::Isometry3f group_from_rig = member.rig_from_group.inverse().cast<float>();
    for (const SurfelMap::Surfel& surfel : pick_surfels(maps[member.view], kSurfels))
      points.add(group_from_rig * surfel.point_mm, group_from_rig.linear() * surfel.normal);
  }
  return points;
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
  if (sizes.empty()) return 1.0;  // any length serves
  return kShare * median(std::move(sizes));
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
