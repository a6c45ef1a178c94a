#pragma once

#include <cstddef>
#include <functional>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/pattern/pattern.h"
#include "frangia/rig/rig.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Returns a function that adds the uncertainty of the rig's parameters to the systematic parts of
/// the points of a view of a camera; an empty one when the covariance of the parameters is not
/// known.
///
/// @shape    `views` and `rays` of the reference camera; `pattern`: any fringe pattern in the
///           direction that the views were measured with
[[nodiscard]] std::function<void(View&, std::size_t camera)> calibration_part(
    const ViewStore& views,
    const Rig& rig,
    const Pattern& pattern,
    const Image<Eigen::Vector2f>& rays);

}  // namespace frangia
