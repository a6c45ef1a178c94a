#include "frangia/reconstruct/merge_scans.h"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "frangia/fusion/color_vertices.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/local_fit/make_surfel_maps.h"
#include "frangia/reconstruct/internal/assess_merge.h"
#include "frangia/reconstruct/internal/resample_scan.h"
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

/// Whether poses must be found by shape.
bool poses_unknown(const ScanViews& all,
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

/// Finds and refines poses as the options ask, and assesses them.
void register_scans(MergedScans& out,
                    ScanViews& all,
                    const ScanQuality& quality,
                    const MergeScansOptions& options,
                    const Run& run) {
  if (all.scans.size() < 2) {
    run.note("a single scan is not registered");
    return;
  }
  auto maps = make_surfel_maps(all.views, all.model, kSurfelsPerView, run);
  RegisterPosesOptions registration = options.registration;
  const bool find_poses = options.register_poses ? poses_unknown(all, maps, options)
                                                 : options.poses == ScanPoses::Shape;
  if (find_poses) {
    out.found_poses = find_view_poses(all.views, maps, all.model, all.names, run);
    run.note(out.found_poses->text());
    registration.reach_mm = out.found_poses->accuracy_mm;
    for (const std::size_t scan : out.found_poses->left_out)
      out.scans[scan].left_out = true;
  }
  if (options.register_poses)
    out.registration = register_poses(all.views, maps, all.model, registration, run);
  const MergeFit fit = compare_scans(all.views, maps, all.model, quality, options);
  out.contradiction = fit.contradiction;
  out.untrusted_reason = untrusted_merge_reason(fit, all.names, options);
  const bool agrees = out.untrusted_reason.empty();
  if (agrees && out.registration && out.registration->iterations > 0)
    run.note(out.registration->text());
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
  register_scans(out, all, quality, options, run);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (!out.scans[i].left_out)
      out.scans[i].world_from_scan =
          all.views.rig_from_object(i).inverse() * cameras[i].rig_from_scan;
  }
  run.stage("surface");
  Mesh fused = fuse_views(all.views, all.model, options.fusion, run);
  color_vertices(fused, all.views, all.model, run);
  FinishedMesh finished = finish_mesh(std::move(fused), options.finish, run);
  out.mesh = std::move(finished.mesh);
  out.islands = finished.removed;
  if (!out.untrusted_reason.empty()) discard_sigma(out.mesh);
  return out;
}

}  // namespace frangia
