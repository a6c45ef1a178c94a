#include "frangia/pipeline/internal/measure_views.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/median.h"
#include "frangia/pipeline/check_view.h"
#include "frangia/pipeline/internal/view_decoder.h"
#include "frangia/pipeline/survey_scan.h"
#include "frangia/pipeline/triangulate_view.h"
#include "frangia/range/recover_edge_pixels.h"

namespace frangia {
namespace {

std::size_t count_points(const RangeGrid& range) {
  const auto depth = range.depth_mm.pixels();
  return static_cast<std::size_t>(
      std::count_if(depth.begin(), depth.end(), [](float z) { return !std::isnan(z); }));
}

double share(const Image<PixelStatus>& status, PixelStatus which) {
  const auto count = std::count(status.pixels().begin(), status.pixels().end(), which);
  return 100.0 * static_cast<double>(count) / static_cast<double>(status.pixels().size());
}

std::string why_empty(const Scan& scan, std::size_t view, const Image<PixelStatus>& status) {
  return fmt::format(
      "{}: no point was measured, and the view is left out: {:.1f} % of its pixels are unmodulated "
      "or less certain than `max_sigma`, and {:.1f} % are saturated",
      (scan.folder / scan.views[view].folder).string(),
      share(status, PixelStatus::Unmodulated),
      share(status, PixelStatus::Saturated));
}

/// Reports the assessments of the first view, and of the other views only motion and flicker: the
/// harmonics are those of the first view.
void report_assessments(const Scan& scan,
                        std::size_t view,
                        const std::vector<FrameAssessment>& assessments,
                        const Run& run) {
  for (const FrameAssessment& assessment : assessments) {
    const std::string folder = scan.views[view].folder.string();
    const bool varies = assessment.vibration_suspected || assessment.flicker_error_rad > 0.0;
    if (varies || (view == 0 && needs_attention(assessment))) {
      run.warn(fmt::format("{}: {}", folder, describe(assessment)));
    } else if (view == 0) {
      run.note(fmt::format("{}: {}", folder, describe(assessment)));
    }
  }
}

/// The median sigma of the points on every 16th row; NaN without points.
double median_sigma_mm(const RangeGrid& range) {
  constexpr int kRows = 16;
  std::vector<float> sigmas_mm;
  for (int y = kRows / 2; y < range.sigma_mm.height(); y += kRows) {
    for (int x = 0; x < range.sigma_mm.width(); ++x) {
      if (!std::isnan(range.depth_mm(x, y))) sigmas_mm.push_back(range.sigma_mm(x, y));
    }
  }
  return sigmas_mm.empty() ? kMissing : static_cast<double>(median(std::move(sigmas_mm)));
}

/// One view's range grid.
struct MeasuredView {
  RangeGrid range;
  std::vector<RangePixel> edge_pixels;
  DirectionDisagreement disagreement;
  std::size_t points = 0;
};

/// Marks in `decoded.phase.status` the pixels that triangulation and the mixed-pixel filter reject.
MeasuredView measure_view(DecodedView& decoded,
                          const ViewFit& fit,
                          const Scan& scan,
                          const Image<Eigen::Vector2f>& rays,
                          const DecodeOptions& options,
                          const MixedPixelOptions& mixed_pixels) {
  MeasuredView out;
  TriangulatedView triangulated =
      triangulate_view(decoded, fit, scan.rig, rays, options.directions);
  out.range = std::move(triangulated.range);
  out.disagreement = triangulated.disagreement;
  const auto removed = remove_mixed_pixels(out.range, rays, decoded.phase.status, mixed_pixels);
  out.edge_pixels = recover_edge_pixels(
      out.range, rays, removed, {.max_incidence_deg = mixed_pixels.max_incidence_deg});
  out.points = count_points(out.range);
  return out;
}

/// Collects what the views say about scan.toml, and ends a scan of which no view fits it.
class ScanFit {
 public:
  ScanFit(const Scan& scan, const Run& run) : scan_(scan), run_(run) {}

