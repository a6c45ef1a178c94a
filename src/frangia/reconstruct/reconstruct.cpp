#include "frangia/reconstruct/reconstruct.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "frangia/core/held_messages.h"
#include "frangia/core/missing.h"
#include "frangia/core/pixel_buffer.h"
#include "frangia/fusion/color_vertices.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/reconstruct/capabilities.h"
#include "frangia/reconstruct/internal/calibration_part.h"
#include "frangia/reconstruct/internal/check_geometry.h"
#include "frangia/reconstruct/internal/correct_indirect_light.h"
#include "frangia/reconstruct/internal/explain_no_surface.h"
#include "frangia/reconstruct/internal/found_angles.h"
#include "frangia/reconstruct/internal/measure_views.h"
#include "frangia/reconstruct/internal/points_of_setups.h"
#include "frangia/reconstruct/internal/register_setups.h"
#include "frangia/reconstruct/internal/remove_background.h"
#include "frangia/reconstruct/internal/resolve_fringe_orders.h"
#include "frangia/reconstruct/internal/scan_silhouettes.h"
#include "frangia/reconstruct/internal/scan_targets.h"
#include "frangia/reconstruct/internal/split_setups.h"
#include "frangia/reconstruct/internal/tie_cameras.h"
#include "frangia/reconstruct/internal/trust.h"
#include "frangia/reconstruct/internal/turntable_part.h"
#include "frangia/reconstruct/refine_scan_rig.h"

