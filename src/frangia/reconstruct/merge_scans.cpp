#include "frangia/reconstruct/merge_scans.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "frangia/fusion/color_vertices.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/reconstruct/internal/assess_merge.h"
#include "frangia/reconstruct/internal/resample_scan.h"
#include "frangia/reconstruct/internal/turntable_part.h"
#include "frangia/registration/settle_group_pose.h"
#include "frangia/views/view_store.h"

namespace frangia {
namespace {

/// The scans and their resampled views.
struct ScanViews {
  const std::vector<RangeScan>& scans;
  std::vector<std::string> names;
  CameraModel model;
  ViewStore views;
};

/// Whether poses may be such that they must be found by shape.
bool poses_in_doubt(const ScanViews& all,
                    const std::vector<SurfelMap>& maps,
                    const MergeScansOptions& options) {
  if (options.poses != ScanPoses::Auto) return options.poses == ScanPoses::Shape;
  const bool posed = std::any_of(
      all.scans.begin(), all.scans.end(), [](const RangeScan& scan) { return scan.posed; });
  const double reach_mm =
      options.registration.reach_mm > 0.0 ? options.registration.reach_mm : default_reach_mm(maps);
  return !posed && !are_poses_plausible(all.views, maps, all.model, reach_mm);
}

/// The files of the scans, or their numbers from 0 where they were not read from a file.
std::vector<std::string> names_of(const std::vector<RangeScan>& scans) {
  std::vector<std::string> names;
  names.reserve(scans.size());
  for (const RangeScan& scan : scans)
    names.push_back(scan.path.empty() ? fmt::format("scan {}", names.size()) : scan.path.string());
  return names;
}

/// Resamples the scans on the pixel grid of one camera.
ScanViews resample_all(MergedScans& out,
                       const std::vector<RangeScan>& scans,
                       ScanQuality& quality,
                       std::vector<VirtualCamera>& cameras,
                       const Run& run) {
  bool points_only = false;
  for (const RangeScan& scan : scans) {
    cameras.push_back(virtual_camera_of(scan));
    quality.spacing_mm = std::max(quality.spacing_mm, cameras.back().spacing_mm);
    points_only = points_only || scan.mesh.triangles.empty();
  }
  ScanViews all{scans, names_of(scans), common_camera_model(cameras, points_only), {}};
  run.stage("range");
  for (std::size_t i = 0; i < scans.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(scans.size()));
    ResampledScan resampled = resample_scan(scans[i], cameras[i], all.model);
    all.views.add(std::move(resampled.view));
    out.scans.push_back({.name = all.names[i],
                         .points = resampled.points,
                         .noise_mm = resampled.noise_mm,
                         .points_read = scans[i].mesh.vertices_mm.size(),
                         .dropped = resampled.dropped,
                         .size_mm = 2.0 * cameras[i].radius_mm,
                         .world_from_scan = scans[i].world_from_scan});
    out.points += resampled.points;
    quality.noise_mm = std::max(quality.noise_mm, resampled.noise_mm);
  }
  return all;
}

/// What the contradictions of a scan with the others tell of a motion that its distances do not
/// show.
struct KnownMotion {
  std::size_t scan = 0;
  Eigen::Matrix<double, 6, 1> motion;  ///< of one standard deviation
};

/// What is settled of the scans.
struct SettledScans {
  bool moved = false;               ///< whether a scan moved
  std::vector<KnownMotion> known;   ///< also where it is hardly known
  std::vector<ViewGroup> groups{};  ///< each scan
};

/// Settles what the fit of each scan to the others leaves open.
SettledScans settle_scans(ScanViews& all,
                          const std::vector<SurfelMap>& maps,
                          double prior_mm,
                          const Run& run) {
  constexpr std::size_t kMost = 24;  // scans: among more, each has several neighbours
  const std::size_t scans = all.views.size();
  if (scans > kMost) return {};
  std::vector<std::vector<ViewGroup::Member>> members;
  for (std::size_t i = 0; i < scans; ++i)
    members.push_back({{i, all.views.rig_from_object(i)}});
  const double spacing_mm = spacing_for(members, maps);
  const FastCameraModel model(all.model);
  const GroupViews views{maps, model};
  SettledScans out;
  std::vector<ViewGroup>& groups = out.groups;
  for (const auto& own : members)
    groups.push_back(make_group(own, maps, spacing_mm));
  const Eigen::Isometry3d same = Eigen::Isometry3d::Identity();
  for (std::size_t i = 1; i < scans; ++i) {
    if (groups[i].points.size() == 0) continue;
    ViewGroup others;
    for (std::size_t k = 0; k < scans; ++k)
      if (k != i) others = join_groups(others, groups[k], same);
    const SettledPose settled = settle_group_pose(
        others, groups[i], same, views, {.spacing_mm = spacing_mm, .prior_mm = prior_mm}, run);
    if (settled.moved_mm > 0.0) {
      run.note(fmt::format(
          "{} fits alike {:.2g} mm away, where it contradicts the others less: that pose is taken",
          all.names[i],
          settled.moved_mm));
      all.views.set_rig_from_object(i, all.views.rig_from_object(i) * settled.to_from.inverse());
      groups[i] = make_group({{i, all.views.rig_from_object(i)}}, maps, spacing_mm);
      out.moved = true;
    }
    constexpr double kNamed = 0.1;  // spacings: less is in sigma only
    for (const OpenMotion& open : settled.open) {
      if (open.spread_mm > kNamed * spacing_mm) {
        run.warn(fmt::format(
            "the surface of {} does not determine {} on the others: it is known to {:.2g} mm only, "
            "which is in sigma; add scans of what differs there, or give its pose in a .conf",
            all.names[i],
            open.words(),
            open.spread_mm));
      }
      out.known.push_back({i, open.motion});
    }
    for (const OpenMotion& held : settled.held)
      out.known.push_back({i, held.motion});
  }
  return out;
}

/// Refines the poses, and settles what they leave open. Returns how far the surfaces were apart
/// before.
double register_and_settle(MergedScans& out,
                           ScanViews& all,
                           const std::vector<SurfelMap>& maps,
                           const RegisterPosesOptions& options,
                           ViewMotions& motions,
                           const Run& run) {
  out.registration = register_poses(all.views, maps, all.model, options, run);
  const double rms_before_mm = out.registration->rms_before_mm;
  if (out.registration->iterations == 0) return rms_before_mm;
  // That of the first refinement, which starts from the given poses.
  RegisterPosesOptions again = options;
  again.prior_mm = out.registration->given_sigma_mm;
  const SettledScans settled = settle_scans(all, maps, again.prior_mm, run);
  if (settled.moved) out.registration = register_poses(all.views, maps, all.model, again, run);
  // Along what the distances do not show the poses have their prior, until contradictions tell
  // more.
  motions = out.registration->motions;
  for (const KnownMotion& known : settled.known) {
    narrow_motions(motions, known.scan, known.motion, settled.groups[known.scan].points.points_mm);
  }
  return rms_before_mm;
}

/// Names the scans that share no surface with the others.
void name_unverified(MergedScans& out, const MergeFit& fit, const ScanViews& all, const Run& run) {
  // That no two scans overlap is one warning, of the registration.
  const bool none_overlap = out.registration && out.registration->iterations == 0;
  for (const std::size_t scan : fit.apart) {
    out.scans[scan].unverified = true;
    if (none_overlap) continue;
    run.warn(fmt::format(
        "{} shares no surface with the other scans where its pose puts it: nothing verifies the "
        "pose; add a scan between them, or leave it out",
        all.names[scan]));
  }
}

std::vector<std::optional<Eigen::Isometry3d>> poses_of(const ViewStore& views) {
  std::vector<std::optional<Eigen::Isometry3d>> poses;
  for (std::size_t i = 0; i < views.size(); ++i)
    poses.emplace_back(views.rig_from_object(i));
  return poses;
}

/// What the surfaces say of the given poses, once these have been refined; the views keep them as
/// they are given.
PoseSupport support_of_given(ViewStore& views,
                             const std::vector<SurfelMap>& maps,
                             const CameraModel& camera,
                             const RegisterPosesOptions& options) {
  const auto given = poses_of(views);
  static_cast<void>(register_poses(views, maps, camera, options));
  const PoseSupport support = support_of_poses(poses_of(views), maps, camera);
  for (std::size_t i = 0; i < views.size(); ++i)
    views.set_rig_from_object(i, *given[i]);
  return support;
}

/// Finds poses by shape. Given ones that are only in doubt stay unless the surfaces say far more
/// for those that were found: a search has the choice among many, of which the best one of a part
/// that nearly repeats itself fits well, too. A scan does not say where its sensor was, so points
/// of right poses may seem to lie in front of its surface.
std::optional<FoundPoses> find_poses(ScanViews& all,
                                     std::vector<SurfelMap>& maps,
                                     const MergeScansOptions& options,
                                     const Run& run) {
  if (options.poses == ScanPoses::Shape) {
    FoundPoses found = find_view_poses(all.views, maps, all.model, all.names, run);
    run.note(found.text());
    return found;
  }
  constexpr double kFarMore = 2.0;
  const PoseSupport given = support_of_given(all.views, maps, all.model, options.registration);
  std::optional<ProposedPoses> proposed;
  try {
    proposed = propose_view_poses(all.views, maps, all.model, all.names, run);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Input || !(given.score() > 0.0)) throw;
  }
  const double score =
      proposed ? support_of_poses(proposed->rig_from_object, maps, all.model).score() : 0.0;
  if (!(score > kFarMore * std::max(0.0, given.score()))) {
    run.note(fmt::format(
        "{:.0f} % of the compared points lie in front of another scan where the given poses put "
        "them, but no poses that are found by shape fit far better: the given ones are kept",
        100.0 * given.contradiction()));
    return std::nullopt;
  }
  run.note(fmt::format(
      "{:.0f} % of the compared points lie in front of another scan where the given poses put "
      "them: these are not used; {}",
      100.0 * given.contradiction(),
      proposed->found.text()));
  take_view_poses(all.views, maps, *proposed, all.names, run);
  return std::move(proposed->found);
}

