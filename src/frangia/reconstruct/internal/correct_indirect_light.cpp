#include "frangia/reconstruct/internal/correct_indirect_light.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "frangia/core/error.h"
#include "frangia/reconstruct/internal/continued_surface.h"
#include "frangia/reconstruct/internal/indirect_part.h"
#include "frangia/views/subsample.h"

namespace frangia {
namespace {

/// Two directions of fringes determine a point together.
ShiftedPoints shifted_points(const DecodePlan& plan) {
  return plan.directions.size() == 1 ? ShiftedPoints::Moved : ShiftedPoints::Kept;
}

std::optional<IndirectPart> part_of(const MeasuredViews& measured,
                                    const Mesh& surface,
                                    const ScanDecoding& decoding,
                                    const Run& run) {
  return indirect_part(
      decoding, lit_views(measured, decoding.scan), surface, shifted_points(decoding.plan), run);
}

void correct_all(MeasuredViews& measured, const IndirectPart& indirect, const Run& run) {
  for (std::size_t i = 0; i < measured.reference().size(); ++i) {
    run.check();
    View view = measured.reference().load(i);
    indirect.correct(view);
    measured.reference().replace(i, view);
  }
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
                          const ScanDecoding& decoding,
                          const FusionOptions& fusion,
                          const Run& run) {
  const CameraModel camera = subsample(decoding.scan.rig.reference().model, step_px);
  ViewStore thinned;
  for (std::size_t i = 0; i < measured.reference().size(); ++i) {
    run.check();
    thinned.add(subsample(measured.reference().load_points(i), step_px));
  }
  const Mesh surface = surface_or_none([&] { return fuse_views(thinned, camera, fusion, run); });
  return part_of(measured, surface, decoding, run).has_value();
}

/// The prediction of a surface, made better by the surface that continues its reliable faces.
std::optional<IndirectPart> predict(const MeasuredViews& measured,
                                    const Mesh& surface,
                                    const ScanDecoding& decoding,
                                    const FusionOptions& coarse,
                                    const Run& run) {
  auto first = part_of(measured, surface, decoding, run);
  if (!first) return first;
  const CameraModel& camera = decoding.scan.rig.reference().model;
  const Mesh continued = surface_or_none(
      [&] { return continued_surface(measured, *first, camera, decoding.rays, coarse, run); });
  auto second = part_of(measured, continued, decoding, run);
  // The frames decide which surface predicts what they show; alike, the one without gaps.
  constexpr double kAlike = 1.1;
  const bool better = second && second->unexplained < kAlike * first->unexplained;
  return better ? second : first;
}

}  // namespace

bool correct_before_registration(MeasuredViews& measured,
                                 const ScanDecoding& decoding,
                                 FusionOptions coarse,
                                 const Run& run) {
  constexpr int kPasses = 2;
  if (measured.points == 0) return false;
  coarse = coarse_fusion(measured, decoding.rays, std::move(coarse));
  const CameraModel& camera = decoding.scan.rig.reference().model;
  Run quiet;
  quiet.stop = run.stop;
  // A coarser surface is smoother where indirect light has torn the points apart.
  FusionOptions first = coarse;
  first.voxel_mm *= 4.0;
  const int step_px = thinning_px(measured);
  if (step_px > 1 && !shows_indirect_light(measured, step_px, decoding, first, quiet)) return false;
  for (int pass = 0; pass < kPasses; ++pass) {
    const FusionOptions& fusion = pass == 0 ? first : coarse;
    const Mesh surface =
        surface_or_none([&] { return fuse_views(measured.reference(), camera, fusion, quiet); });
    const auto indirect = predict(measured, surface, decoding, coarse, quiet);
    if (!indirect) return pass > 0;
    correct_all(measured, *indirect, run);
  }
  return true;
}

std::optional<IndirectLightReport> correct_indirect_light(Mesh& fused,
                                                          MeasuredViews& measured,
                                                          const ScanDecoding& decoding,
                                                          FusionOptions& fusion,
                                                          const Run& run) {
  constexpr int kPasses = 2;
  const auto others = fusion.add_systematic;
  std::optional<IndirectLightReport> report;
  for (int pass = 0; pass < kPasses; ++pass) {
    const FusionOptions coarse = coarse_fusion(measured, decoding.rays, fusion);
    const auto indirect = predict(measured, fused, decoding, coarse, run);
    if (!indirect) break;
    correct_all(measured, *indirect, run);
    report = indirect->report;
    fusion.add_systematic = [others, add = indirect->add](View& view, std::size_t camera) {
      if (others) others(view, camera);
      add(view);
    };
    fused = fuse_views(measured.reference(), decoding.scan.rig.reference().model, fusion, run);
  }
  if (!report) return report;
  report->corrected = shifted_points(decoding.plan) == ShiftedPoints::Moved;
  announce(*report, run);
  return report;
}

}  // namespace frangia
