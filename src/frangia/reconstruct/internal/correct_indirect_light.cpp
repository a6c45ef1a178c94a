#include "frangia/reconstruct/internal/correct_indirect_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/error.h"
#include "frangia/core/image.h"
#include "frangia/core/missing.h"
#include "frangia/core/statistics.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/indirect_light/extrapolate_faces.h"
#include "frangia/indirect_light/surface_light.h"
#include "frangia/reconstruct/internal/indirect_part.h"
#include "frangia/rig/camera_model.h"

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
Mesh continued_surface(const ThinnedViews& thinned,
                       const IndirectCorrection& correction,
                       const FusionOptions& fusion,
                       const Run& run) {
  ViewStore continued;
  for (std::size_t i = 0; i < thinned.views.size(); ++i) {
    run.check();
    View view = thinned.views.load_points(i);
    continue_faces(view, correction.largest_shifts_mm(view, thinned.rays), thinned.rays);
    continued.add(view);
  }
  return fuse_views(continued, thinned.camera, fusion, run);
}

/// Two directions of fringes determine a point together.
ShiftedPoints shifted_points(const DecodePlan& plan) {
  return plan.directions.size() == 1 ? ShiftedPoints::Moved : ShiftedPoints::Kept;
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

/// Corrects all views, of which `before` are copies.
Corrected correct_all(ViewStore& views,
                      const ViewStore& before,
                      const Image<Eigen::Vector2f>& rays,
                      const IndirectPart& indirect,
                      const Run& run) {
  const IndirectCorrection correction = indirect.correction(ShiftedPoints::Moved);
  Corrected out;
  double points = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    run.check();
    View view = views.load(i);
    correction.correct(view, rays);
    views.replace(i, view);
    compare(before.load_points(i).range, view.range, out, points);
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

/// How coarse surfaces are, pixels of the camera. The first is smoother where indirect light has
/// torn the points apart; the others show creases.
constexpr double kFirstVoxel_px = 6.0;
constexpr double kFirstVoxel_thinned_px = 2.0;
constexpr double kVoxel_px = 1.5;

/// Whether the views show indirect light, as a surface of every few pixels predicts it. Most scans
/// show none, which this finds out at a fraction of the cost of a prediction.
bool shows_indirect_light(const MeasuredViews& measured,
                          const LitScan& lit,
                          const FusionOptions& fusion,
                          const Run& run) {
  const ThinnedViews thinned(
      measured, 0, lit.scan.rig.reference().model, thinning_px(measured), run);
  const FusionOptions coarse = thinned.coarse_fusion(
      std::max(kFirstVoxel_px, kFirstVoxel_thinned_px * thinned.step_px), fusion);
  const Mesh surface =
      surface_or_none([&] { return fuse_views(thinned.views, thinned.camera, coarse, run); });
  return may_light_itself(lit_views(thinned, lit, lit.scan.rig.projector), surface, run);
}

/// The prediction of the surface of some views, made better by the surface that continues its
/// reliable faces.
std::optional<IndirectPart> predict(const ThinnedViews& copies,
                                    const LitScan& lit,
                                    const FusionOptions& fusion,
                                    double voxel_px,
                                    ShiftedPoints points,
                                    const Run& run) {
  const LitViews views = lit_views(copies, lit, lit.scan.rig.projector);
  const FusionOptions coarse = copies.coarse_fusion(voxel_px, fusion);
  const FusionOptions fine = copies.coarse_fusion(kVoxel_px, fusion);
  const Mesh surface =
      surface_or_none([&] { return fuse_views(copies.views, copies.camera, coarse, run); });
  auto first = indirect_part(views, surface, run);
  if (!first) return first;
  const Mesh continued = surface_or_none(
      [&] { return continued_surface(copies, first->correction(points), fine, run); });
  auto second = indirect_part(views, continued, run);
  // The frames decide which surface predicts what they show; alike, the one without gaps.
  constexpr double kAlike = 1.1;
  const bool better = second && second->unexplained < kAlike * first->unexplained;
  return better ? second : first;
}

/// The prediction for views that were not corrected: of a smooth surface, then of the surface of
/// copies of the views that this corrects.
std::optional<IndirectPart> predict_for_measured(const MeasuredViews& measured,
                                                 const LitScan& lit,
                                                 const FusionOptions& fusion,
                                                 ShiftedPoints points,
                                                 const Run& run) {
  constexpr double kFew = 0.001;  // share of the points that the first correction moves
  if (!shows_indirect_light(measured, lit, fusion, run)) return std::nullopt;
  ThinnedViews copies(measured, 0, lit.scan.rig.reference().model, 1, run);
  auto first = predict(copies, lit, fusion, kFirstVoxel_px, points, run);
  if (!first || points == ShiftedPoints::Kept) return first;
  const ViewStore before = copy_of(copies.views);
  if (correct_all(copies.views, before, copies.rays, *first, run).moved < kFew) return first;
  auto second = predict(copies, lit, fusion, kVoxel_px, points, run);
  return second ? second : first;
}

/// The prediction for views that were corrected before.
std::optional<IndirectPart> predict_for_corrected(const MeasuredViews& measured,
                                                  const LitScan& lit,
                                                  const FusionOptions& fusion,
                                                  const Run& run) {
  const ThinnedViews copies(measured, 0, lit.scan.rig.reference().model, 1, run);
  return predict(copies, lit, fusion, kVoxel_px, ShiftedPoints::Moved, run);
}

/// The same without progress and messages.
Run quiet_run(const Run& run) {
  Run quiet;
  quiet.stop = run.stop;
  return quiet;
}

/// Corrects all views by a prediction; false, and nothing is changed, where that makes them
/// rougher.
bool correct_views(MeasuredViews& measured,
                   const Image<Eigen::Vector2f>& rays,
                   const IndirectPart& indirect,
                   const Run& run) {
  ViewStore as_measured = copy_of(measured.reference());
  if (!correct_all(measured.reference(), as_measured, rays, indirect, run).is_rougher())
    return true;
  measured.reference() = std::move(as_measured);
  return false;
}

}  // namespace

EarlyIndirectLight correct_before_registration(MeasuredViews& measured,
                                               const LitScan& lit,
                                               const FusionOptions& fusion,
                                               const Run& run) {
  if (measured.points == 0) return {.found = false};
  const ShiftedPoints points = shifted_points(lit.plan);
  EarlyIndirectLight out;
  out.part = predict_for_measured(measured, lit, fusion, points, quiet_run(run));
  out.found = out.part.has_value();
  out.poses = poses_of(measured.reference());
  if (!out.found || points == ShiftedPoints::Kept) return out;
  out.corrects = correct_views(measured, lit.rays, *out.part, run);
  out.corrected = out.corrects;
  return out;
}

std::optional<IndirectLightReport> correct_indirect_light(MeasuredViews& measured,
                                                          const LitScan& lit,
                                                          const EarlyIndirectLight& before,
                                                          FusionOptions& fusion,
                                                          const Run& run) {
  const Run quiet = quiet_run(run);
  ShiftedPoints points = before.corrects ? shifted_points(lit.plan) : ShiftedPoints::Kept;
  std::optional<IndirectPart> indirect;
  if (before.corrected) {
    indirect = predict_for_corrected(measured, lit, fusion, quiet);
  } else if (before.part &&
             std::ranges::equal(before.poses, poses_of(measured.reference()), is_same_pose)) {
    indirect = before.part;
  } else {
    indirect = predict_for_measured(measured, lit, fusion, points, quiet);
  }
  if (!indirect) return std::nullopt;
  if (points == ShiftedPoints::Moved && !correct_views(measured, lit.rays, *indirect, run))
    points = ShiftedPoints::Kept;
  const auto correction = std::make_shared<const IndirectCorrection>(indirect->correction(points));
  fusion.terms.push_back({UncertaintyTerm::IndirectLight,
                          [correction, &rays = lit.rays](const View& view, std::size_t /*camera*/) {
                            return correction->systematic_mm(view, rays);
                          }});
  IndirectLightReport report = report_of(*indirect, points, measured.reference(), lit.rays);
  announce(report, run);
  return report;
}

namespace {

/// Indirect light in the views of one camera, and the rays of its pixels.
struct CameraPart {
  Image<Eigen::Vector2f> rays;
  std::optional<IndirectCorrection> correction;  ///< none without indirect light
};

}  // namespace

std::optional<IndirectLightReport> count_indirect_light(const MeasuredViews& measured,
                                                        const LitScan& lit,
                                                        FusionOptions& fusion,
                                                        const Run& run) {
  constexpr double kCoarse_px = 3.0;
  const Run quiet = quiet_run(run);
  const auto& cameras = lit.scan.rig.cameras;
  std::vector<std::unique_ptr<const ThinnedViews>> thinned;
  std::vector<CameraViews> views;
  for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
    thinned.push_back(std::make_unique<const ThinnedViews>(
        measured, camera, cameras[camera].camera.model, 1, quiet));
    views.push_back({thinned.back()->views, thinned.back()->camera});
  }
  const Mesh surface = fuse_views(views, thinned.front()->coarse_fusion(kCoarse_px, fusion), quiet);
  const auto parts = std::make_shared<std::vector<CameraPart>>(cameras.size());
  std::optional<IndirectLightReport> report;
  for (std::size_t camera = 0; camera < parts->size(); ++camera) {
    CameraPart& own = (*parts)[camera];
    const Scan scan = scan_of_camera(lit.scan, camera);
    own.rays = rays_of(scan.rig.reference().model);
    const auto part =
        indirect_part(lit_views(*thinned[camera], lit, scan.rig.projector), surface, run);
    if (!part) continue;
    own.correction = part->correction(ShiftedPoints::Kept);
    const IndirectLightReport found =
        report_of(*part, ShiftedPoints::Kept, measured.cameras[camera], own.rays);
    if (!report || found.largest_mm > report->largest_mm) report = found;
  }
  if (!report) return report;
  fusion.terms.push_back(
      {UncertaintyTerm::IndirectLight, [parts](const View& view, std::size_t camera) {
         const CameraPart& own = parts->at(camera);
         return own.correction ? own.correction->systematic_mm(view, own.rays) : Image<float>();
       }});
  announce(*report, run);
  return report;
}

}  // namespace frangia
