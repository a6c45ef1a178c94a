#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "frangia/core/missing.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/frames/frame_stack.h"

namespace frangia {

/// Reads the frames of one view, several files at a time.
///
/// @shape    one stack per pattern and exposure, in the order of `scan.patterns`
/// @units    counts
/// @errors   Error(Input) that names the first file that is missing, surplus, of another size than
///          the rig's camera, of another bit depth than the view's first frame, or brighter than
///          the rig's white level
[[nodiscard]] std::vector<FrameStack> read_frames(const Scan& scan,
                                                  std::size_t view,
                                                  const Run& run = {});

/// The log of a capture, in the folder `capture` of a scan.
inline constexpr const char* kManifestName = "manifest.txt";

/// A frame that the manifest of a capture lists.
struct StoredFrame {
  std::uint32_t checksum = 0;  ///< CRC-32 of the file
  double at_s = kMissing;      ///< when it was taken, since the scan began; older ones state none
};

/// The frames that capture/manifest.txt of a scan lists, by the name of the file relative to the
/// scan. Only reads; damaged lines are passed over.
///
/// @missing  empty without a manifest, as for imported frames
/// @errors   Error(Input) that names the manifest when it cannot be read
[[nodiscard]] std::map<std::string, StoredFrame> read_stored_frames(
    const std::filesystem::path& scan);

/// When the capture began, as seconds since 1970.
///
/// @missing  NaN without a manifest that states it
/// @errors   as read_stored_frames
[[nodiscard]] double read_began_s(const std::filesystem::path& scan);

}  // namespace frangia
