#include "frangia/core/memory_budget.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

/// Memory per byte of an ordinary file. The largest ratio known is that of a compressed 3MF: a
/// byte holds up to 10 bytes of text, and text takes up to 10 times its size.
constexpr double kMemoryPerFileByte = 200.0;

constexpr double kLargestMemory = 1e15;  // bytes; no machine has more

/// "19.6GB", one word on a command line.
std::string without_blank(std::string size) {
  std::erase(size, ' ');
  return size;
}

}  // namespace

MemoryBudget::MemoryBudget(std::filesystem::path file,
                           std::uint64_t file_bytes,
                           std::uint64_t allow_memory_bytes)
    : file_(std::move(file)),
      file_bytes_(static_cast<double>(file_bytes)),
      limit_bytes_(
          std::max(static_cast<double>(allow_memory_bytes), kMemoryPerFileByte * file_bytes_)) {}

void MemoryBudget::check(double used_bytes, double needed_bytes) const {
  if (used_bytes <= limit_bytes_) return;
  const std::string advice = needed_bytes < kLargestMemory
                                 ? fmt::format("set `allow_memory` to {} to read it",
                                               without_blank(size_text(needed_bytes)))
                                 : "write it again with fewer repeated parts";
  throw Error(
      ErrorKind::Input,
      fmt::format("{}: its {} expand to {} of memory, more than the {} that are allowed; {}",
                  file_.string(),
                  size_text(file_bytes_),
                  size_text(needed_bytes),
                  size_text(limit_bytes_),
                  advice));
}

std::string size_text(double bytes) {
  const auto rounded = [&](double unit, double step) {
    return std::ceil(bytes / unit / step * (1.0 - 1e-12)) * step;
  };
  if (!(bytes < kLargestMemory)) return "over 1000 TB";
  if (bytes >= 1e9) return fmt::format("{:.10g} GB", rounded(1e9, 0.1));
  if (bytes >= 1e6) return fmt::format("{:.0f} MB", rounded(1e6, 1.0));
  if (bytes >= 1e3) return fmt::format("{:.0f} kB", rounded(1e3, 1.0));
  return fmt::format("{:.0f} bytes", bytes);
}

}  // namespace frangia
