#pragma once

#include "frangia/core/run.h"
#include "frangia/pattern/pattern.h"
#include "frangia/rig/rig.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Triangulates the points of all views by another rig. Each stays on its camera pixel and on the
/// absolute phase that the first rig shows there.
///
/// @missing  a point that the other rig does not measure is removed; there are no systematic parts
[[nodiscard]] ViewStore retriangulate_views(const ViewStore& views,
                                            const Pattern& pattern,
                                            const Rig& from,
                                            const Rig& to,
                                            const Run& run = {});

/// The same for one view.
[[nodiscard]] View retriangulate(View view, const Pattern& pattern, const Rig& from, const Rig& to);

}  // namespace frangia
