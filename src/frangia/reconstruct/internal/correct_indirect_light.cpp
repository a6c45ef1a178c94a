#include "frangia/reconstruct/internal/correct_indirect_light.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/error.h"
#include "frangia/core/image.h"
#include "frangia/core/median.h"
#include "frangia/core/missing.h"
#include "frangia/indirect_light/extrapolate_faces.h"
#include "frangia/reconstruct/internal/indirect_part.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/subsample.h"

namespace frangia {
namespace {

/// Median of the values that are not missing; NaN without any.
float median_of_known(const Image<float>& values) {
  std::vector<float> known;
  for (const float value : values.pixels())
    if (!std::isnan(value)) known.push_back(value);
  return known.empty() ? kMissing : median_in_place(std::span(known));
}

/// Replaces the points of a view that indirect light shifts.
void continue_faces(View& view,
                    const Image<float>& largest_shifts_mm,
                    const Image<Eigen::Vector2f>& rays) {
  const auto shifted = [](float shift) { return shift > 0.0F; };
  if (std::none_of(largest_shifts_mm.pixels().begin(), largest_shifts_mm.pixels().end(), shifted))
    return;
  const float sigma_mm = median_of_known(view.range.sigma_mm);
  const Image<float> depth_mm = extrapolate_faces(view.range, largest_shifts_mm, rays);
  for (int y = 0; y < depth_mm.height(); ++y) {
    for (int x = 0; x < depth_mm.width(); ++x) {
      if (std::isnan(depth_mm(x, y)) || depth_mm(x, y) == view.range.depth_mm(x, y)) continue;
      view.range.depth_mm(x, y) = depth_mm(x, y);
      view.range.sigma_mm(x, y) = sigma_mm;
    }
  }
}

/// Fuses the views with the points that indirect light shifts replaced by the faces around them
/// (`extrapolate_faces`). This surface predicts indirect light, and nothing else: near a crease the
/// measured one is shifted by millimetres or missing, so that its own prediction is wrong there.
///
/// @errors   as fuse_views
Mesh continued_surface(const MeasuredViews& measured,
                       const IndirectPart& indirect,
                       const CameraModel& camera,
                       const Image<Eigen::Vector2f>& rays,
                       const FusionOptions& fusion,
                       const Run& run) {
  ViewStore continued;
  for (std::size_t i = 0; i < measured.reference().size(); ++i) {
    run.check();
    View view = measured.reference().load_points(i);
    continue_faces(view, indirect.largest_shifts_mm(view), rays);
    continued.add(view);
  }
  Run quiet;
  quiet.stop = run.stop;
  return fuse_views(continued, camera, fusion, quiet);
}

/// Options for a surface of one and a half pixels between samples, as fine as a crease needs,
/// without systematic parts.
FusionOptions coarse_fusion(const MeasuredViews& measured,
                            const Image<Eigen::Vector2f>& rays,
                            FusionOptions options) {
  constexpr double kVoxel_px = 1.5;
  const auto px = static_cast<double>((rays(1, 0) - rays(0, 0)).norm());
  for (std::size_t i = 0; i < measured.reference().size(); ++i) {
    const float depth_mm = median_of_known(measured.reference().load_depth_mm(i));
    if (std::isnan(depth_mm)) continue;
    options.voxel_mm = kVoxel_px * px * static_cast<double>(depth_mm);
    break;
  }
  options.terms.clear();
  return options;
}

/// Two directions of fringes determine a point together.
ShiftedPoints shifted_points(const DecodePlan& plan) {
  return plan.directions.size() == 1 ? ShiftedPoints::Moved : ShiftedPoints::Kept;
}

/// What a prediction is made from, beside the surface.
struct Lighting {
  const ScanDecoding& decoding;
  ShiftedPoints points = ShiftedPoints::Moved;
  ShownFringes& shown;
};

std::optional<IndirectPart> part_of(const MeasuredViews& measured,
                                    const Mesh& surface,
                                    const Lighting& lighting,
                                    const Run& run) {
  return indirect_part(lighting.decoding,
                       lit_views(measured, lighting.decoding.scan),
                       surface,
                       lighting.points,
                       lighting.shown,
                       run);
}

/// What a correction did to all views.
struct Corrected {
  double moved = 0.0;  ///< share of the points that moved by more than a tenth of their sigma
  double roughness_before = 0.0;
  double roughness_after = 0.0;

