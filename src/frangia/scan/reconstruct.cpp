#include "frangia/scan/reconstruct.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/missing.h"
#include "frangia/range/triangulate.h"
#include "frangia/views/clip_views.h"
#include "frangia/views/view_store.h"

namespace frangia {
namespace {

std::size_t count_points(const RangeGrid& range) {
  const auto depth = range.depth_mm.pixels();
  return static_cast<std::size_t>(
      std::count_if(depth.begin(), depth.end(), [](float z) { return !std::isnan(z); }));
}

double share(const Image<PixelFate>& fate, PixelFate which) {
  const auto count = std::count(fate.pixels().begin(), fate.pixels().end(), which);
  return 100.0 * static_cast<double>(count) / static_cast<double>(fate.pixels().size());
}

std::string why_empty(const Scan& scan, std::size_t view, const Image<PixelFate>& fate) {
  return fmt::format(
      "{}: no point was measured, and the view is left out: {:.1f} % of its pixels are unmodulated "
      "and {:.1f} % saturated; check light and exposure",
      (scan.folder / scan.views[view].folder).string(),
      share(fate, PixelFate::Unmodulated),
      share(fate, PixelFate::Saturated));
}

/// The first view's verdicts stand for all; of the others only what is suspect is worth a sentence.
void tell_verdicts(const Scan& scan,
                   std::size_t view,
                   const std::vector<FrameVerdict>& verdicts,
                   const Run& run) {
  for (const FrameVerdict& verdict : verdicts) {
    const std::string folder = scan.views[view].folder.string();
    if (verdict.vibration_suspected) {
      run.warn(fmt::format("{}: {}", folder, in_words(verdict)));
    } else if (view == 0) {
      run.note(fmt::format("{}: {}", folder, in_words(verdict)));
    }
  }
}

/// Leaves out what is not the part: what the user says, and the platter.
void clip(ViewStore& views, const Lens& camera, const ReconstructOptions& options, const Run& run) {
  if (std::isinf(options.clip_below_mm) && std::isinf(options.clip_radius_mm)) return;
  Clip clip{.max_radius_mm = options.clip_radius_mm};
  clip.floor.offset() = -options.clip_below_mm;
  clip_views(views, camera, clip, run);
}

/// Leaves the platter out, and what is less than a little above it. Returns its height.
double clip_platter(ViewStore& views,
                    const Lens& camera,
                    const ReconstructOptions& options,
                    const Run& run) {
  const auto platter = find_platter(views, camera, options.platter, run);
  if (!platter) return kMissing;
  constexpr double kAbove_mm = 0.5;  // what is nearer is the platter, or mixed with it
  Clip clip;
  clip.floor = {platter->normal(), platter->offset() - kAbove_mm};
  const std::size_t dropped = clip_views(views, camera, clip, run);
  const double height_mm = -platter->offset() / platter->normal().z();
  run.note(fmt::format(
      "the platter, at a height of {:.2f} mm, is left out with {} points; --keep-platter "
      "keeps it",
      height_mm,
      dropped));
  return height_mm;
}

/// Refines the turntable by what the views saw.
void register_all(ViewStore& views,
                  const Scan& scan,
                  const std::vector<RegisteredView>& stops,
                  const ReconstructOptions& options,
                  const Run& run,
                  Reconstruction& out) {
  if (!options.register_views || !scan.rig.turntable) return;
  out.registration = register_views(
      views, scan.rig.camera.lens, *scan.rig.turntable, stops, options.registration, run);
  if (out.registration->iterations > 0) run.note(out.registration->text());
}

}  // namespace

Reconstruction reconstruct(const Scan& scan, const ReconstructOptions& options, const Run& run) {
  if (!has_absolute_phase(scan.patterns, scan.rig.projector)) {
    run.warn(
        "the scan holds neither an absolute pattern nor the plane of light: distances are relative "
        "to the fringe through the projection axis");
  }
  Reconstruction out;
  ViewStore views;
  std::vector<LoosePart> loose;
  std::vector<RegisteredView> stops;
  Pattern coarsest;
  bool unwrapped_in_space = false;
  const auto rays = rays_of(scan.rig.camera.lens);
  DecodeOptions decode = options.decode;
  decode.survey = survey_scan(scan, run);

  for (std::size_t i = 0; i < scan.views.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(scan.views.size()));
    run.stage("frames");
    const auto frames = read_frames(scan, i, run);
    run.stage("phase");
    DecodedView decoded = decode_view(frames, scan.rig, rays, decode, run);
    tell_verdicts(scan, i, decoded.verdicts, run);
    run.stage("range");
    RangeGrid range = triangulate(decoded.phase, scan.rig, rays);
    drop_mixed_edges(range, rays, decoded.phase.fate, options.edges);

    const std::size_t points = count_points(range);
    if (points == 0 && decoded.loose.empty()) {
      run.warn(why_empty(scan, i, decoded.phase.fate));
      continue;
    }
    for (LooseRegion& region : decoded.loose)
      loose.push_back({views.size(), std::move(region)});
    coarsest = decoded.wrapped.front().pattern;
    unwrapped_in_space = decoded.relative.has_value();
    stops.push_back({scan.views[i].angle_rad, scan.views[i].folder.string()});
    views.add({std::move(range), scan.rig.rig_from_object(scan.views[i].angle_rad)});
    out.points += points;
  }

  run.stage("views");
  const auto anchored =
      anchor_by_views(views, loose, coarsest, scan.rig, rays, options.anchor_by_views, run);
  out.points += anchored.anchored_points;
  if (anchored.dropped_points > 0) {
    run.warn(
        fmt::format("{} points lie in regions whose fringe neither the plane of light nor "
                    "another view tells, and are dropped",
                    anchored.dropped_points));
  }
  if (unwrapped_in_space) {
    const std::size_t moved =
        reconcile_views(views, coarsest, scan.rig, rays, options.reconcile, run);
    if (moved > 0)
      run.note(
          fmt::format("{} points moved by whole fringes to where the other views agree", moved));
  }
  out.views = views.size();
  if (out.points == 0) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: no view has a lit pixel; check light, exposure and white_level",
                            scan.folder.string()));
  }
  const Lens& camera = scan.rig.camera.lens;
  clip(views, camera, options, run);
  if (!options.keep_platter && scan.rig.turntable)
    out.platter_height_mm = clip_platter(views, camera, options, run);
  register_all(views, scan, stops, options, run, out);
  clip(views, camera, options, run);  // again, in the frame of the refined axis
  run.stage("surface");
  out.mesh = paste_views(views, scan.rig.camera.lens, options.paste, run);
  return out;
}

}  // namespace frangia
