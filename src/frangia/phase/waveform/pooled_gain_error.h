#pragma once

#include <span>

#include "frangia/phase/algorithm/estimate_step.h"

namespace frangia {

/// Estimates the relative gain error of a phase shifter from one or more views; 0 when no step was
/// found.
///
/// The gain is the same in all views. Independent errors of single shifts also change the apparent
/// step, differently in each view. The unevenness of the shifts within the views and the scatter
/// between views therefore determine by how much the mean is shrunk towards 0: pure jitter gives
/// almost 0, a true gain error is kept.
///
/// @shape    one estimate per view, of one pattern; estimates that are not `found` are ignored
/// @source   James and Stein 1961, positive part, with a factor similar to Student's for few views
[[nodiscard]] double pooled_gain_error(std::span<const StepEstimate> views);

}  // namespace frangia
