// Python functions as stages of decoding.
#pragma once

#include <pybind11/pybind11.h>

#include "frangia/decode/own_stages.h"

namespace frangia::python {

/// Stages of Python functions, each None or a function:
///
/// wrap(stack, algorithm, noise)   a WrappedPhase, or (phase, sigma, modulation, mean) arrays
/// unwrap_spatially(map)           a RelativePhase, or (phase, region) arrays, or a phase array
/// unwrap(maps)                    an AbsolutePhase, or (phase, sigma) arrays, or a phase array
///
/// Arrays are NaN, and regions negative, where nothing was measured. The functions run with the
/// GIL.
[[nodiscard]] OwnStages own_stages(const pybind11::object& wrap,
                                   const pybind11::object& unwrap_spatially,
                                   const pybind11::object& unwrap);

}  // namespace frangia::python
