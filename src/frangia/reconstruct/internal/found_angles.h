#pragma once

#include <optional>
#include <span>

#include "frangia/dataset/scan_folder.h"
#include "frangia/reconstruct/internal/split_setups.h"

namespace frangia {

/// A scan with angles that were found, and how they differ from those it states.
struct ScanWithAngles {
  Scan scan;
  PoseExplanation explanation;
};

/// The scan with the angles that the registration of its setups found, where those are far from
/// the stated ones and something besides the registration rests on these: fringe orders that other
/// views decide, or the joining of setups.
///
/// @missing  none where the stated angles serve
[[nodiscard]] std::optional<ScanWithAngles> with_found_angles(
    const Scan& scan, std::span<const MeasuredSetup> setups);

/// Whether views that do not fit may have been spoiled by wrong angles: fringe orders that other
/// views decided.
[[nodiscard]] bool may_hide_angles(std::span<const MeasuredSetup> setups);

}  // namespace frangia
