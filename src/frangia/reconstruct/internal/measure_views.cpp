#include "frangia/reconstruct/internal/measure_views.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/statistics.h"
#include "frangia/dataset/capture_times.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/decode/check_view.h"
#include "frangia/decode/fuse_view_cameras.h"
#include "frangia/decode/survey_scan.h"
#include "frangia/decode/view_decoder.h"
#include "frangia/decode/view_quality.h"

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
                        const DecodedView& decoded,
                        const Run& run) {
  for (const FrameAssessment& assessment : assessments_of_used(decoded)) {
    const std::string folder = scan.views[view].folder.string();
    const bool varies = differs_between_frames(assessment);
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

/// Collects what the views say about scan.toml, and ends a scan of which no view fits it.
class ScanFit {
 public:
  ScanFit(const Scan& scan, const Run& run) : scan_(scan), run_(run) {}

  /// Warns if something in the view does not fit.
  void add(std::size_t view, const ViewFit& fit) {
    const std::string folder = scan_.views[view].folder.string();
    if (fit.accepted) {
      run_.warn(fmt::format(
          "{}: {}; triangulated because `accept_inconsistent` is set", folder, fit.reason));
      return;
    }
    if (fit.fits()) {
      fitting_ = fitting_ || fit.decided;
      if (!fit.reason.empty())
        run_.warn(fmt::format("{}: {}; this direction is not used", folder, fit.reason));
      return;
    }
    if (first_reason_.empty()) first_reason_ = fit.reason;
    run_.warn(fmt::format("{}: {}; the view is left out", folder, fit.reason));
    ++unfit_;
    constexpr std::size_t kEnough = 3;
    if (unfit_ == kEnough && !fitting_) end();
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

/// A camera of the rig, in whose frame its views are decoded.
struct CameraScan {
  Scan scan;
  Image<Eigen::Vector2f> own_rays;  ///< empty for the reference camera
  const Image<Eigen::Vector2f>& rays;
  DecodeOptions options;
  ScanFit fit;
  std::unique_ptr<ViewDecoder> decoder;

  CameraScan(const Scan& all,
             std::size_t camera,
             const Image<Eigen::Vector2f>& reference_rays,
             const DecodeOptions& decode,
             const Run& run)
      : scan(scan_of_camera(all, camera)),
        own_rays(camera == 0 ? Image<Eigen::Vector2f>() : rays_of(scan.rig.reference().model)),
        rays(camera == 0 ? reference_rays : own_rays),
        options(decode),
        fit(scan, run) {
    options.survey = survey_scan(scan, run);
    options.keep_maps = false;
  }
};

std::vector<std::unique_ptr<CameraScan>> survey_cameras(const Scan& scan,
                                                        const Image<Eigen::Vector2f>& rays,
                                                        const DecodeOptions& decode,
                                                        const Run& run) {
  std::vector<std::unique_ptr<CameraScan>> cameras;
  for (std::size_t i = 0; i < scan.rig.cameras.size(); ++i)
    cameras.push_back(std::make_unique<CameraScan>(scan, i, rays, decode, run));
  return cameras;
}

/// Why some pixels of a view are left out although its phase is used; empty if none are.
std::string partial_finding(const DecodedCamera& camera) {
  for (const std::size_t used : camera.fit.used) {
    const std::optional<SequenceCheck>& check = camera.decoded.directions[used].check;
    if (check && check->consistent && !check->finding.empty()) return check->finding;
  }
  return {};
}

/// Decodes a view of a camera and decides which of its phases are used.
DecodedCamera decode_camera(CameraScan& camera, std::size_t view, const Run& run) {
  DecodedCamera out{camera.scan.rig, camera.rays, camera.decoder->next()};
  report_assessments(camera.scan, view, out.decoded, run);
  out.fit =
      check_view(out.decoded, camera.scan.rig, camera.rays, camera.options.accept_inconsistent);
  camera.fit.add(view, out.fit);
  return out;
}

std::size_t count_points(const MeasuredView& measured) {
  std::size_t points = 0;
  for (const MeasuredCamera& camera : measured.cameras)
    points += count_points(camera.range);
  return points;
}

/// What the fringes of a direction show at about 2500 of the pixels that have a point: every pixel,
/// or every few pixels, of the thinned maps.
std::vector<ShownFringes> shown_fringes(const DecodedDirection& direction,
                                        const Image<float>& depth_mm) {
  constexpr double kSamples = 2500.0;
  const std::vector<WrappedPhase>& maps = direction.thinned;
  if (maps.empty()) return {};
  const Image<float>& grid = maps.front().phase_rad;
  std::vector<Eigen::Vector2i> with_point;
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      if (!std::isnan(depth_mm(x * direction.thinning_px, y * direction.thinning_px)))
        with_point.emplace_back(x, y);
    }
  }
  const int every =
      std::max(1, static_cast<int>(std::sqrt(static_cast<double>(with_point.size()) / kSamples)));
  std::vector<ShownFringes> out;
  for (const Eigen::Vector2i& at : with_point) {
    if (at.x() % every != 0 || at.y() % every != 0) continue;
    ShownFringes shown{direction.thinning_px * at.x(), direction.thinning_px * at.y(), {}};
    const float absolute_rad = direction.phase.phase_rad(shown.x, shown.y);
    if (std::isnan(absolute_rad)) continue;
    for (const WrappedPhase& map : maps) {
      const float modulation = map.modulation_counts(at.x(), at.y());
      const float phase_rad = map.phase_rad(at.x(), at.y());
      if (std::isnan(phase_rad) || !(modulation > 0.0F)) break;
      const double ratio =
          map.pattern.fringes_per_unit() / direction.phase.pattern.fringes_per_unit();
      shown.measured.push_back({map.mean_counts(at.x(), at.y()) / modulation,
                                1.0F / modulation,
                                map.sigma_rad(at.x(), at.y()),
                                static_cast<float>(phase_rad - ratio * absolute_rad)});
    }
    if (shown.measured.size() == maps.size()) out.push_back(std::move(shown));
  }
  return out;
}

bool is_any_measured(const AbsolutePhase& phase) {
  const std::span<const float> pixels = phase.phase_rad.pixels();
  return std::any_of(pixels.begin(), pixels.end(), [](float rad) { return !std::isnan(rad); });
}

/// A number that differs between images unless they are equal to the last bit.
std::size_t fingerprint(const Image<float>& image) {
  const std::span<const float> pixels = image.pixels();
  return std::hash<std::string_view>{}(
      {reinterpret_cast<const char*>(pixels.data()),  // NOLINT(*-reinterpret-cast)
       pixels.size_bytes()});
}

}  // namespace

MeasuredViews measure_views(const Scan& scan,
                            const Image<Eigen::Vector2f>& rays,
                            const DecodeOptions& decode,
                            const MixedPixelOptions& mixed_pixels,
                            const Run& run,
                            const std::shared_ptr<const DecodedViews>& known) {
  run.stage("survey");
  const auto cameras = survey_cameras(scan, rays, decode, run);
  run.stage("range");
  for (const auto& camera : cameras) {
    camera->decoder =
        std::make_unique<ViewDecoder>(camera->scan, camera->rays, camera->options, run, known);
  }
  const std::vector<double> times_s = read_capture_times(scan);
  std::map<std::size_t, std::string> names;  // of the views, by the fingerprint of their phase
  MeasuredViews all;
  all.cameras.resize(cameras.size());
  all.fringes.assign(cameras.size(), FringesOfViews(scan.views.size()));
  for (std::size_t i = 0; i < scan.views.size(); ++i) {
    run.report(static_cast<double>(i) / static_cast<double>(scan.views.size()));
    std::vector<DecodedCamera> decoded;
    for (const auto& camera : cameras)
      decoded.push_back(decode_camera(*camera, i, run));
    ViewSummary summary{
        scan.views[i].folder.string(), scan.views[i].angle_rad, scan.views[i].setup};
    const ViewFit& fit = decoded.front().fit;
    const auto assessments = assessments_of(decoded.front().decoded);
    summary.quality = view_quality(assessments);
    if (i == 0) all.corrections = corrections_of(decoded.front().decoded);
    if (!fit.fits()) {
      summary.left_out = true;
      summary.reason = fit.reason;
      all.summaries.push_back(summary);
      continue;
    }
    summary.reason = partial_finding(decoded.front());
    DecodedDirection& leading = decoded.front().decoded.directions[fit.leading()];
    all.coarsest = leading.coarsest;
    if (is_any_measured(leading.phase)) {  // views that show nothing are alike
      const auto [earlier, is_new] =
          names.try_emplace(fingerprint(leading.phase.phase_rad), summary.name);
      if (!is_new) summary.same_as = earlier->second;
    }
    MeasuredView measured =
        fuse_view_cameras(scan.rig, decoded, decode.directions, mixed_pixels, run);
    if (measured.directions.pixels > 0) {
      all.first = leading.phase.pattern;
      all.second = decoded.front().decoded.directions[fit.used.back()].phase.pattern;
      all.direction_agreements.push_back(std::move(measured.directions));
    }
    if (measured.between_cameras.pixels > 0)
      all.camera_agreements.push_back(std::move(measured.between_cameras));
    summary.points = count_points(measured);
    summary.sigma_mm = median_sigma_mm(measured.cameras.front().range);
    summary.left_out = summary.points == 0 && leading.unresolved.empty();
    if (summary.left_out) {
      summary.reason = why_empty(scan, i, leading.phase.status);
      run.warn(summary.reason);
      all.summaries.push_back(summary);
      continue;
    }
    all.summaries.push_back(summary);
    for (UnresolvedRegion& region : leading.unresolved)
      all.unresolved.push_back({all.reference().size(), std::move(region)});
    all.unwrapped_spatially = leading.relative.has_value();
    all.stations.push_back({scan.views[i].angle_rad, scan.views[i].folder.string(), 0, times_s[i]});
    all.setups.push_back(scan.views[i].setup);
    const Eigen::Isometry3d rig_from_object = scan.rig.rig_from_object(scan.views[i].angle_rad);
    for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
      MeasuredCamera& seen = measured.cameras[camera];
      for (const DecodedDirection& direction : decoded[camera].decoded.directions) {
        if (direction.coarsest.direction == all.coarsest.direction)
          all.fringes[camera][i] = shown_fringes(direction, seen.range.depth_mm);
      }
      all.cameras[camera].add({std::move(seen.range),
                               scan.rig.cameras[camera].camera_from_rig() * rig_from_object,
                               std::move(seen.edge_pixels),
                               std::move(decoded[camera].decoded.color)});
    }
    all.points += summary.points;
  }
  for (const auto& camera : cameras)
    camera->fit.finish();
  return all;
}

TurntableStations stations_of(const Rig& rig, const MeasuredViews& measured) {
  TurntableStations given{*rig.turntable, measured.stations};
  if (rig.cameras.size() > 1 || rig.projector.is_label) return given;
  given.rig = &rig;
  given.pattern = &measured.coarsest;
  return given;
}

}  // namespace frangia
