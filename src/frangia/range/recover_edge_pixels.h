#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/range/range_grid.h"

namespace frangia {

struct EdgePixelOptions {
  int depth_px = 3;                 ///< how far into what was removed
  double max_incidence_deg = 82.0;  ///< a surface seen at a flatter angle counts as a depth step
};

/// Of the pixels that `remove_mixed_pixels` removed, those that see one surface with all of their
/// square after all: they lie where the pixels beside them lead, see `continues_surface`. First
/// those next to what was never in doubt, then those next to them. Where two such surfaces come to
/// lie beside each other, across a step no steeper than a slope may be, a surface would be laid
/// from one to the other: there the pixel behind stays away.
///
/// shape    in the order of `removed`
[[nodiscard]] std::vector<RangePixel> recover_edge_pixels(const RangeGrid& reliable,
                                                          const Image<Eigen::Vector2f>& rays,
                                                          const std::vector<RangePixel>& removed,
                                                          const EdgePixelOptions& options = {});

}  // namespace frangia
