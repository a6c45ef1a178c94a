#pragma once

#include <string>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/pipeline/decode_view.h"

namespace frangia {

/// The message for a scan of which no pixel was measured: that `max_sigma` rejected them if the
/// first view has phases within its default, else that the light is at fault.
///
/// @shape    `rays` as the camera
[[nodiscard]] std::string explain_no_points(const Scan& scan,
                                            const Image<Eigen::Vector2f>& rays,
                                            const DecodeOptions& options,
                                            const Run& run);

}  // namespace frangia