  [[nodiscard]] bool is_rougher() const {
    constexpr double kSame = 1.02;  // of a sum over thousands of points
    return roughness_after > kSame * roughness_before;
  }
};

/// Adds how a correction changed a view: the second differences of the points that it moved, over
/// a few pixels, each up to ten times its noise.
void compare(const RangeGrid& before, const RangeGrid& after, Corrected& out, double& points) {
  constexpr float kMoves = 0.1F;  // of sigma
  constexpr int kReach = 4;       // px
  constexpr double kMost = 100.0;
  for (int y = 0; y < before.depth_mm.height(); ++y) {
    for (int x = kReach; x + kReach < before.depth_mm.width(); ++x) {
      const float sigma = before.sigma_mm(x, y);
      if (std::isnan(before.depth_mm(x, y)) || std::isnan(after.depth_mm(x, y))) continue;
      points += 1.0;
      if (std::abs(after.depth_mm(x, y) - before.depth_mm(x, y)) < kMoves * sigma) continue;
      out.moved += 1.0;
      const auto bend = [&](const Image<float>& depth) {
        return static_cast<double>(
            (depth(x - kReach, y) - 2.0F * depth(x, y) + depth(x + kReach, y)) / sigma);
      };
      const double was = bend(before.depth_mm);
      const double is = bend(after.depth_mm);
      if (std::isnan(was) || std::isnan(is)) continue;
      out.roughness_before += std::min(was * was, kMost);
      out.roughness_after += std::min(is * is, kMost);
    }
  }
}

/// Copies of the views as they were before a correction.
ViewStore copy_of(const ViewStore& views) {
  ViewStore copy;
  for (std::size_t i = 0; i < views.size(); ++i)
    copy.add(views.load(i));
  return copy;
}

/// Corrects all views; `measured_views` are those to compare with.
Corrected correct_all(MeasuredViews& measured,
                      const ViewStore& measured_views,
                      const IndirectPart& indirect,
                      const Run& run) {
  Corrected out;
  double points = 0.0;
  for (std::size_t i = 0; i < measured.reference().size(); ++i) {
    run.check();
    View view = measured.reference().load(i);
    indirect.correct(view);
    measured.reference().replace(i, view);
    compare(measured_views.load_points(i).range, view.range, out, points);
  }
  out.moved /= std::max(1.0, points);
  return out;
}

/// The surface that `make` fuses; empty where the views have too few points for one, which then
/// says nothing about indirect light.
template <typename Make>
Mesh surface_or_none(const Make& make) {
  try {
    return make();
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::Cancelled) throw;
    return {};
  }
}

/// Every how many pixels a surface still shows whether there is indirect light.
int thinning_px(const MeasuredViews& measured) {
  constexpr double kPoints = 100'000.0;  // of a view: with fewer, narrow grooves would be lost
  constexpr int kMost_px = 4;            // 1.5 pixels to a voxel of the first pass, as in others
  const auto views = static_cast<double>(std::max<std::size_t>(1, measured.reference().size()));
  const double points = static_cast<double>(measured.points) / views;
  return std::clamp(static_cast<int>(std::sqrt(points / kPoints)), 1, kMost_px);
}

/// Whether the views show indirect light, as a surface of every few pixels predicts it. Most scans
/// show none, which this finds out at a fraction of the cost of a first pass.
bool shows_indirect_light(const MeasuredViews& measured,
                          int step_px,
                          const Lighting& lighting,
                          const FusionOptions& fusion,
                          const Run& run) {
  const CameraModel camera = subsample(lighting.decoding.scan.rig.reference().model, step_px);
  ViewStore thinned;
  for (std::size_t i = 0; i < measured.reference().size(); ++i) {
    run.check();
    thinned.add(subsample(measured.reference().load_points(i), step_px));
  }
  const Mesh surface = surface_or_none([&] { return fuse_views(thinned, camera, fusion, run); });
  return part_of(measured, surface, lighting, run).has_value();
}

/// The prediction of a surface, made better by the surface that continues its reliable faces.
std::optional<IndirectPart> predict(const MeasuredViews& measured,
                                    const Mesh& surface,
                                    const Lighting& lighting,
                                    const FusionOptions& coarse,
                                    const Run& run) {
  auto first = part_of(measured, surface, lighting, run);
  if (!first) return first;
  const ScanDecoding& decoding = lighting.decoding;
  const CameraModel& camera = decoding.scan.rig.reference().model;
  const Mesh continued = surface_or_none(
      [&] { return continued_surface(measured, *first, camera, decoding.rays, coarse, run); });
  auto second = part_of(measured, continued, lighting, run);
  // The frames decide which surface predicts what they show; alike, the one without gaps.
  constexpr double kAlike = 1.1;
  const bool better = second && second->unexplained < kAlike * first->unexplained;
  return better ? second : first;
}

}  // namespace