  /// Whether the view is to be triangulated; warns if something in it does not fit.
  bool add(std::size_t view, const ViewFit& fit) {
    const std::string folder = scan_.views[view].folder.string();
    if (fit.accepted) {
      run_.warn(fmt::format(
          "{}: {}; triangulated because `accept_inconsistent` is set", folder, fit.reason));
      return true;
    }
    if (fit.fits()) {
      fitting_ = fitting_ || fit.decided;
      if (!fit.reason.empty())
        run_.warn(fmt::format("{}: {}; this direction is not used", folder, fit.reason));
      return true;
    }
    if (first_reason_.empty()) first_reason_ = fit.reason;
    run_.warn(fmt::format("{}: {}; the view is left out", folder, fit.reason));
    ++unfit_;
    constexpr std::size_t kEnough = 3;
    if (unfit_ == kEnough && !fitting_) end();
    return false;
  }
  /// Throws if views do not fit and none does.
  void finish() const {
    if (unfit_ > 0 && !fitting_) end();
    if (!fitting_) {
      run_.note(
          "nothing in the frames decides whether the patterns are those of scan.toml: a wrong "
          "start, "
          "direction or period would not be noticed");
    }
  }

 private:
  [[noreturn]] void end() const {
    throw Error(ErrorKind::Numeric,
                fmt::format("{}: {}; nothing is triangulated: correct scan.toml, or set "
                            "`accept_inconsistent`",
                            scan_.folder.string(),
                            first_reason_));
  }

  const Scan& scan_;
  const Run& run_;
  bool fitting_ = false;
  std::size_t unfit_ = 0;
  std::string first_reason_;
};

}  // namespace

MeasuredViews measure_views(const Scan& scan,
                            const Image<Eigen::Vector2f>& rays,
                            const DecodeOptions& decode,
                            const MixedPixelOptions& mixed_pixels,
                            const Run& run) {
  run.stage("survey");
  DecodeOptions decode_options = decode;
  decode_options.survey = survey_scan(scan, run);
  decode_options.keep_maps = false;
  run.stage("range");
  ViewDecoder decoder(scan, rays, decode_options, run);
  MeasuredViews all;
  ScanFit scan_fit(scan, run);
  for (std::size_t i = 0; i < scan.views.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(scan.views.size()));
    DecodedView decoded = decoder.next();
    report_assessments(scan, i, decoded.assessments, run);
    const ViewFit fit = check_view(decoded, scan.rig, rays, decode.accept_inconsistent);
    if (!scan_fit.add(i, fit)) {
      all.summaries.push_back({scan.views[i].folder.string(),
                               scan.views[i].angle_rad,
                               scan.views[i].setup,
                               0,
                               kMissing,
                               true});
      continue;
    }
    MeasuredView measured = measure_view(decoded, fit, scan, rays, decode_options, mixed_pixels);
    if (measured.disagreement.pixels > 0) {
      all.disagreements_mm.push_back(static_cast<float>(measured.disagreement.median_mm));
      all.disagreements_over_sigma.push_back(
          static_cast<float>(measured.disagreement.median_over_sigma));
    }
    all.summaries.push_back({scan.views[i].folder.string(),
                             scan.views[i].angle_rad,
                             scan.views[i].setup,
                             measured.points,
                             median_sigma_mm(measured.range),
                             measured.points == 0 && decoded.unresolved.empty()});
    if (measured.points == 0 && decoded.unresolved.empty()) {
      run.warn(why_empty(scan, i, decoded.phase.status));
      continue;
    }
    for (UnresolvedRegion& region : decoded.unresolved)
      all.unresolved.push_back({all.views.size(), std::move(region)});
    all.coarsest = fit.uses_first ? decoded.coarsest : decoded.phase.pattern;
    all.unwrapped_spatially = decoded.relative.has_value();
    all.stations.push_back({scan.views[i].angle_rad, scan.views[i].folder.string(), 0});
    all.setups.push_back(scan.views[i].setup);
    all.views.add({std::move(measured.range),
                   scan.rig.rig_from_object(scan.views[i].angle_rad),
                   std::move(measured.edge_pixels),
                   std::move(decoded.color)});
    all.points += measured.points;
  }
  scan_fit.finish();
  return all;
}

}  // namespace frangia
