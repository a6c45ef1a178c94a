#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "frangia/decode/explain/internal/frame_sample.h"

namespace frangia {

/// Log density of a frame that shows no fringes: counts that are alike at all pixels or relative
/// to the light of a pixel (black, white), the mean of the other frames (out of focus, or moved
/// while it was exposed), or anything.
///
/// @shape    `shown_scale`: largest count of each pixel in the other frames; `values`: mean,
///           B cos(phi), B sin(phi) of each pixel by them, empty where they do not determine it
[[nodiscard]] double log_density_of_lost(const FrameSample& sample,
                                         std::size_t frame,
                                         const Eigen::ArrayXd& shown_scale,
                                         const Eigen::MatrixXd& values);

}  // namespace frangia
