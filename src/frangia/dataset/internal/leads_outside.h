#pragma once

#include <filesystem>

namespace frangia {

/// Whether the path `inner` leads out of the folder `outer`: by its name, over a symbolic link, or
/// by a NUL character, at which the operating system would cut it off.
///
/// @errors   Error(Input) for a name that no file system resolves: too long, or links in a circle
[[nodiscard]] bool leads_outside(const std::filesystem::path& outer,
                                 const std::filesystem::path& inner);

}  // namespace frangia
