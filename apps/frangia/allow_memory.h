#pragma once

#include <CLI/CLI.hpp>

#include "frangia/files/read_mesh.h"

#include "option_values.h"

namespace frangia {

/// Adds --allow-memory. `options` must outlive the verb.
inline void add_allow_memory(CLI::App& verb, ReadOptions& options) {
  verb.add_option("--allow-memory",
                  options.allow_memory_bytes,
                  "memory that a small file may take when it expands, such as 4GB; 2GB by default")
      ->transform(size_above_zero());
}

}  // namespace frangia
