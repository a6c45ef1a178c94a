#pragma once

#include <vector>

#include "frangia/core/image.h"

namespace frangia {

/// A 2 x 2 loop around which the wrapped phase differences do not sum to zero.
struct Residue {
  int x = 0;      ///< top left pixel of the loop
  int y = 0;      ///< row of that pixel
  int turns = 0;  ///< charge: whole turns gained clockwise, 1 or -1
};

/// Finds the residues of a wrapped phase, in raster order. A loop with a missing pixel is not a
/// residue.
///
/// @source   the paper's reference [34], Huntley 1989
[[nodiscard]] std::vector<Residue> find_residues(const Image<float>& phase_rad);

}  // namespace frangia
