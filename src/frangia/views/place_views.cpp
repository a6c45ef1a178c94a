#include "frangia/views/place_views.h"

#include <algorithm>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/views/join_by_shape.h"

namespace frangia {
namespace {

using Members = std::vector<std::vector<ViewGroup::Member>>;

std::vector<ViewGroup> groups_of(const Members& members,
                                 std::span<const PlaneMap> maps,
                                 double spacing_mm) {
  std::vector<ViewGroup> groups;
  for (const auto& group : members)
    groups.push_back(make_group(group, maps, spacing_mm));
  return groups;
}

/// Why a view could not be placed.
std::string reason(const JoinedGroups& joined,
                   std::size_t view,
                   std::span<const std::string> names) {
  if (const auto twin = joined.twin_of[view]) {
    return fmt::format(
        "looks the same as {}: the part was not moved, or looks alike from two "
        "sides, which needs poses in a .conf",
        names[*twin]);
  }
  return joined.ambiguous[view]
             ? "fits the others in more than one place, as parts do that look alike from several "
               "sides"
             : "fits none of the others in a place that their shape determines: it overlaps too "
               "little with them, or slides on them";
}

void leave_out(std::size_t view, ViewStore& views, std::vector<PlaneMap>& maps) {
  views.clear(view);
  for (auto& spot : maps[view].spots.pixels())
    spot = {};
}

}  // namespace

std::string PlacedViews::text() const {
  return fmt::format(
      "the poses of {} scans are found from their shape; where they meet, they overlap by {:.0f} % "
      "or more",
      placed,
      100.0 * least_overlap);
}

PlacedViews place_views(ViewStore& views,
                        std::vector<PlaneMap>& maps,
                        const Lens& camera,
                        std::span<const std::string> names,
                        const Run& run) {
  require(maps.size() == views.size() && names.size() == views.size(),
          "place_views: each view needs its map and its name");
  Members members;
  for (std::size_t i = 0; i < views.size(); ++i)
    members.push_back({{i, Eigen::Isometry3d::Identity()}});
  const double spacing_mm = spacing_for(members, maps);
  const auto groups = groups_of(members, maps, spacing_mm);
  const FastLens lens(camera);
  const JoinedGroups joined =
      join_by_shape(groups, {maps, lens}, {.spacing_mm = spacing_mm, .leave_out_twins = true}, run);
  if (joined.joints.empty()) {
    throw Error(ErrorKind::Input,
                "no two scans fit together in just one place: they overlap too little, or look "
                "alike from several sides; add scans between them, or give poses in a .conf");
  }
  PlacedViews out;
  out.reference = joined.reference;
  out.near_mm = spacing_mm;
  out.least_overlap = 1.0;
  for (const Joint& joint : joined.joints)
    out.least_overlap = std::min(out.least_overlap, joint.fit.overlap);
  const Eigen::Isometry3d held = views.rig_from_object(out.reference);
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (const auto& pose = joined.reference_from_group[i]) {
      views.set_rig_from_object(i, pose->inverse() * held);
      ++out.placed;
    } else {
      run.warn(fmt::format("{}: {}; it is left out", names[i], reason(joined, i, names)));
      leave_out(i, views, maps);
      out.left_out.push_back(i);
    }
  }
  return out;
}

bool poses_can_be(const ViewStore& views,
                  std::span<const PlaneMap> maps,
                  const Lens& camera,
                  double reach_mm) {
  constexpr double kAgainst = 0.1;
  constexpr double kNoticed = 0.03;  // of the smaller one's points: fewer are stray
  constexpr double kWidest = 2.0;    // spacings: farther apart, poses are not nearly right
  Members members;
  for (std::size_t i = 0; i < views.size(); ++i)
    members.push_back({{i, views.rig_from_object(i)}});
  const double spacing_mm = spacing_for(members, maps);
  const auto groups = groups_of(members, maps, spacing_mm);
  const double gate_mm = std::min(reach_mm, kWidest * spacing_mm);
  const FastLens lens(camera);
  for (std::size_t a = 0; a < groups.size(); ++a) {
    for (std::size_t b = a + 1; b < groups.size(); ++b) {
      const GroupFit fit = compare_groups(
          groups[a], groups[b], Eigen::Isometry3d::Identity(), {maps, lens}, gate_mm);
      const double smaller =
          static_cast<double>(std::min(groups[a].points.size(), groups[b].points.size()));
      if (fit.contradiction() > kAgainst && static_cast<double>(fit.against) > kNoticed * smaller)
        return false;
    }
  }
  return true;
}

}  // namespace frangia
