#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/dataset/import_frames.h"

namespace frangia {

/// What is known of a frame after it was written.
struct WrittenFrame {
  std::string file;  ///< relative to the scan
  std::string codec;
  std::size_t bytes = 0;
  std::uint32_t crc32 = 0;
  std::optional<int> jpeg_quality{};
  bool is_color = false;        ///< a white or ambient frame in colour
  int bits = 8;                 ///< of the frame in the scan; 32: floating point
  int stated_white = 0;         ///< full scale that the original states
  int largest = 0;              ///< of whole numbers
  unsigned all_bits = 0;        ///< of whole numbers: every bit that any pixel sets
  double least_value = 0.0;     ///< of floating point
  double greatest_value = 0.0;  ///< of floating point
};

/// The folder of a view, relative to the scan: "views/000".
[[nodiscard]] std::string view_folder(std::size_t view);

/// Writes all frames of a plan below `folder`, several at a time.
///
/// @errors   that of the first frame that failed; Error(Cancelled)
[[nodiscard]] std::vector<WrittenFrame> write_imported_frames(const ImportPlan& plan,
                                                              const std::filesystem::path& folder,
                                                              const Run& run);

}  // namespace frangia
