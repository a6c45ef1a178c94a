#pragma once

#include <string>

#include "frangia/core/run.h"
#include "frangia/reconstruct/internal/register_setups.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/registration/find_background.h"
#include "frangia/registration/find_turntable_top.h"
#include "frangia/rig/rig.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Removes from all cameras what stands still while the part turns: background. Before the views
/// are split by setup, since it stands still in all of them.
[[nodiscard]] BackgroundReport leave_out_background(MeasuredViews& measured,
                                                    const Rig& rig,
                                                    const Run& run = {});

/// Adds to a reason not to trust the surface what to do about points of which nothing shows whether
/// they are background, where these are many; warns of them where there is no such reason.
[[nodiscard]] std::string with_undecided(std::string untrusted_reason,
                                         const BackgroundReport& background,
                                         const Run& run = {});

/// Removes the points outside of the volume that `clip_below_mm` and `clip_radius_mm` describe.
void clip_to_volume(MeasuredViews& measured,
                    const Rig& rig,
                    const ReconstructOptions& options,
                    const Run& run = {});

/// As `clip_to_volume`, on the registered turntable: each view with its refined pose on the table.
/// The poses of the views themselves, which join the setups, stay as they are.
void clip_on_registered_turntable(MeasuredSetup& setup,
                                  const Rig& rig,
                                  const ReconstructOptions& options,
                                  const Run& run = {});

/// Finds the turntable top and removes it together with all points less than 0.5 mm above it.
///
/// @units    mm, the height of the removed plane on the turntable's axis
/// @missing  NaN when no turntable top is found
[[nodiscard]] double remove_turntable_top(MeasuredViews& measured,
                                          const Rig& rig,
                                          const Run& run = {});

}  // namespace frangia
