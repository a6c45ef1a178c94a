#include "frangia/reconstruct/internal/register_setups.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/held_messages.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/registration/compare_groups.h"
#include "frangia/registration/join_by_shape.h"
#include "frangia/registration/settle_group_pose.h"

namespace frangia {
namespace {

/// The surfel maps of all views of all setups.
struct MappedSetups {
  std::vector<SurfelMap> maps;
  std::vector<std::vector<ViewGroup::Member>> members;  ///< by setup
};

MappedSetups map_setups(const std::vector<MeasuredSetup>& setups,
                        const CameraModel& camera,
                        const Run& run) {
  MappedSetups all;
  for (const MeasuredSetup& setup : setups) {
    const ViewStore& views = setup.measured.reference();
    std::vector<ViewGroup::Member> members;
    for (SurfelMap& map : make_surfel_maps(views, camera, kSurfelsPerView, run)) {
      members.push_back({all.maps.size(), views.rig_from_object(members.size())});
      all.maps.push_back(std::move(map));
    }
    all.members.push_back(std::move(members));
  }
  return all;
}

std::string name_of(const MeasuredSetup& setup) {
  const auto& stations = setup.measured.stations;
  return fmt::format(
      "setup {} ({} to {})", setup.number, stations.front().name, stations.back().name);
}

/// Pose of each setup relative to the reference; none when it is not known.
struct SetupPoses {
  std::size_t reference = 0;
  std::vector<std::optional<Eigen::Isometry3d>> setup_from_reference;
  std::vector<bool> ambiguous;                  ///< empty where the poses are given
  std::vector<GroupFit> fits;                   ///< to the reference, in its pose
  std::vector<std::vector<OpenMotion>> open{};  ///< what its surfaces leave open, reference frame
  std::vector<std::vector<std::string>> sentences{};  ///< the same in words, where it matters
};

/// The groups of all joined setups but one, in the frame of the reference.
ViewGroup others_of(const std::vector<ViewGroup>& groups,
                    const SetupPoses& poses,
                    std::size_t without) {
  ViewGroup all;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (i == without || !poses.setup_from_reference[i]) continue;
    all = join_groups(all, groups[i], poses.setup_from_reference[i]->inverse());
  }
  return all;
}

/// Settles what the fit of a setup to the others leaves open.
void settle(SetupPoses& poses,
            std::size_t setup,
            const std::vector<MeasuredSetup>& setups,
            const std::vector<ViewGroup>& groups,
            const GroupViews& views,
            const SettleOptions& options,
            const Run& run) {
  poses.open.resize(groups.size());
  poses.sentences.resize(groups.size());
  auto& pose = poses.setup_from_reference[setup];
  SettledPose settled = settle_group_pose(
      others_of(groups, poses, setup), groups[setup], pose->inverse(), views, options, run);
  if (settled.moved_mm > 0.0) {
    run.note(
        fmt::format("{} fits alike {:.2g} mm away, where its surfaces contradict the others less: "
                    "that pose is taken",
                    name_of(setups[setup]),
                    settled.moved_mm));
  }
  pose = settled.to_from.inverse();
  constexpr double kNamed = 0.1;  // spacings: less is in sigma only
  for (const OpenMotion& open : settled.open) {
    if (open.spread_mm < kNamed * options.spacing_mm) continue;
    poses.sentences[setup].push_back(fmt::format(
        "the surface of {} does not determine {} on the others: it is known to {:.2g} mm only, "
        "which is in sigma; add views of what differs there, or stickers",
        name_of(setups[setup]),
        open.words(),
        open.spread_mm));
    run.warn(poses.sentences[setup].back());
  }
  poses.open[setup] = std::move(settled.open);
}

/// Refines the part poses of scan.toml, each on those before it. None unless scan.toml has those of
/// all further setups.
std::optional<SetupPoses> refine_given_poses(const std::vector<MeasuredSetup>& setups,
                                             const std::vector<ViewGroup>& groups,
                                             const GroupViews& views,
                                             const RegisterSetupsOptions& options,
                                             double spacing_mm,
                                             const Run& run) {
  constexpr double kStart = 4.0;         // spacings: the error of manually measured poses
  constexpr double kStated = 2.0;        // spacings: their standard deviation
  constexpr double kGate = 0.3;          // spacings, as in the pose search
  constexpr double kMaxViolation = 3.0;  // times that of poses found by shape: these are given
  const JoinByShapeOptions usual;
  SetupPoses poses{0, {}, {}, {}};
  poses.setup_from_reference.resize(setups.size());
  poses.setup_from_reference[0] = Eigen::Isometry3d::Identity();
  for (std::size_t i = 1; i < setups.size(); ++i)
    if (!options.part_poses.contains(setups[i].number) || setups[0].number != 0)
      return std::nullopt;
  for (std::size_t i = 1; i < setups.size(); ++i) {
    auto& pose = poses.setup_from_reference[i];
    const ViewGroup others = others_of(groups, poses, i);
    const auto fit = [&] {
      return compare_groups(others, groups[i], pose->inverse(), views, kGate * spacing_mm);
    };
    pose = refine_fit(others,
                      groups[i],
                      options.part_poses.at(setups[i].number).inverse(),
                      views,
                      {kStart * spacing_mm, kGate * spacing_mm})
               .inverse();
    if (fit().overlap >= usual.min_overlap) {
      settle(poses,
             i,
             setups,
             groups,
             views,
             {.spacing_mm = spacing_mm, .prior_mm = kStated * spacing_mm},
             run);
      if (fit().free_space_violation() <= kMaxViolation * usual.max_violation) continue;
    }
    pose.reset();
  }
  return poses;
}

/// Adds what the surfaces of setups leave open to the motions of their views.
void add_open_motions(ViewMotions& motions,
                      const std::vector<Station>& stations,
                      const std::vector<std::vector<OpenMotion>>& open) {
  if (motions.size() != stations.size()) return;
  for (std::size_t setup = 0; setup < open.size(); ++setup) {
    for (const OpenMotion& motion : open[setup]) {
      for (std::size_t view = 0; view < motions.size(); ++view) {
        auto& own = motions[view];
        own.conservativeResize(Eigen::NoChange, own.cols() + 1);
        own.rightCols<1>().setZero();
        if (stations[view].setup == setup) own.rightCols<1>() = motion.motion;
      }
    }
  }
}

/// Poses of the setups whose targets match those of a setup that is joined already. None unless all
/// match. Where they match in two ways alike, the user is told.
std::optional<SetupPoses> join_by_targets(const std::vector<MeasuredSetup>& setups,
                                          const ScanTargets& targets,
                                          const Run& run) {
  std::vector<std::vector<Target>> found;
  for (const MeasuredSetup& setup : setups)
    found.push_back(match_targets(target_views(targets, setup.measured), targets.set));
  SetupPoses poses{0, {}, {}, {}};
  poses.setup_from_reference.resize(setups.size());
  poses.setup_from_reference[0] = Eigen::Isometry3d::Identity();
  std::size_t joined = 1;
  for (bool grows = true; grows && joined < setups.size();) {
    grows = false;
    for (std::size_t from = 1; from < setups.size(); ++from) {
      if (poses.setup_from_reference[from]) continue;
      for (std::size_t to = 0; to < setups.size(); ++to) {
        if (!poses.setup_from_reference[to]) continue;
        const auto join = join_targets(found[to], found[from], targets.set);
        if (!join) continue;
        if (join->ambiguous()) {
          run.warn(fmt::format(
              "{} and {} have {} targets in common that match in more than one way: move one, or "
              "use coded ones",
              name_of(setups[to]),
              name_of(setups[from]),
              join->pairs.size()));
          continue;
        }
        run.note(fmt::format("{} is joined to {} by {} targets, which agree to {:.3f} mm",
                             name_of(setups[from]),
                             name_of(setups[to]),
                             join->pairs.size(),
                             join->rms_mm));
        poses.setup_from_reference[from] =
            join->to_from.inverse() * *poses.setup_from_reference[to];
        ++joined;
        grows = true;
        break;
      }
    }
  }
  return joined == setups.size() ? std::optional(std::move(poses)) : std::nullopt;
}

SetupPoses find_part_poses(const std::vector<MeasuredSetup>& setups,
                           const CameraModel& camera,
                           const RegisterSetupsOptions& options,
                           const Run& run) {
  const MappedSetups all = map_setups(setups, camera, run);
  const double spacing_mm = spacing_for(all.members, all.maps);
  std::vector<ViewGroup> groups;
  for (const auto& members : all.members)
    groups.push_back(make_group(members, all.maps, spacing_mm));
  const FastCameraModel model(camera);
  const GroupViews views{all.maps, model};
  constexpr double kGate = 0.3;  // spacings, as in the pose search
  const auto with_fits = [&](SetupPoses poses) {
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const auto& pose = poses.setup_from_reference[i];
      poses.fits.push_back(
          pose && i != poses.reference
              ? compare_groups(
                    groups[poses.reference], groups[i], pose->inverse(), views, kGate * spacing_mm)
              : GroupFit());
    }
    return poses;
  };
  if (options.targets != nullptr) {
    if (auto by_targets = join_by_targets(setups, *options.targets, run))
      return with_fits(std::move(*by_targets));
  }
  if (auto given = refine_given_poses(setups, groups, views, options, spacing_mm, run))
    return with_fits(std::move(*given));
  const JoinByShapeOptions by_shape{.spacing_mm = spacing_mm, .may_turn = true};
  const JoinedGroups joined = join_by_shape(groups, views, by_shape, run);
  SetupPoses setup_poses{joined.reference, {}, joined.ambiguous, {}};
  for (const auto& pose : joined.reference_from_group) {
    setup_poses.setup_from_reference.push_back(pose ? std::optional(pose->inverse())
                                                    : std::nullopt);
  }
  // Each on those that are settled: two with any turn each contradict a third one.
  std::vector<std::optional<Eigen::Isometry3d>> found(groups.size());
  found.swap(setup_poses.setup_from_reference);
  setup_poses.setup_from_reference[joined.reference] = found[joined.reference];
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (!found[i] || i == joined.reference) continue;
    setup_poses.setup_from_reference[i] = found[i];
    const GroupFit fit = compare_groups(others_of(groups, setup_poses, i),
                                        groups[i],
                                        found[i]->inverse(),
                                        views,
                                        kGate * spacing_mm);
    const bool turns = fit.smallest_eigenvalue < by_shape.well_constrained && fit.weakest_axis();
    if (turns) settle(setup_poses, i, setups, groups, views, {.spacing_mm = spacing_mm}, run);
  }
  return with_fits(std::move(setup_poses));
}

