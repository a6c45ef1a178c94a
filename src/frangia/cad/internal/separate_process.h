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

/// What the second process may take.
struct ProcessLimits {
  MemoryBudget memory;
  double processor_s = 0.0;  ///< on the clock it may take four times as long
};

/// Calls `translate_cad` and `rehearse_faces` in a second process with limited memory and time and
/// without a terminal. A process that ends before it has answered, or answers in another form, is
/// an error. Texts are cut to 300 printable characters, and warnings to 20; requirements
/// beyond 2000 are left out.
///
/// @errors   Error(Cancelled), which ends the process; Error(Input) that names the file, when its
///           shape is larger than the memory allows; Error(File)
[[nodiscard]] TranslatedCad translate_in_process(const std::filesystem::path& path,
                                                 const CadRequest& asked,
                                                 const ProcessLimits& limits,
                                                 const Run& run);

}  // namespace frangia
