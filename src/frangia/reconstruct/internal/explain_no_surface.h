#pragma once

#include <cstddef>
#include <string>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/decode/decode_view.h"

namespace frangia {

/// Points of a scan that form no surface.
struct PointCounts {
  std::size_t measured = 0;
  std::size_t unresolved = 0;  ///< removed because nothing determines their fringe order
};

/// The message for a scan whose points form no surface: `max_sigma` rejects the pixels of the first
/// view, their fringe orders are unknown or uncertain, or the light is at fault.
///
/// @shape    `rays` as the camera
[[nodiscard]] std::string explain_no_surface(const Scan& scan,
                                             const Image<Eigen::Vector2f>& rays,
                                             const DecodeOptions& options,
                                             PointCounts counts,
                                             const Run& run);

}  // namespace frangia
