#pragma once

#include <cstdint>

#include "frangia/registration/internal/optimize_bundle.h"
#include "frangia/registration/register_views.h"
#include "frangia/registration/registration_report.h"

namespace frangia {

/// What the pairs of views tell of the places of the views.
enum class Overlap : std::uint8_t {
  Determines,  ///< the state of the bundle, as well as the equations of the pairs state
  SaysNothing  ///< too few points overlap, or they let the views slide: the rig's places are kept
};

/// Returns the error that the pairs of two views have in common, as the mean distances of the
/// regions of the views show it; `systematic_mm` of the bundle where too few regions are compared.
[[nodiscard]] double shared_error_mm(const Bundle& bundle, const BundleSums& sums);

/// Sets how uncertain the places of the views are: `rests_on_rig`, `sigma`, `motions`, and how far
/// the views disagree where they overlap although the rig's places are kept.
///
/// @shape    `sums` in the state of the bundle; `offset`: from a state that is kept although
///           another fits as well to that one, in the unknowns
void assess_places(RegistrationReport& report,
                   const Bundle& bundle,
                   const BundleSums& sums,
                   const RegisterOptions& options,
                   Overlap overlap,
                   const Eigen::VectorXd& offset);

}  // namespace frangia