EarlyIndirectLight correct_before_registration(MeasuredViews& measured,
                                               const ScanDecoding& decoding,
                                               FusionOptions coarse,
                                               const Run& run) {
  constexpr int kPasses = 2;
  if (measured.points == 0) return {.found = false};
  coarse = coarse_fusion(measured, decoding.rays, std::move(coarse));
  const CameraModel& camera = decoding.scan.rig.reference().model;
  Run quiet;
  quiet.stop = run.stop;
  // A coarser surface is smoother where indirect light has torn the points apart.
  FusionOptions first = coarse;
  first.voxel_mm *= 4.0;
  const int step_px = thinning_px(measured);
  ShownFringes shown;
  const Lighting lighting{decoding, shifted_points(decoding.plan), shown};
  if (step_px > 1 && !shows_indirect_light(measured, step_px, lighting, first, quiet))
    return {.found = false};
  ViewStore as_measured;
  for (int pass = 0; pass < kPasses; ++pass) {
    const FusionOptions& fusion = pass == 0 ? first : coarse;
    const Mesh surface =
        surface_or_none([&] { return fuse_views(measured.reference(), camera, fusion, quiet); });
    const auto indirect = predict(measured, surface, lighting, coarse, quiet);
    if (!indirect) return {.found = pass > 0};
    if (pass == 0) as_measured = copy_of(measured.reference());
    if (correct_all(measured, as_measured, *indirect, run).is_rougher()) {
      measured.reference() = std::move(as_measured);
      return {.found = true, .corrects = false};
    }
  }
  return {};
}

std::optional<IndirectLightReport> correct_indirect_light(FusedSurface& fused,
                                                          MeasuredViews& measured,
                                                          const ScanDecoding& decoding,
                                                          const EarlyIndirectLight& before,
                                                          FusionOptions& fusion,
                                                          const Run& run) {
  constexpr int kPasses = 2;
  constexpr double kFew = 0.001;  // share of the points whose correction a second pass changes
  const std::vector<SigmaTerm> others = fusion.terms;
  ShownFringes shown;
  Lighting lighting{
      decoding, before.corrects ? shifted_points(decoding.plan) : ShiftedPoints::Kept, shown};
  std::optional<IndirectLightReport> report;
  ViewStore uncorrected;  // but for the correction before the registration
  for (int pass = 0; pass < kPasses; ++pass) {
    const FusionOptions coarse = coarse_fusion(measured, decoding.rays, fusion);
    auto indirect = predict(measured, fused.mesh, lighting, coarse, run);
    if (!indirect) break;
    double moved = 0.0;
    if (lighting.points == ShiftedPoints::Moved) {
      if (pass == 0) uncorrected = copy_of(measured.reference());
      const Corrected done = correct_all(measured, uncorrected, *indirect, run);
      moved = done.moved;
      if (done.is_rougher()) {
        measured.reference() = std::move(uncorrected);
        lighting.points = ShiftedPoints::Kept;
        indirect = part_of(measured, fused.mesh, lighting, run);
        moved = 0.0;
      }
    }
    fusion.terms = others;
    report.reset();
    if (indirect) {
      report = indirect->report;
      fusion.terms.push_back(
          {UncertaintyTerm::IndirectLight,
           [part = indirect->systematic_mm](const View& view, std::size_t /*camera*/) {
             return part(view);
           }});
    }
    const CameraViews one{measured.reference(), decoding.scan.rig.reference().model};
    fused = fuse_with_weights({&one, 1}, fusion, run);
    if (!indirect || moved < kFew) break;
  }
  if (!report) return report;
  report->corrected = lighting.points == ShiftedPoints::Moved;
  announce(*report, run);
  return report;
}

}  // namespace frangia
