#pragma once

#include <vector>

#include "frangia/core/image.h"

namespace frangia {

/// A loop of 2 x 2 pixels around which the wrapped phase jumps do not sum to zero.
struct Residue {
  int x = 0;  ///< of the loop's top left pixel
  int y = 0;
  int turns = 0;  ///< whole turns gained clockwise around it: 1 or -1
};

/// The residues of a wrapped phase, in the order of the image. A loop with a missing pixel is none.
///
/// source   the paper's reference [34], Huntley 1989
[[nodiscard]] std::vector<Residue> find_residues(const Image<float>& phase_rad);

}  // namespace frangia
