#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/pipeline/decode_view.h"
#include "frangia/range/range_grid.h"

namespace frangia {

/// A file that was written, and what is to be seen in it.
struct StageFile {
  std::string name;
  std::string caption;
};

/// The stages of one view as files in `folder`: pictures to look at (.png) and numbers to compute
/// with (.tiff, 32-bit float), and index.html, which shows the pictures with their captions.
///
/// For each pattern NAME-wrapped, NAME-residues, NAME-modulation, NAME-sigma. For a phase unwrapped
/// in space relative, regions and, if its order was kept, growth. For all mask, fringes, absolute,
/// depth, sigma.
/// errors   Error(File) when the folder cannot be made or written
std::vector<StageFile> write_stages(const DecodedView& decoded,
                                    const RangeGrid& range,
                                    const std::filesystem::path& folder,
                                    const Run& run = {});

}  // namespace frangia
