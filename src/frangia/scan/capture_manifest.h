#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "frangia/core/durable_file.h"

namespace frangia {

/// What was acknowledged of one frame.
struct ManifestFrame {
  std::uint32_t checksum = 0;  ///< CRC-32 of the file
  std::size_t bytes = 0;
  double drive_scale = 1.0;  ///< factor on the phase shifter's commands when it was taken
};

/// The list of what a capture session has on disk, capture-manifest.txt: a line a frame,
///
///     frame views/000/fringe-0.png 1c291ca3 184211 scale=1
///     retake views/000/fringe 1          the set is taken again: its frames so far do not count
///     exposure 12.5                      what automatic exposure chose, ms
///
/// A frame is acknowledged once its line is on the disk.
/// errors   Error(File) when it cannot be written, Error(Input) that names the line
class CaptureManifest {
 public:
  explicit CaptureManifest(const std::filesystem::path& folder);

  /// Stores a file durably and acknowledges it. `file` is relative to the folder.
  void store(const std::string& file, std::span<const char> bytes, double drive_scale);
  void retake(const std::string& set, int attempt);
  void choose_exposure(double exposure_ms);

  [[nodiscard]] const ManifestFrame* find(const std::string& file) const;
  /// How often a set, "views/000/fringe", was begun anew.
  [[nodiscard]] int attempt_of(const std::string& set) const;
  [[nodiscard]] std::optional<double> exposure_ms() const { return exposure_ms_; }
  /// Forgets the frames whose files are gone or damaged, to be taken again, and returns how many
  /// there were.
  std::size_t forget_damaged();

 private:
  void read_line(const std::string& line, std::size_t number);
  void drop_set(const std::string& set);

  std::filesystem::path folder_;
  DurableLog log_;
  std::map<std::string, ManifestFrame> frames_;
  std::map<std::string, int> attempts_;
  std::optional<double> exposure_ms_;
};

}  // namespace frangia
