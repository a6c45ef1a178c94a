#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace frangia {

/// The CRC-32 of each frame that capture/manifest.txt of a scan lists, by the name of its file
/// relative to the scan. Only reads; damaged lines are passed over.
///
/// @missing  empty without a manifest, as for imported frames
/// @errors   Error(Input) that names the manifest when it cannot be read
[[nodiscard]] std::map<std::string, std::uint32_t> read_frame_checksums(
    const std::filesystem::path& scan);

}  // namespace frangia
