#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frangia/core/durable_log.h"
#include "frangia/core/missing.h"
#include "frangia/dataset/read_frames.h"

namespace frangia {

/// One stored frame.
struct ManifestFrame {
  std::uint32_t checksum = 0;  ///< CRC-32 of the file
  std::size_t bytes = 0;
  int attempts = 1;        ///< exposures until the frame was complete
  double scale = 1.0;      ///< of the shifts of its set
  double at_s = kMissing;  ///< when it was taken, since the scan began
};

/// Outcome of a complete set: all frames of one pattern in one view.
struct ManifestSet {
  int attempt = 0;     ///< number of retakes before it
  bool moved = false;  ///< its frames show motion and are rejected
  double scale = 1.0;  ///< for the shifts of the next set
};

/// The last known state of the turntable. Both are empty before its first move.
struct TableRecord {
  std::optional<double> reached_deg;   ///< where it stood last
  std::optional<double> intended_deg;  ///< the target, while a move has not ended
};

/// The log of a capture on disk: one line per file of the plan, frame, assessed set and table move.
/// Each line ends with its checksum, see DurableLog.
///
///     plan scan.toml 07dc8e00 crc=...
///     table moving 45 crc=...
///     table at 45 crc=...
///     began 1795734510.25 crc=...
///     frame views/000/fringe-0.png 1c291ca3 184211 attempts=1 scale=1 at=12.5 crc=...
///     set views/000/fringe 0 good scale=0.952 crc=...
///     exposures 2.5 10 crc=...
///
/// A frame counts as stored once its line is on the disk.
/// @errors   Error(File) when it cannot be written, Error(Input) that names the line
class CaptureManifest {
 public:
  static constexpr const char* kFileName = kManifestName;
  /// CRC-32 of each file of the plan, without the name of the scan.
  using PlanChecksums = std::map<std::string, std::uint32_t>;

  /// Writes the first lines of a new manifest.
  static void begin(const std::filesystem::path& file, const PlanChecksums& plan);

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
  /// Appends the line of a frame that is on the disk already.
  void add_recovered(const std::string& file, std::span<const char> bytes);
  /// Records another content of a file of the plan, before the file is written.
  void change_plan(const std::string& name, std::uint32_t checksum);
  void add_table_move(double target_deg);
  void add_table_at(double angle_deg);

  /// Time since the scan began, in this session or an earlier one.
  ///
  /// @missing  NaN for a scan that an older version of the program began
  [[nodiscard]] double seconds_since_begin() const;
  /// Number of stored frames, without those of rejected sets.
  [[nodiscard]] std::size_t frame_count() const { return frames_.size(); }
  [[nodiscard]] bool has(const std::string& file) const { return find(file) != nullptr; }
  [[nodiscard]] const ManifestFrame* find(const std::string& file) const;
  /// Whether the set is assessed and not rejected.
  [[nodiscard]] bool is_good(const std::string& set) const;
  /// Whether any set, the trial set included, is assessed.
  [[nodiscard]] bool has_sets() const { return !sets_.empty(); }
  /// Number of retakes of a set so far.
  [[nodiscard]] int attempt_of(const std::string& set) const;
  /// Scale of the next set's shifts, from the last assessed set.
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] const std::vector<double>& exposures_ms() const { return exposures_ms_; }
  [[nodiscard]] const TableRecord& table() const { return table_; }
  [[nodiscard]] const PlanChecksums& plan_checksums() const { return plan_; }
  [[nodiscard]] std::size_t retries() const;
  [[nodiscard]] std::size_t retakes() const { return retakes_; }
  /// Drops the frames whose files are missing or damaged, so that they are captured again. Returns
  /// their number.
  std::size_t forget_damaged();

  /// Number of lines that cannot be read.
  [[nodiscard]] std::size_t damaged_lines() const { return damaged_lines_; }
  /// Whether a damaged line may be that of a frame of the set. Lines before the one that rejected
  /// the set do not count.
  [[nodiscard]] bool may_lack_frames_of(const std::string& set) const;

 private:
  void read_line(const std::string& line, std::size_t number);
  void append(const std::string& file, const ManifestFrame& frame);
  bool read_frame(std::istream& words);
  bool read_set(std::istream& words, std::size_t number);
  bool read_table(std::istream& words);

  using Clock = std::chrono::steady_clock;
  std::filesystem::path folder_;
  DurableLog log_;
  double began_s_ = kMissing;  ///< seconds since 1970, by the computer's clock
  double opened_s_ = 0.0;      ///< the same of this session
  Clock::time_point opened_at_ = Clock::now();
  std::map<std::string, ManifestFrame> frames_;
  std::map<std::string, ManifestSet> sets_;
  std::map<std::string, std::size_t> rejected_at_;  ///< last line that rejected a set
  PlanChecksums plan_;
  TableRecord table_;
  std::vector<double> exposures_ms_;
  double scale_ = 1.0;
  std::size_t retakes_ = 0;
  std::size_t damaged_lines_ = 0;
  std::size_t last_damaged_ = 0;  ///< its number, from 1
};

}  // namespace frangia
