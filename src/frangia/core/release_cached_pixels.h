#pragma once

namespace frangia {

/// Gives the memory that is kept for the next image back to the system: at the end of a stage whose
/// images the next one does not have.
void release_cached_pixels() noexcept;

}  // namespace frangia
