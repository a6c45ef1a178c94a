#include "frangia/dataset/scan_of_camera.h"

#include "frangia/rig/rig_of_camera.h"

namespace frangia {

Scan scan_of_camera(const Scan& scan, std::size_t camera) {
  Scan out = scan;
  out.rig = rig_of_camera(scan.rig, camera);
  if (camera == 0) return out;
  for (ScanView& view : out.views)
    view.folder /= out.rig.reference().name;
  return out;
}

}  // namespace frangia
