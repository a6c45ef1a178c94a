#include "frangia/reconstruct/internal/count_indirect_light.h"

#include <cstddef>
#include <memory>
#include <vector>

#include "frangia/dataset/scan_folder.h"

namespace frangia {
namespace {

/// Indirect light in the views of one camera, and the rays of its pixels.
struct CameraPart {
  Image<Eigen::Vector2f> rays;
  std::optional<IndirectPart> part;
};

}  // namespace

std::optional<IndirectLightReport> count_indirect_light(const MeasuredViews& measured,
                                                        const LitScan& lit,
                                                        FusionOptions& fusion,
                                                        const Run& run) {
  constexpr double kVoxel_px = 3.0;
  Run quiet;
  quiet.stop = run.stop;
  const auto& cameras = lit.scan.rig.cameras;
  std::vector<std::unique_ptr<const ThinnedViews>> thinned;
  std::vector<CameraViews> views;
  for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
    thinned.push_back(std::make_unique<const ThinnedViews>(
        measured, camera, cameras[camera].camera.model, 1, quiet));
    views.push_back({thinned.back()->views, thinned.back()->camera});
  }
  const Mesh surface = fuse_views(views, thinned.front()->coarse_fusion(kVoxel_px, fusion), quiet);
  const auto parts = std::make_shared<std::vector<CameraPart>>(cameras.size());
  std::optional<IndirectLightReport> report;
  for (std::size_t camera = 0; camera < parts->size(); ++camera) {
    CameraPart& own = (*parts)[camera];
    const Scan scan = scan_of_camera(lit.scan, camera);
    own.rays = rays_of(scan.rig.reference().model);
    own.part = indirect_part(
        lit_views(*thinned[camera], lit, scan.rig.projector), surface, ShiftedPoints::Kept, run);
    if (own.part && (!report || own.part->report.largest_mm > report->largest_mm))
      report = own.part->report;
  }
  if (!report) return report;
  report->corrected = false;
  fusion.terms.push_back(
      {UncertaintyTerm::IndirectLight, [parts](const View& view, std::size_t camera) {
         const CameraPart& own = parts->at(camera);
         return own.part ? own.part->correction->systematic_mm(view, own.rays) : Image<float>();
       }});
  announce(*report, run);
  return report;
}

}  // namespace frangia
