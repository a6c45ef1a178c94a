#pragma once

#include <cstddef>
#include <string>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/pipeline/decode_view.h"

namespace frangia {

/// The message for a scan whose `points` points form no surface: `max_sigma` rejects the pixels of
/// the first view, their fringe orders are uncertain, or the light is at fault.
///
/// @shape    `rays` as the camera
[[nodiscard]] std::string explain_no_surface(const Scan& scan,
                                             const Image<Eigen::Vector2f>& rays,
                                             const DecodeOptions& options,
                                             std::size_t points,
                                             const Run& run);

}  // namespace frangia
