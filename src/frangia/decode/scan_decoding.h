#pragma once

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/decode/decode_view.h"

namespace frangia {

/// How the frames of a scan are decoded. The references must outlive it.
struct ScanDecoding {
  const Scan& scan;                    ///< whose frames are decoded
  const Image<Eigen::Vector2f>& rays;  ///< of the reference camera
  const DecodeOptions& options;        ///< of all views
  const DecodePlan& plan;              ///< of the scan's patterns
};

}  // namespace frangia
