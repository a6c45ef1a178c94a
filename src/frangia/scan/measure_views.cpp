#include "frangia/scan/measure_views.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/missing.h"
#include "frangia/range/find_rim.h"
#include "frangia/range/triangulate.h"
#include "frangia/scan/survey_scan.h"

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

/// What the frames of one view say, in mm.
struct MeasuredView {
  RangeGrid range;
  std::vector<RangePixel> rim;
  DecodedView decoded;
  std::size_t points = 0;
};

/// What all views are measured with.
struct Measuring {
  const Scan& scan;
  const Image<Eigen::Vector2f>& rays;
  DecodeOptions decode;
  const EdgeOptions& edges;
};

MeasuredView measure_view(const Measuring& with, std::size_t view, const Run& run) {
  const auto& [scan, rays, decode, edges] = with;
  run.stage("frames");
  const auto frames = read_frames(scan, view, run);
  run.stage("phase");
  MeasuredView out;
  out.decoded = decode_view(frames, scan.rig, rays, decode, run);
  tell_verdicts(scan, view, out.decoded.verdicts, run);
  run.stage("range");
  out.range = triangulate(out.decoded.phase, scan.rig, rays);
  const auto dropped = drop_mixed_edges(out.range, rays, out.decoded.phase.fate, edges);
  out.rim = find_rim(out.range, rays, dropped, {.max_incidence_deg = edges.max_incidence_deg});
  out.points = count_points(out.range);
  return out;
}

}  // namespace

MeasuredViews measure_views(const Scan& scan,
                            const Image<Eigen::Vector2f>& rays,
                            const DecodeOptions& decode,
                            const EdgeOptions& edges,
                            const Run& run) {
  MeasuredViews all;
  run.stage("survey");
  Measuring with{scan, rays, decode, edges};
  with.decode.survey = survey_scan(scan, run);
  with.decode.keep_maps = false;
  for (std::size_t i = 0; i < scan.views.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(scan.views.size()));
    MeasuredView one = measure_view(with, i, run);
    if (one.points == 0 && one.decoded.loose.empty()) {
      run.warn(why_empty(scan, i, one.decoded.phase.fate));
      continue;
    }
    for (LooseRegion& region : one.decoded.loose)
      all.loose.push_back({all.views.size(), std::move(region)});
    all.coarsest = one.decoded.coarsest;
    all.unwrapped_in_space = one.decoded.relative.has_value();
    all.stops.push_back({scan.views[i].angle_rad, scan.views[i].folder.string(), 0});
    all.rounds.push_back(scan.views[i].round);
    all.views.add({std::move(one.range),
                   scan.rig.rig_from_object(scan.views[i].angle_rad),
                   std::move(one.rim)});
    all.points += one.points;
  }
  return all;
}

}  // namespace frangia
