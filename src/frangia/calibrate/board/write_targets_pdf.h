#pragma once

#include <cstddef>
#include <filesystem>

#include "frangia/calibrate/board/write_board_pdf.h"
#include "frangia/rig/target_set.h"

namespace frangia {

/// What fits on the pages.
struct PrintedTargets {
  std::size_t discs = 0;  ///< uncoded targets
  std::size_t coded = 0;  ///< with the codes from `first_code` on
  std::size_t pages = 0;  ///< of the PDF
};

/// Writes targets as a PDF that prints at true scale, each with a circle to cut along: discs, and
/// markers with their codes printed next to them.
///
/// @errors   Error(Input) when a target does not fit on the paper, or the dictionary has fewer
/// codes;
///          Error(File) when the file cannot be written
PrintedTargets write_targets_pdf(const std::filesystem::path& path,
                                 const TargetSet& targets,
                                 std::size_t discs,
                                 std::size_t coded,
                                 int first_code,
                                 const PaperSize& paper);

}  // namespace frangia
