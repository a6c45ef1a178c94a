#pragma once

#include <filesystem>
#include <optional>
#include <sstream>

#include "frangia/cad/internal/occt_translate.h"
#include "frangia/core/memory_budget.h"
#include "frangia/core/run.h"

namespace frangia {

/// A shape and what its file says beside it.
struct TranslatedCad {
  CadTranslation said;
  std::stringstream shape;  ///< as `translate_cad` writes it
};

/// Calls `translate_cad` in a second process with limited memory and without a terminal. A process
/// that ends before it has answered is an error that is said.
///
/// @errors   Error(Cancelled), which ends the process
[[nodiscard]] TranslatedCad translate_in_process(const std::filesystem::path& path,
                                                 const std::optional<double>& unit_mm,
                                                 const MemoryBudget& budget,
                                                 const Run& run);

}  // namespace frangia
