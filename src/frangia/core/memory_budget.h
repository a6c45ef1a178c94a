#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace frangia {

/// The memory that a file may take unless the user allows more, bytes.
inline constexpr std::uint64_t kAllowMemoryBytes = 2'000'000'000;

/// Limits the memory that a file takes when it is read. A small file may name its parts many times
/// or be compressed a thousand times. The limit is the larger of `allow_memory_bytes` and 200 times
/// the size of the file, which no ordinary file exceeds.
class MemoryBudget {
 public:
  /// `file_bytes` is the size of `file`.
  MemoryBudget(std::filesystem::path file,
               std::uint64_t file_bytes,
               std::uint64_t allow_memory_bytes);

  /// Refuses the file when the `used_bytes` so far exceed the limit.
  ///
  /// @errors   Error(Input) that names the file and `needed_bytes`, the estimate for the whole file
  void check(double used_bytes, double needed_bytes) const;
  /// As above, where the need of the whole file is known.
  void check(double needed_bytes) const { check(needed_bytes, needed_bytes); }

  /// The limit, bytes.
  [[nodiscard]] double limit_bytes() const { return limit_bytes_; }

 private:
  std::filesystem::path file_;
  double file_bytes_;
  double limit_bytes_;
};

/// A size in words, rounded up: "19.6 GB", "950 kB".
[[nodiscard]] std::string size_text(double bytes);

}  // namespace frangia
