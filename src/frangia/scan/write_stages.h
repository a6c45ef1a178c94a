#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/frames/png.h"
#include "frangia/range/range_grid.h"
#include "frangia/scan/decode_view.h"

namespace frangia {

/// How a fate is drawn in mask.png, and what to call it.
struct FateLegend {
  PixelFate fate;
  Rgb color;
  std::string color_name;
  std::string meaning;
};
[[nodiscard]] const std::vector<FateLegend>& fate_legend();

/// The stages of one view as files in `folder`: pictures to look at (.png) and numbers to compute
/// with (.tiff, 32-bit float). For each pattern NAME-wrapped, NAME-modulation, NAME-sigma; for a
/// phase unwrapped in space relative and regions; for all mask, absolute, depth, sigma.
/// Returns the files' names.
///
/// errors   Error(File) when the folder cannot be made or written
std::vector<std::string> write_stages(const DecodedView& decoded,
                                      const RangeGrid& range,
                                      const std::filesystem::path& folder,
                                      const Run& run = {});

}  // namespace frangia
