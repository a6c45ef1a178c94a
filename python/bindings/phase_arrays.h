// Phase maps made of plain arrays.
#pragma once

#include <vector>

#include <pybind11/pybind11.h>

#include "frangia/frames/frame_stack.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia::python {

/// The frames of a pattern, from a sequence of arrays, height x width, of 8 or 16 bits; a white
/// level of 0 stands for the largest value of their type.
[[nodiscard]] FrameStack stack_of(const pybind11::object& frames, Pattern pattern, int white_level);

/// Least squares for these shifts, radians.
///
/// @errors  Error(Input) when they do not determine a phase: fewer than three differ
[[nodiscard]] PhaseAlgorithm least_squares_of(const std::vector<double>& shifts_rad);

/// A wrapped map. Missing arrays (None): a sigma of 0.01 rad, a modulation and a mean of 1.
[[nodiscard]] WrappedPhase wrapped_of(const pybind11::object& phase,
                                      const pybind11::object& sigma,
                                      const pybind11::object& modulation,
                                      const pybind11::object& mean,
                                      Pattern pattern);

/// A phase with regions; without them (None) all measured pixels are one region. Without a sigma,
/// that of `from`.
[[nodiscard]] RelativePhase relative_of(const pybind11::object& phase,
                                        const pybind11::object& region,
                                        const WrappedPhase& from);

/// An absolute phase. Without a sigma (None), that of `from` where it has a phase.
[[nodiscard]] AbsolutePhase absolute_of(const pybind11::object& phase,
                                        const pybind11::object& sigma,
                                        const WrappedPhase* from,
                                        Pattern pattern);

}  // namespace frangia::python