namespace frangia {
namespace {

/// How well the points agree that were measured twice.
std::vector<RigAgreement> agreements_of(const MeasuredViews& measured, const Rig& rig) {
  std::vector<RigAgreement> out;
  if (auto found = agreement_of_directions(
          measured.direction_agreements, rig, measured.first, measured.second))
    out.push_back(std::move(*found));
  if (auto found = agreement_of_cameras(measured.camera_agreements))
    out.push_back(std::move(*found));
  return out;
}

/// Whether the views of a setup were triangulated again by a rig that drifts, so that their targets
/// are elsewhere, too.
bool drifts(const MeasuredSetup& setup) {
  if (!setup.registration) return false;
  const PoseExplanation& found = setup.registration->explanation;
  return found.decided && found.best == PoseCause::RigDrift;
}

/// Finds the targets of a scan that has some.
std::optional<ScanTargets> targets_of(const Scan& scan,
                                      const MeasuredViews& measured,
                                      const ReconstructOptions& options,
                                      const Run& run) {
  if (scan.targets) return find_scan_targets(scan, measured, run);
  require(!options.fill_targets,
          "`fill_targets` needs the targets of the scan: describe them in [targets] of scan.toml");
  return std::nullopt;
}

/// Removes what is not the part from the views of one setup, corrects them for indirect light, and
/// registers them on the turntable.
EarlyIndirectLight register_setup(MeasuredSetup& setup,
                                  const LitScan& lit,
                                  const Capabilities& can,
                                  const ReconstructOptions& options,
                                  std::optional<ScanTargets>& targets,
                                  double& turntable_top_height_mm,
                                  const Run& run) {
  MeasuredViews& measured = setup.measured;
  const Scan& scan = lit.scan;
  const CameraModel& camera = scan.rig.reference().model;
  EarlyIndirectLight indirect_light;
  if (measured.points == 0) return indirect_light;
  clip_to_volume(measured, scan.rig, options, run);
  if (can.removes_turntable_top)
    turntable_top_height_mm = remove_turntable_top(measured, scan.rig, run);
  if (can.registers_views) {
    if (can.corrects_before_registration)
      indirect_light = correct_before_registration(measured, lit, options.fusion, run);
    TurntableStations given = stations_of(scan.rig, measured);
    std::vector<PointTie> ties;
    if (targets) ties = target_ties(*targets, measured);
    given.ties = ties;
    setup.registration =
        register_views(measured.reference(), camera, given, options.registration, run);
    if (targets && drifts(setup)) {
      for (auto& [name, sightings] : find_scan_targets(scan, measured, run).sightings)
        targets->sightings[name] = std::move(sightings);
    }
    clear_outliers_of_cameras(setup);
  }
  return indirect_light;
}

MeasuredSetup join_setups(std::vector<MeasuredSetup> setups,
                          const Scan& scan,
                          const ReconstructOptions& options,
                          const std::optional<ScanTargets>& targets,
                          const Run& run) {
  if (setups.size() == 1) return std::move(setups.front());
  return register_setups(std::move(setups),
                         scan.rig,
                         {scan.part_poses,
                          options.register_views,
                          options.registration,
                          targets ? &*targets : nullptr},
                         run);
}

/// Brings all setups into the frame of the first one and registers them together. `outliers`: views
/// that the setups by themselves left out.
MeasuredSetup register_together(std::vector<MeasuredSetup> setups,
                                const Scan& scan,
                                const ReconstructOptions& options,
                                const std::optional<ScanTargets>& targets,
                                std::set<std::string> outliers,
                                Reconstruction& out,
                                const Run& run) {
  MeasuredSetup joined = join_setups(std::move(setups), scan, options, targets, run);
  clear_outliers_of_cameras(joined);
  if (joined.registration && joined.registration->iterations > 0)
    run.note(joined.registration->fit_text());
  add_outliers(outliers, joined);
  mark_left_out(out.view_summaries, joined, outliers);
  warn_of_copies(out.view_summaries, run);
  clip_on_registered_turntable(joined, scan.rig, options, run);
  tie_cameras(joined.measured, scan.rig);
  out.registration = joined.registration;
  release_cached_pixels();

  out.setups = joined.joins;
  if (options.keep_points_of_setups > 0 && !out.setups.empty())
    out.setup_points = points_of_setups(joined, scan.rig, options.keep_points_of_setups, run);
  return joined;
}

/// What the registered views of all setups form.
struct RegisteredViews {
  MeasuredSetup joined;
  EarlyIndirectLight indirect_light;  ///< as found before the registration
};

/// Views -> one surface, with its points and colors.
FusedSurface fuse_registered(RegisteredViews& registered,
                             const LitScan& lit,
                             const Capabilities& can,
                             const ReconstructOptions& options,
                             Reconstruction& out,
                             const Run& run) {
  run.stage("surface");
  const Scan& scan = lit.scan;
  MeasuredSetup& joined = registered.joined;
  const MeasuredViews& all = joined.measured;
  FusionOptions fusion = options.fusion;
  const Rig rig = joined.registration
                      ? with_open_parameters(scan.rig, joined.registration->rig_open)
                      : scan.rig;
  fusion.terms = calibration_part(all.reference(), rig, all.coarsest, lit.rays);
  const std::vector<CameraViews> cameras = views_of_cameras(all, scan.rig);
  if (can.indirect_light != IndirectLightUse::Ignored && registered.indirect_light.found) {
    out.indirect_light =
        cameras.size() == 1
            ? correct_indirect_light(joined.measured, lit, registered.indirect_light, fusion, run)
            : count_indirect_light(joined.measured, lit, fusion, run);
  }
  FusedSurface fused = fuse_with_weights(cameras, fusion, run);
  const ViewMotions motions = motions_of_views(joined, scan.rig, options.registration, run);
  const bool turntable_counts = add_turntable_part(fused, motions, run);
  if (options.keep_raw) {
    out.raw = collect_points_of_cameras(cameras, run, fusion.terms);
    if (turntable_counts) add_turntable_part(out.raw, cameras, motions, run);
  }
  color_vertices(fused.mesh, cameras, run);
  return fused;
}

/// Refines the rig and reconstructs with it from the frames on.
Reconstruction reconstruct_with_refined_rig(const Scan& scan,
                                            ReconstructOptions options,
                                            const Run& run) {
  options.refine_rig = false;
  options.explain_rig = false;
  options.decoded = nullptr;  // with the rig before
  options.registration.wrong_rig = WrongRig::AdviseCalibration;
  RigRefinement refinement = refine_scan_rig(scan, options, run);
  run.note(refinement.text());
  Scan refined = scan;
  refined.rig = refinement.rig;
  Reconstruction out = reconstruct(refined, options, run);
  out.refinement = std::move(refinement);
  return out;
}

/// Looks for the angles of views that no other view has corrected by wrong angles: those points
/// alone whose fringe orders a view knows by itself.
std::optional<ScanWithAngles> angles_without_other_views(const LitScan& lit,
                                                         Capabilities can,
                                                         const DecodeOptions& decode,
                                                         const ReconstructOptions& options,
                                                         std::optional<ScanTargets> targets,
                                                         const Run& run) {
  HeldMessages unused;
  const Run quiet = unused.in_place_of(run);
  can.corrects_before_registration = false;
  MeasuredViews measured =
      measure_views(lit.scan, lit.rays, decode, options.mixed_pixels, quiet, options.decoded);
  if (can.removes_background)
    static_cast<void>(leave_out_background(measured, lit.scan.rig, quiet));
  std::vector<MeasuredSetup> setups = split_setups(std::move(measured));
  for (MeasuredSetup& setup : setups) {
    double height_mm = kMissing;
    register_setup(setup, lit, can, options, targets, height_mm, quiet);
  }
  return with_found_angles(lit.scan, setups);
}

/// Whether the angles of a scan are those it states.
enum class ScanAngles : std::uint8_t { Stated, Found };

Reconstruction reconstruct_by(ScanAngles angles,
                              const Scan& scan,
                              const ReconstructOptions& given,
                              const Run& run) {
  ReconstructOptions options = given;
  if (options.explain_rig) options.registration.wrong_rig = WrongRig::IsRefined;
  if (options.refine_rig) return reconstruct_with_refined_rig(scan, options, run);
  const DecodePlan plan = plan_decoding(scan.patterns, scan.rig, options.decode);
  check_geometry(scan, plan, run);
  const Capabilities can = capabilities_of(scan.rig, plan, options);
  report(can, run);
  const auto rays = rays_of(scan.rig.reference().model);
  Reconstruction out;
  out.cameras = scan.rig.cameras.size();

  // Frames -> phase -> range, view by view. Phase noise: phase/wrap_phase.
  DecodeOptions decode = options.decode;
  decode.colors = options.colors;
  MeasuredViews measured =
      measure_views(scan, rays, decode, options.mixed_pixels, run, options.decoded);
  release_cached_pixels();
  if (can.removes_background) out.background = leave_out_background(measured, scan.rig, run);
  out.views = measured.stations.size();
  out.view_summaries = std::move(measured.summaries);
  out.agreements = agreements_of(measured, scan.rig);
  const std::vector<FringesOfViews> fringes = std::move(measured.fringes);
  const LitScan lit{scan, rays, plan, fringes};

  // Fringe orders from the other views, and registration, setup by setup.
  run.stage("views");
  for (const std::string& correction : measured.corrections)
    run.note(correction);
  std::optional<ScanTargets> targets = targets_of(scan, measured, options, run);
  std::vector<MeasuredSetup> setups = split_setups(std::move(measured));
  FringeOrderCorrectionOptions correction = options.fringe_order_correction;
  correction.mixed_pixels = options.mixed_pixels;
  std::set<std::string> outliers;
  EarlyIndirectLight indirect_light{.found = false};
  std::size_t unresolved = 0;
  HeldMessages held;
  held.during(run, [&](const Run& attempt) {
    for (MeasuredSetup& setup : setups) {
      unresolved += resolve_fringe_orders(setup.measured, scan.rig, rays, correction, attempt);
      EarlyIndirectLight early =
          register_setup(setup, lit, can, options, targets, out.turntable_top_height_mm, attempt);
      indirect_light.found = indirect_light.found || early.found;
      indirect_light.corrected = indirect_light.corrected || early.corrected;
      indirect_light.corrects = indirect_light.corrects && early.corrects;
      out.points += setup.measured.points;
      add_outliers(outliers, setup);
      // What all views together light is known where these are all.
      if (setups.size() > 1 || !outliers.empty()) continue;
      indirect_light.part = std::move(early.part);
      indirect_light.poses = std::move(early.poses);
    }
  });
  if (angles == ScanAngles::Stated && is_absolute(plan)) {
    std::optional<ScanWithAngles> found = with_found_angles(scan, setups);
    if (!found && may_hide_angles(setups))
      found = angles_without_other_views(lit, can, decode, options, targets, run);
    if (found) {
      run.warn(found->explanation.text + "; " + found->explanation.remedy);
      out = reconstruct_by(ScanAngles::Found, found->scan, options, run);
      if (out.registration && out.registration->explanation.best == PoseCause::AsStated)
        out.registration->explanation = std::move(found->explanation);
      return out;
    }
  }
  const bool is_relative = !is_absolute(plan) && withdraw_explanations(setups);
  if (!is_relative) held.pass_on(run);  // otherwise consequences
  if (out.points == 0) {
    throw Error(unresolved > 0 ? ErrorKind::Input : ErrorKind::Numeric,
                explain_no_surface(scan, rays, options.decode, {0, unresolved}, run));
  }

  const bool wrong_rig = std::any_of(setups.begin(), setups.end(), [](const MeasuredSetup& setup) {
    return blames_rig(setup.registration);
  });
  if (options.explain_rig && wrong_rig) {
    run.note(
        "the rig is refined by the surfaces of the views, because they say that it is not what "
        "rig.toml states");
    return reconstruct_with_refined_rig(scan, options, run);
  }

  // All setups in the frame of the first one, then one surface, then the finished mesh.
  HeldMessages of_relative;  // they are given up
  RegisteredViews registered{register_together(std::move(setups),
                                               scan,
                                               options,
                                               targets,
                                               std::move(outliers),
                                               out,
                                               is_relative ? of_relative.in_place_of(run) : run),
                             indirect_light};
  std::vector<Target> stickers;
  if (targets) {
    stickers = registered_targets(*targets, registered.joined);
    out.targets = report_targets(stickers, *targets, registered.joined, out.view_summaries, run);
    out.targets->masked =
        mask_targets(stickers, targets->set, registered.joined.measured, scan.rig);
    run.note(out.targets->text());
  }
  FusedSurface fused = fuse_registered(registered, lit, can, options, out, run);
  if (options.fill_targets)
    out.targets->filled = fill_targets(stickers, targets->set, fused.mesh, run);
  FinishedMesh finished = finish_mesh(std::move(fused.mesh), options.finish, run);
  out.mesh = std::move(finished.mesh);
  out.islands = finished.removed;
  if (out.mesh.triangles.empty()) {
    throw Error(ErrorKind::Input,
                explain_no_surface(scan, rays, options.decode, {out.points, unresolved}, run));
  }
  out.silhouettes = silhouettes_of(scan, registered.joined.measured, out.mesh, run);
  if (out.targets && out.targets->scale) apply_scale(out, out.targets->scale->factor);
  out.untrusted_reason = with_undecided(untrusted_reason_of(out, is_relative), out.background, run);
  if (!out.untrusted_reason.empty()) discard_sigma(out.mesh);
  out.sigma = median_sigma(out.mesh);
  return out;
}

}  // namespace

Reconstruction reconstruct(const Scan& scan, const ReconstructOptions& options, const Run& run) {
  return reconstruct_by(ScanAngles::Stated, scan, options, without_repeated_warnings(run));
}

}  // namespace frangia
