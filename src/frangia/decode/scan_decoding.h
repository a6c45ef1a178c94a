#pragma once

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/decode/decode_view.h"

namespace frangia {

/// How the frames of a scan are decoded. The references must outlive it.
struct ScanDecoding {
  const Scan& scan;
  const Image<Eigen::Vector2f>& rays;  ///< of the reference camera
  const DecodeOptions& options;
  const DecodePlan& plan;
};

}  // namespace frangia