/// Appends the views of a setup, as setup `index` of those that are joined.
void append(MeasuredViews& all, const MeasuredViews& setup, std::size_t index) {
  all.cameras.resize(setup.cameras.size());
  for (std::size_t i = 0; i < setup.stations.size(); ++i) {
    for (std::size_t camera = 0; camera < setup.cameras.size(); ++camera)
      all.cameras[camera].add(setup.cameras[camera].load(i));
    all.stations.push_back(setup.stations[i]);
    all.stations.back().setup = index;
  }
  all.points += setup.points;
}

/// What is known of the joins before they are refined.
std::vector<SetupJoin> joins_of(const std::vector<MeasuredSetup>& setups, const SetupPoses& poses) {
  std::vector<SetupJoin> joins;
  for (std::size_t i = 0; i < setups.size(); ++i) {
    SetupJoin join{.number = setups[i].number, .views = setups[i].measured.reference().size()};
    join.joined = poses.setup_from_reference[i].has_value();
    join.ambiguous = !join.joined && i < poses.ambiguous.size() && poses.ambiguous[i];
    if (join.joined && i != poses.reference) {
      join.overlap = poses.fits[i].overlap;
      join.free_space_violation = poses.fits[i].free_space_violation();
    }
    if (i < poses.sentences.size()) join.open = poses.sentences[i];
    joins.push_back(join);
  }
  return joins;
}

