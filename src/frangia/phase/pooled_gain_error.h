#pragma once

#include <span>

#include "frangia/phase/estimate_step.h"

namespace frangia {

/// The share by which a phase shifter's steps are too long, by what one or more views show of it.
///
/// A shifter's gain is the same in all views. Shifts that are each off by themselves look like
/// another step as well, and differ from view to view: how unequal they are within a view, and how
/// far the views scatter, says how much of the mean is to be believed. The rest is taken off it, so
/// that jitter alone leaves the nominal step, and a true gain stands.
///
/// shape    an estimate a view, of one pattern; those not `found` count for nothing
/// returns  0 when no step was found
/// source   James and Stein 1961, positive part; a factor as large as Student's for few views
[[nodiscard]] double pooled_gain_error(std::span<const StepEstimate> views);

}  // namespace frangia