/// Finds and refines poses as the options ask, and assesses them. Returns what they leave open.
ViewMotions register_scans(MergedScans& out,
                           ScanViews& all,
                           const ScanQuality& quality,
                           const MergeScansOptions& options,
                           const Run& run) {
  if (all.scans.size() < 2) {
    run.note("a single scan is not registered");
    return {};
  }
  constexpr double kUnknown = 100.0;  // times the accuracy of a pose that was found: any pose
  auto maps = make_surfel_maps(all.views, all.model, kSurfelsPerView, run);
  RegisterPosesOptions registration = options.registration;
  const bool in_doubt = options.register_poses ? poses_in_doubt(all, maps, options)
                                               : options.poses == ScanPoses::Shape;
  if (in_doubt) out.found_poses = find_poses(all, maps, options, run);
  if (out.found_poses) {
    registration.reach_mm = out.found_poses->accuracy_mm;
    registration.prior_mm = kUnknown * out.found_poses->accuracy_mm;
    for (const std::size_t scan : out.found_poses->left_out)
      out.scans[scan].left_out = true;
  }
  ViewMotions motions;
  if (options.register_poses) {
    const double rms_before_mm = register_and_settle(out, all, maps, registration, motions, run);
    out.registration->rms_before_mm = rms_before_mm;
  }
  const MergeFit fit = compare_scans(all.views, maps, all.model, quality, options);
  out.contradiction = fit.contradiction;
  out.untrusted_reason = untrusted_merge_reason(fit, all.names, options);
  const bool agrees = out.untrusted_reason.empty();
  if (agrees && out.registration && out.registration->iterations > 0)
    run.note(out.registration->text());
  name_unverified(out, fit, all, run);
  return motions;
}

