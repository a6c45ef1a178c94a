#include "frangia/reconstruct/internal/count_indirect_light.h"

#include <cstddef>
#include <memory>
#include <vector>

#include "frangia/dataset/scan_of_camera.h"
#include "frangia/reconstruct/internal/indirect_part.h"
#include "frangia/reconstruct/internal/tie_cameras.h"

namespace frangia {
namespace {

/// Indirect light in the views of one camera, which holds on to the rays of its pixels.
struct CameraPart {
  Image<Eigen::Vector2f> rays;
  std::optional<IndirectPart> part;
};

}  // namespace

std::optional<IndirectLightReport> count_indirect_light(FusedSurface& fused,
                                                        const MeasuredViews& measured,
                                                        const ScanDecoding& decoding,
                                                        FusionOptions& fusion,
                                                        const Run& run) {
  const auto parts = std::make_shared<std::vector<CameraPart>>(decoding.scan.rig.cameras.size());
  std::optional<IndirectLightReport> report;
  for (std::size_t camera = 0; camera < parts->size(); ++camera) {
    CameraPart& own = (*parts)[camera];
    const Scan scan = scan_of_camera(decoding.scan, camera);
    own.rays = rays_of(scan.rig.reference().model);
    ShownFringes shown;
    own.part = indirect_part({scan, own.rays, decoding.options, decoding.plan},
                             lit_views(measured, decoding.scan, camera),
                             fused.mesh,
                             ShiftedPoints::Kept,
                             shown,
                             run);
    if (own.part && (!report || own.part->report.largest_mm > report->largest_mm))
      report = own.part->report;
  }
  if (!report) return report;
  report->corrected = false;
  fusion.terms.push_back(
      {UncertaintyTerm::IndirectLight, [parts](const View& view, std::size_t camera) {
         const auto& part = parts->at(camera).part;
         return part ? part->systematic_mm(view) : Image<float>();
       }});
  fused = fuse_with_weights(views_of_cameras(measured, decoding.scan.rig), fusion, run);
  announce(*report, run);
  return report;
}

}  // namespace frangia
