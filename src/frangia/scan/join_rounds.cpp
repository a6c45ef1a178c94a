#include "frangia/scan/join_rounds.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "frangia/views/join_by_shape.h"
#include "frangia/views/map_views.h"

namespace frangia {
namespace {

/// Every view of every round in little.
struct MappedRounds {
  std::vector<PlaneMap> maps;
  std::vector<std::vector<ViewGroup::Member>> members;  ///< by round
};

MappedRounds map_rounds(const std::vector<Round>& rounds, const Lens& camera, const Run& run) {
  MappedRounds all;
  for (const Round& round : rounds) {
    const ViewStore& views = round.measured.views;
    std::vector<ViewGroup::Member> members;
    for (PlaneMap& map : map_views(views, camera, 250000, run)) {
      members.push_back({all.maps.size(), views.rig_from_object(members.size())});
      all.maps.push_back(std::move(map));
    }
    all.members.push_back(std::move(members));
  }
  return all;
}

std::string name_of(const Round& round) {
  const auto& stops = round.measured.stops;
  return fmt::format("round {} ({} to {})", round.number, stops.front().name, stops.back().name);
}

/// Where each round stands as seen from the reference; none where nobody can tell.
struct Placed {
  std::size_t reference = 0;
  std::vector<std::optional<Eigen::Isometry3d>> round_from_reference;
};

/// By the placings of scan.toml, when it has those of all rounds but the first.
std::optional<Placed> as_given(const std::vector<Round>& rounds,
                               const std::vector<ViewGroup>& groups,
                               const GroupViews& views,
                               const JoinRoundsOptions& options,
                               double spacing_mm) {
  constexpr double kStart = 4.0;  // spacings: what people can tell
  constexpr double kGate = 0.3;
  Placed placed{0, {Eigen::Isometry3d::Identity()}};
  for (std::size_t i = 1; i < rounds.size(); ++i) {
    const auto known = options.placings.find(rounds[i].number);
    if (known == options.placings.end() || rounds[0].number != 0) return std::nullopt;
    const Eigen::Isometry3d reference_from_round =
        refine_fit(groups[0],
                   groups[i],
                   known->second.inverse(),
                   views,
                   {kStart * spacing_mm, kGate * spacing_mm});
    const GroupFit fit =
        compare_groups(groups[0], groups[i], reference_from_round, views, kGate * spacing_mm);
    const JoinByShapeOptions usual;
    const bool fits =
        fit.overlap >= usual.min_overlap && fit.contradiction() <= 3.0 * usual.max_contradiction;
    placed.round_from_reference.push_back(fits ? std::optional(reference_from_round.inverse())
                                               : std::nullopt);
  }
  return placed;
}

Placed find_placings(const std::vector<Round>& rounds,
                     const Lens& camera,
                     const JoinRoundsOptions& options,
                     const Run& run) {
  const MappedRounds all = map_rounds(rounds, camera, run);
  const double spacing_mm = spacing_for(all.members, all.maps);
  std::vector<ViewGroup> groups;
  for (const auto& members : all.members)
    groups.push_back(make_group(members, all.maps, spacing_mm));
  const FastLens lens(camera);
  const GroupViews views{all.maps, lens};
  if (auto given = as_given(rounds, groups, views, options, spacing_mm)) return *given;
  const JoinedGroups joined = join_by_shape(groups, views, {.spacing_mm = spacing_mm}, run);
  Placed placed{joined.reference, {}};
  for (const auto& pose : joined.reference_from_group)
    placed.round_from_reference.push_back(pose ? std::optional(pose->inverse()) : std::nullopt);
  return placed;
}

/// Appends the views of a round, as round `index` of those that stay.
void append(MeasuredViews& all, const MeasuredViews& round, std::size_t index) {
  for (std::size_t i = 0; i < round.views.size(); ++i) {
    all.views.add(round.views.load(i));
    all.stops.push_back(round.stops[i]);
    all.stops.back().round = index;
  }
  all.points += round.points;
}

Turntable table_of(const Round& round, const Rig& rig) {
  return round.registration ? round.registration->table : *rig.turntable;
}

/// Poses as the placings have them, for who wants none refined.
void set_poses(Round& joined, const Rig& rig, const std::vector<Eigen::Isometry3d>& placings) {
  for (std::size_t i = 0; i < joined.measured.stops.size(); ++i) {
    const RegisteredView& stop = joined.measured.stops[i];
    const Eigen::Isometry3d pose = rig.rig_from_object(stop.angle_rad);
    joined.measured.views.set_rig_from_object(
        i, stop.round == 0 ? pose : pose * placings[stop.round - 1]);
  }
}

}  // namespace

std::vector<Round> split_rounds(MeasuredViews all, const std::vector<int>& numbers) {
  std::map<int, std::vector<std::size_t>> views;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    views[numbers[i]].push_back(i);
  std::vector<Round> rounds;
  if (views.size() < 2) {
    rounds.push_back({numbers.empty() ? 0 : numbers.front(), std::move(all), {}});
    return rounds;
  }
  for (const auto& [number, which] : views) {
    Round round{number, {}, {}};
    round.measured.coarsest = all.coarsest;
    round.measured.unwrapped_in_space = all.unwrapped_in_space;
    for (std::size_t i = 0; i < which.size(); ++i) {
      const View view = all.views.load(which[i]);
      const auto depth = view.range.depth_mm.pixels();
      round.measured.points += static_cast<std::size_t>(
          std::count_if(depth.begin(), depth.end(), [](float z) { return !std::isnan(z); }));
      round.measured.views.add(view);
      round.measured.stops.push_back(all.stops[which[i]]);
      for (LoosePart& part : all.loose) {
        if (part.view == which[i]) round.measured.loose.push_back({i, std::move(part.region)});
      }
    }
    rounds.push_back(std::move(round));
  }
  return rounds;
}

Round join_rounds(std::vector<Round> rounds,
                  const Rig& rig,
                  const JoinRoundsOptions& options,
                  const Run& run) {
  const Lens& camera = rig.camera.lens;
  const Placed placed = find_placings(rounds, camera, options, run);
  Round& reference = rounds[placed.reference];
  const Eigen::Isometry3d given_from_rig = rig.rig_from_object(0.0).inverse();
  const Eigen::Isometry3d reference_from_rig =
      table_of(reference, rig).rig_from_object(0.0).inverse();
  Round joined{reference.number, {}, {}};
  joined.measured.coarsest = reference.measured.coarsest;
  append(joined.measured, reference.measured, 0);
  RegisterOptions registration = options.registration;
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    if (i == placed.reference) continue;
    const auto& placing = placed.round_from_reference[i];
    if (!placing) {
      run.warn(fmt::format(
          "{} fits the other rounds in no one place and is left out: take more views of what both "
          "show, or say roughly how the part stands in a [[round]] of scan.toml",
          name_of(rounds[i])));
      continue;
    }
    // Both rounds have a table of their own as yet: through the rig, into the given table's frame.
    registration.placings.emplace_back(given_from_rig *
                                       table_of(rounds[i], rig).rig_from_object(0.0) * *placing *
                                       reference_from_rig * given_from_rig.inverse());
    append(joined.measured, rounds[i].measured, registration.placings.size());
  }
  if (!options.refine) {
    set_poses(joined, rig, registration.placings);
    return joined;
  }
  joined.registration = register_views(
      joined.measured.views, camera, {*rig.turntable, joined.measured.stops}, registration, run);
  return joined;
}

}  // namespace frangia
