#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/range/range_grid.h"

namespace frangia {

/// The pixels of a view, and which of them are in doubt.
struct DoubtfulPixels {
  const RangeGrid& range;
  const Image<Eigen::Vector2f>& rays;
  const Image<std::uint8_t>& doubtful;  ///< 1: not to be leant upon
  float max_slope;                      ///< see `is_connected`
};

/// Whether a pixel lies where the surface beside it leads, and is as bright as is expected there.
///
/// The pixels about it that are in no doubt, and hang together with one next to it, are followed by
/// paraboloids, in inverse depth and in light. A pixel that sees two surfaces lies beside the
/// first, but for so little that noise is as much; one that sees the surface with a part of its
/// square only, beside a silhouette or a shadow, is darker. Light is told by sigma: noise of phase
/// is one over its root.
///
/// missing  false for a pixel without depth, and where too few pixels lead there
[[nodiscard]] bool continues_surface(const DoubtfulPixels& pixels, const Eigen::Vector2i& at);

}  // namespace frangia
