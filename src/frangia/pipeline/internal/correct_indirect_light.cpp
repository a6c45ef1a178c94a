#include "frangia/pipeline/internal/correct_indirect_light.h"

#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "frangia/core/median.h"
#include "frangia/pipeline/internal/indirect_part.h"

namespace frangia {
namespace {

void correct_all(MeasuredViews& measured, const IndirectPart& indirect, const Run& run) {
  for (std::size_t i = 0; i < measured.views.size(); ++i) {
    run.check();
    View view = measured.views.load(i);
    indirect.correct(view);
    measured.views.replace(i, view);
  }
}

}  // namespace

void correct_before_registration(MeasuredViews& measured,
                                 const Scan& scan,
                                 const Image<Eigen::Vector2f>& rays,
                                 const DecodeOptions& decode,
                                 FusionOptions coarse,
                                 const Run& run) {
  constexpr double kVoxel_px = 3.0;
  std::vector<float> depths_mm;
  const Image<float> first_mm = measured.views.load_depth_mm(0);
  for (const float depth : first_mm.pixels())
    if (!std::isnan(depth)) depths_mm.push_back(depth);
  if (depths_mm.empty()) return;
  const auto px = static_cast<double>((rays(1, 0) - rays(0, 0)).norm());
  coarse.voxel_mm = kVoxel_px * px * static_cast<double>(median_in_place(std::span(depths_mm)));
  Run quiet;
  quiet.stop = run.stop;
  const Mesh surface = fuse_views(measured.views, scan.rig.camera.model, coarse, quiet);
  const auto indirect = indirect_part(scan, measured, surface, rays, decode, quiet);
  if (indirect) correct_all(measured, *indirect, run);
}

std::optional<IndirectLightReport> correct_indirect_light(Mesh& fused,
                                                          MeasuredViews& measured,
                                                          const Scan& scan,
                                                          const Image<Eigen::Vector2f>& rays,
                                                          const DecodeOptions& decode,
                                                          FusionOptions& fusion,
                                                          const Run& run) {
  constexpr int kPasses = 2;
  const std::function<void(View&)> others = fusion.add_systematic;
  std::optional<IndirectLightReport> report;
  for (int pass = 0; pass < kPasses; ++pass) {
    const auto indirect = indirect_part(scan, measured, fused, rays, decode, run);
    if (!indirect) break;
    correct_all(measured, *indirect, run);
    report = indirect->report;
    fusion.add_systematic = [others, add = indirect->add](View& view) {
      if (others) others(view);
      add(view);
    };
    fused = fuse_views(measured.views, scan.rig.camera.model, fusion, run);
  }
  if (!report) return report;
  if (report->is_large()) {
    run.warn(report->text());
  } else {
    run.note(report->text());
  }
  return report;
}

}  // namespace frangia
