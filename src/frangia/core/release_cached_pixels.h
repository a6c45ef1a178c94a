#pragma once

namespace frangia {

/// Returns the pixel allocator's cached blocks to the system. Call it at the end of a stage when
/// the next stage needs images of other sizes.
void release_cached_pixels() noexcept;

}  // namespace frangia
