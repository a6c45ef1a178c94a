// The parts of the Python module.
#pragma once

#include <pybind11/pybind11.h>

namespace frangia::python {

void bind_errors(pybind11::module_& module);
void bind_patterns(pybind11::module_& module);
void bind_phase(pybind11::module_& module);
void bind_rig(pybind11::module_& module);
void bind_scan(pybind11::module_& module);
void bind_mesh(pybind11::module_& module);
void bind_inspection(pybind11::module_& module);
void bind_sections(pybind11::module_& module);
void bind_reconstruct(pybind11::module_& module);

}  // namespace frangia::python
