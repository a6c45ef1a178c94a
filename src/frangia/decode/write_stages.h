#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/decode/decode_view.h"
#include "frangia/range/range_grid.h"

namespace frangia {

/// A written file and its caption.
struct StageFile {
  std::string name;     ///< file name within the folder
  std::string caption;  ///< what the file shows
};

/// Writes the stages of one view into `folder`: pictures (.png), values (.tiff, 32-bit float), and
/// index.html, which shows the pictures with their captions.
///
/// each pattern                 NAME-wrapped, NAME-residues, NAME-modulation, NAME-sigma, and
///                              NAME-systematic if a systematic part is known
/// spatially unwrapped phase    relative, regions, and growth if the growth order was kept
/// every view                   mask, fringes, absolute, absolute-sigma
/// both directions of fringes   absolute-horizontal
/// points                       depth, sigma, and sigma-noise and sigma-systematic if a
///                              systematic part is known; unless `range` is empty
/// @errors   Error(File) when the folder cannot be created or written
std::vector<StageFile> write_stages(const DecodedView& decoded,
                                    const RangeGrid& range,
                                    const std::filesystem::path& folder,
                                    const Run& run = {});

/// Writes the maps of one view into `folder`, named as `stages_from_files` reads the phase: for
/// each decoded direction of fringes the final phase, PATTERN-phase, and its noise, PATTERN-sigma;
/// mask.png; depth and sigma of the points unless `range` is empty.
///
/// @units    rad, mm; 32-bit floating point
/// @missing  NaN
/// @errors   Error(File) when the folder cannot be created or written
std::vector<StageFile> write_maps(const DecodedView& decoded,
                                  const RangeGrid& range,
                                  const std::filesystem::path& folder,
                                  const Run& run = {});

}  // namespace frangia
