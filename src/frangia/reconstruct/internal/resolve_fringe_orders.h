#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/fringe_order/correct_fringe_orders.h"
#include "frangia/fringe_order/resolve_by_views.h"
#include "frangia/reconstruct/internal/measure_views.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Decides the fringe orders that a single view leaves open by the other views of its setup, and
/// corrects spatially unwrapped patches whose order the other views contradict.
///
/// The points of resolved regions are added to `measured`; notes and warnings give the counts.
///
/// @return number of points removed because nothing determines their fringe order
std::size_t resolve_fringe_orders(MeasuredViews& measured,
                                  const Rig& rig,
                                  const Image<Eigen::Vector2f>& rays,
                                  const FringeOrderCorrectionOptions& correction_options,
                                  const Run& run = {});

}  // namespace frangia