Turntable table_of(const MeasuredSetup& setup, const Rig& rig) {
  return setup.registration ? setup.registration->table : *rig.turntable;
}

/// Sets the poses from the part poses, without refinement.
void set_poses(MeasuredSetup& joined,
               const Rig& rig,
               const std::vector<Eigen::Isometry3d>& part_poses) {
  for (std::size_t i = 0; i < joined.measured.stations.size(); ++i) {
    const Station& station = joined.measured.stations[i];
    const Eigen::Isometry3d pose = rig.rig_from_object(station.angle_rad);
    joined.measured.reference().set_rig_from_object(
        i, station.setup == 0 ? pose : pose * part_poses[station.setup - 1]);
  }
}

/// Whether setups by themselves have told what the joined views show: the same cause at the same
/// views, of which the size may differ in its last digit.
bool told_by_setups(const PoseExplanation& found,
                    const MeasuredSetup& joined,
                    const std::vector<MeasuredSetup>& setups) {
  std::set<std::string> told;
  for (const MeasuredSetup& setup : setups) {
    if (!setup.registration || setup.registration->explanation.best != found.best) continue;
    for (const std::size_t view : setup.registration->explanation.views)
      told.insert(setup.measured.stations[view].name);
  }
  return !found.views.empty() &&
         std::all_of(found.views.begin(), found.views.end(), [&](std::size_t view) {
           return told.contains(joined.measured.stations[view].name);
         });
}

}  // namespace