/// The surface of all scans, with what their poses leave open in sigma.
Mesh fuse_with_motions(const ScanViews& all,
                       const ViewMotions& motions,
                       const FusionOptions& options,
                       const Run& run) {
  if (motions.empty()) return fuse_views(all.views, all.model, options, run);
  const CameraViews cameras{all.views, all.model};
  FusedSurface surface = fuse_with_weights({&cameras, 1}, options, run);
  static_cast<void>(add_turntable_part(surface, motions, run));
  return std::move(surface.mesh);
}

}  // namespace

MergedScans merge_scans(const std::vector<RangeScan>& scans,
                        const MergeScansOptions& options,
                        const Run& run) {
  require(!scans.empty(), "there is no scan to merge; name at least one");
  MergedScans out;
  ScanQuality quality;
  std::vector<VirtualCamera> cameras;
  ScanViews all = resample_all(out, scans, quality, cameras, run);
  constexpr std::size_t kFewest = 16;  // below, no window of a local fit is full
  if (out.points < kFewest) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: none of its {} points has enough neighbours to be part of a "
                            "surface; give scans of some hundred points and more",
                            scans.front().path.string(),
                            scans.front().mesh.vertices_mm.size()));
  }
  run.stage("views");
  const ViewMotions motions = register_scans(out, all, quality, options, run);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (!out.scans[i].left_out)
      out.scans[i].world_from_scan =
          all.views.rig_from_object(i).inverse() * cameras[i].rig_from_scan;
  }
  run.stage("surface");
  Mesh fused = fuse_with_motions(all, motions, options.fusion, run);
  color_vertices(fused, all.views, all.model, run);
  FinishedMesh finished = finish_mesh(std::move(fused), options.finish, run);
  out.mesh = std::move(finished.mesh);
  out.islands = finished.removed;
  if (!out.untrusted_reason.empty()) discard_sigma(out.mesh);
  return out;
}

}  // namespace frangia
