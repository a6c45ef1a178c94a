#pragma once

#include <cstddef>

#include "frangia/phase/phase_map.h"

namespace frangia {

/// Discards every pixel of each 2 x 2 loop whose wrapped phase jumps do not sum to zero.
/// Returns how many pixels went.
///
/// source   the paper's reference [34], Huntley 1989
std::size_t discard_residues(WrappedPhase& phase);

}  // namespace frangia
