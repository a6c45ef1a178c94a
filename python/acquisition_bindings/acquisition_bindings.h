// The parts of the module of calibration and capture.
#pragma once

#include <pybind11/pybind11.h>

namespace frangia::python {

void bind_calibrate(pybind11::module_& module);
void bind_capture(pybind11::module_& module);
void bind_targets(pybind11::module_& module);

}  // namespace frangia::python