MeasuredSetup register_setups(std::vector<MeasuredSetup> setups,
                              const Rig& rig,
                              const RegisterSetupsOptions& options,
                              const Run& run) {
  const CameraModel& camera = rig.reference().model;
  const SetupPoses setup_poses = find_part_poses(setups, camera, options, run);
  MeasuredSetup& reference = setups[setup_poses.reference];
  const Eigen::Isometry3d given_from_rig = rig.rig_from_object(0.0).inverse();
  const Eigen::Isometry3d reference_from_rig =
      table_of(reference, rig).rig_from_object(0.0).inverse();
  MeasuredSetup joined{reference.number, {}, {}, joins_of(setups, setup_poses)};
  joined.measured.coarsest = reference.measured.coarsest;
  append(joined.measured, reference.measured, 0);
  RegisterOptions registration = options.registration;
  std::vector<std::vector<OpenMotion>> open(1);  // by the setups that are joined
  for (std::size_t i = 0; i < setups.size(); ++i) {
    if (i == setup_poses.reference) continue;
    const auto& part_pose = setup_poses.setup_from_reference[i];
    if (!part_pose) {
      run.warn(fmt::format(
          "{} fits the other setups in no unique pose and is left out: add views of the surface "
          "that both show, or give its approximate part pose in a [[setup]] of scan.toml",
          name_of(setups[i])));
      continue;
    }
    // Each setup still has a refined table of its own: convert through the rig into the given
    // table's frame.
    registration.part_poses.emplace_back(
        given_from_rig * table_of(setups[i], rig).rig_from_object(0.0) * *part_pose *
        reference_from_rig * given_from_rig.inverse());
    append(joined.measured, setups[i].measured, registration.part_poses.size());
    open.push_back(i < setup_poses.open.size() ? setup_poses.open[i] : std::vector<OpenMotion>());
  }
  set_poses(joined, rig, registration.part_poses);
  if (options.refine) {
    std::vector<PointTie> ties;
    if (options.targets != nullptr) ties = target_ties(*options.targets, joined.measured);
    TurntableStations given{*rig.turntable, joined.measured.stations};
    given.ties = ties;
    HeldMessages held;
    joined.registration = held.during(run, [&](const Run& attempt) {
      return register_views(joined.measured.reference(), camera, given, registration, attempt);
    });
    if (told_by_setups(joined.registration->explanation, joined, setups))
      held.forget(joined.registration->explanation.text);
    held.pass_on(run);
    // The views of one setup say what the rig is; they are explained without one here.
    if (reference.registration) joined.registration->rig_open = reference.registration->rig_open;
    add_open_motions(joined.registration->motions, joined.measured.stations, open);
  }
  const auto& found =
      joined.registration ? joined.registration->part_poses : registration.part_poses;
  std::size_t next = 0;
  for (std::size_t i = 0; i < joined.joins.size(); ++i) {
    if (i != setup_poses.reference && joined.joins[i].joined && next < found.size())
      joined.joins[i].part_pose = found[next++];
  }
  return joined;
}

}  // namespace frangia
