#pragma once

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/range/range_grid.h"

namespace frangia {

/// What a view saw, without what may be a mixture.
struct ReliablePixels {
  const RangeGrid& range;
  const Image<Eigen::Vector2f>& rays;
  float max_slope;  ///< see `is_connected`
};

/// Whether a pixel that is none of them lies where the surface beside it leads, and is as bright as
/// is expected there.
///
/// The reliable pixels about it that hang together with one next to it are followed by paraboloids,
/// in inverse depth and in light. A pixel that sees two surfaces lies beside the first, but for so
/// little that noise is as much; one that sees the surface with a part of its square only, beside a
/// silhouette or a shadow, is darker. Light is told by sigma: noise of phase is one over its root.
///
/// missing  false where too few pixels lead there
[[nodiscard]] bool continues_surface(const ReliablePixels& reliable, const RangePixel& pixel);

}  // namespace frangia
