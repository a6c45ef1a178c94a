#pragma once

#include "frangia/registration/internal/optimize_bundle.h"
#include "frangia/registration/registration_report.h"

namespace frangia {

/// Finds which unknowns the views determine worse than the prior does, by the eigenvectors of their
/// information in units of the prior's. Sets `weakest`, `condition`, `axis_sigma_mm`,
/// `axis_sigma_rad` and `undetermined`. A view without surfels has no angle.
///
/// @units    `part_radius_mm`: how far the part reaches; a tilt of the axis moves it by that arm
void assess_observability(RegistrationReport& report,
                          const Bundle& bundle,
                          const BundleSums& sums,
                          const SurfelLists& surfels,
                          double part_radius_mm);

}  // namespace frangia
