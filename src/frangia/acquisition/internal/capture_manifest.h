#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "frangia/core/durable_log.h"

namespace frangia {

/// One stored frame.
struct ManifestFrame {
  std::uint32_t checksum = 0;  ///< CRC-32 of the file
  std::size_t bytes = 0;
  int attempts = 1;    ///< exposures until the frame was complete
  double scale = 1.0;  ///< of the shifts of its set
};

/// Outcome of a complete set: all frames of one pattern in one view.
struct ManifestSet {
  int attempt = 0;     ///< number of retakes before it
  bool moved = false;  ///< its frames show motion and are rejected
  double scale = 1.0;  ///< for the shifts of the next set
};

/// The log of a capture on disk: one line per frame and per assessed set.
///
///     frame views/000/fringe-0.png 1c291ca3 184211 attempts=1 scale=1
///     set views/000/fringe 0 good scale=0.952
///     exposures 2.5 10
///
/// A frame counts as stored once its line is on the disk.
/// @errors   Error(File) when it cannot be written, Error(Input) that names the line
class CaptureManifest {
 public:
  /// Reads capture/manifest.txt in `folder`, the scan folder.
  explicit CaptureManifest(std::filesystem::path folder);

  /// Writes a file durably and appends its line with the checksum. `file` is relative to the
  /// folder. For the storing thread: changes nothing in memory.
  void store(const std::string& file, std::span<const char> bytes, ManifestFrame frame);
  /// Appends the line of a set; for the storing thread, too.
  void store(const std::string& set, const ManifestSet& outcome);

  /// Records what is being stored; for the thread that calls the queries below.
  void add(const std::string& file, const ManifestFrame& frame) { frames_[file] = frame; }
  void add(const std::string& set, const ManifestSet& outcome);
  void add_exposures(const std::vector<double>& exposures_ms);

  [[nodiscard]] bool has(const std::string& file) const { return find(file) != nullptr; }
  [[nodiscard]] const ManifestFrame* find(const std::string& file) const;
  /// Whether the set is assessed and not rejected.
  [[nodiscard]] bool is_good(const std::string& set) const;
  /// Number of retakes of a set so far.
  [[nodiscard]] int attempt_of(const std::string& set) const;
  /// Scale of the next set's shifts, from the last assessed set.
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] const std::vector<double>& exposures_ms() const { return exposures_ms_; }
  [[nodiscard]] std::size_t retries() const;
  [[nodiscard]] std::size_t retakes() const { return retakes_; }
  /// Drops the frames whose files are missing or damaged, so that they are captured again. Returns
  /// their number.
  std::size_t forget_damaged();

 private:
  void read_line(const std::string& line, std::size_t number);

  std::filesystem::path folder_;
  DurableLog log_;
  std::map<std::string, ManifestFrame> frames_;
  std::map<std::string, ManifestSet> sets_;
  std::vector<double> exposures_ms_;
  double scale_ = 1.0;
  std::size_t retakes_ = 0;
};

}  // namespace frangia
