#pragma once

#include <cstdint>

#include "frangia/core/memory_budget.h"

namespace frangia {

/// Options of the readers of meshes and range scans.
struct ReadOptions {
  /// Memory that a file may take, whatever its size; bytes. Files above 10 MB may take 200 times
  /// their size.
  std::uint64_t allow_memory_bytes = kAllowMemoryBytes;
};

}  // namespace frangia
