#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "frangia/core/file_descriptor.h"

namespace frangia {

/// What a file is opened for.
enum class OpenFor {
  Reading,   ///< the file exists
  Appending  ///< writes go to its end; a missing file is created
};

/// Opens a regular file below a folder, component by component and never through a symbolic link,
/// so that neither a name nor a link of a foreign folder leads out of it. The folder itself may be
/// a link: the user named it. It never waits for a pipe or a device.
///
/// @errors   Error(Input) that names the first component which is a link, and where it leads; the
///          path, when `inner` is absolute, empty, or holds ".." or a NUL character; and the file,
///          when it is missing, not a regular file, cannot be opened, or, for appending, has a
///          further name (a hard link)
[[nodiscard]] FileDescriptor open_below(const std::filesystem::path& folder,
                                        const std::filesystem::path& inner,
                                        OpenFor use = OpenFor::Reading);

/// The path `folder / inner` after the same walk, for readers and writers that open by name. The
/// end of the path may be missing.
///
/// @errors   Error(Input) as `open_below` for a link and for a path that leads out, and where the
///           system does not let the path be looked at
[[nodiscard]] std::filesystem::path path_below(const std::filesystem::path& folder,
                                               const std::filesystem::path& inner);

/// Reads a whole regular file of at most `max_bytes` that `open_below` opens.
///
/// @errors   Error(Input) as `open_below`, and for a larger file
[[nodiscard]] std::string read_below(const std::filesystem::path& folder,
                                     const std::filesystem::path& inner,
                                     std::uint64_t max_bytes);

/// Reads the text of a JSON file that the program wrote itself, such as done.json: what comes back
/// from a disk may have been replaced. A parser of the text needs neither much memory nor a deep
/// stack.
///
/// @errors   Error(Input) as `read_below` for a link, a missing or a larger file, and as
///           `check_json_nesting`
[[nodiscard]] std::string read_json_below(const std::filesystem::path& folder,
                                          const std::filesystem::path& inner,
                                          std::uint64_t max_bytes = 1'000'000);

}  // namespace frangia
