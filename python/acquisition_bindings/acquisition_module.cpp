#include "acquisition_bindings.h"

PYBIND11_MODULE(_acquisition, module) {
  module.doc() =
      "Calibration, capture and targets; loads OpenCV, Ceres and the devices' libraries.";
  pybind11::module_::import("frangia._frangia");  // whose classes and errors this one uses
  frangia::python::bind_calibrate(module);
  frangia::python::bind_capture(module);
  frangia::python::bind_targets(module);
}
