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

/// What was acknowledged of one frame.
struct ManifestFrame {
  std::uint32_t checksum = 0;  ///< CRC-32 of the file
  std::size_t bytes = 0;
  int attempts = 1;    ///< exposures that it took until one came whole
  double scale = 1.0;  ///< of the shifts that it was taken with
};

/// What was found of a complete set of frames, all those of a pattern in a view.
struct ManifestSet {
  int attempt = 0;     ///< how often it was begun anew
  bool moved = false;  ///< its frames show motion and do not count
  double scale = 1.0;  ///< for the shifts of the next set
};

/// The list of what a capture session has on disk: a line a frame, a line a set that was assessed,
///
///     frame views/000/fringe-0.png 1c291ca3 184211 attempts=1 scale=1
///     set views/000/fringe 0 good scale=0.952
///     exposures 2.5 10
///
/// A frame is acknowledged once its line is on the disk.
/// errors   Error(File) when it cannot be written, Error(Input) that names the line
class CaptureManifest {
 public:
  /// `folder` is the scan's; the list is in capture/manifest.txt.
  explicit CaptureManifest(std::filesystem::path folder);

  /// Stores a file durably and acknowledges it, its checksum found here. `file` is relative to the
  /// folder. For the thread that stores: it touches the disk and nothing else of this.
  void store(const std::string& file, std::span<const char> bytes, ManifestFrame frame);
  /// Writes down what was found of a set; likewise.
  void store(const std::string& set, const ManifestSet& outcome);

  /// Takes in what is on its way to the disk; for the thread that asks the questions below.
  void add(const std::string& file, const ManifestFrame& frame) { frames_[file] = frame; }
  void add(const std::string& set, const ManifestSet& outcome);
  void add_exposures(const std::vector<double>& exposures_ms);

  [[nodiscard]] bool has(const std::string& file) const { return find(file) != nullptr; }
  [[nodiscard]] const ManifestFrame* find(const std::string& file) const;
  /// A set that was assessed and counts.
  [[nodiscard]] bool is_good(const std::string& set) const;
  /// How often a set was begun anew.
  [[nodiscard]] int attempt_of(const std::string& set) const;
  /// On the shifts of the next set: as the last one that was assessed says.
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] const std::vector<double>& exposures_ms() const { return exposures_ms_; }
  [[nodiscard]] std::size_t retries() const;
  [[nodiscard]] std::size_t retakes() const { return retakes_; }
  /// Forgets the frames whose files are gone or damaged, to be taken again, and returns how many
  /// there were.
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
