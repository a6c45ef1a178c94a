#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/pattern/pattern.h"
#include "frangia/rig/rig.h"
#include "frangia/views/sigma_terms.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// A rig whose parameters are, beyond their calibration, as open as the views leave them.
///
/// @shape    `open`: as `RegistrationReport::rig_open`
[[nodiscard]] Rig with_open_parameters(Rig rig, const RigCovariance& open);

/// Returns the term of the uncertainty of the rig's parameters; none when their covariance is not
/// known.
///
/// @shape    `views` and `rays` of the reference camera; `pattern`: any fringe pattern in the
///           direction that the views were measured with
[[nodiscard]] std::vector<SigmaTerm> calibration_part(const ViewStore& views,
                                                      const Rig& rig,
                                                      const Pattern& pattern,
                                                      const Image<Eigen::Vector2f>& rays);

}  // namespace frangia
