#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "frangia/rig/read_rig.h"
#include "frangia/rig/rig.h"
#include "frangia/rig/write_rig.h"
#include "frangia/simulate/rig_presets.h"

#include "arrays.h"
#include "bindings.h"
#include "run_work.h"

namespace frangia::python {

void bind_rig(py::module_& module) {
  py::class_<CameraModel>(module, "CameraModel", "A pinhole camera with lens distortion.")
      .def_readonly("width_px", &CameraModel::width_px, "Columns.")
      .def_readonly("height_px", &CameraModel::height_px, "Rows.")
      .def_readonly("focal_px", &CameraModel::focal_px, "Focal lengths in x and y, px.")
      .def_readonly("principal_point_px",
                    &CameraModel::principal_point_px,
                    "Principal point; the centre of the first pixel is (0, 0).");
  py::class_<Rig>(module, "Rig", "A calibrated scanner; its frame is that of the camera, in mm.")
      .def_property_readonly(
          "camera",
          [](const Rig& rig) -> const CameraModel& { return rig.reference().model; },
          py::return_value_policy::reference_internal,
          "Model of the reference camera.")
      .def_property_readonly(
          "white_level", [](const Rig& rig) { return rig.reference().white_level; }, "Counts.")
      .def_property_readonly(
          "projector_position_mm", [](const Rig& rig) { return rig.projector.position_mm; }, "mm.")
      .def_property_readonly(
          "projector_rotation",
          [](const Rig& rig) { return rig.projector.rotation; },
          "projector_from_rig, 3 x 3.")
      .def_property_readonly(
          "is_angular",
          [](const Rig& rig) { return rig.projector.is_angular(); },
          "Whether the projector is an interferometer.")
      .def(
          "rig_from_object",
          [](const Rig& rig, double angle_rad) { return rig.rig_from_object(angle_rad).matrix(); },
          py::arg("angle_rad"),
          "Pose of the object at a table angle, 4 x 4, mm.")
      .def(
          "rays",
          [](const Rig& rig) { return array_of<float>(rays_of(rig.reference().model)); },
          "Direction (x / z, y / z) of each pixel, height x width x 2.")
      .def("__repr__", [](const Rig& rig) {
        return fmt::format("<frangia.Rig, camera {} x {}, {} projector>",
                           rig.reference().model.width_px,
                           rig.reference().model.height_px,
                           rig.projector.is_angular() ? "angular" : "digital");
      });
  module.def(
      "read_rig",
      [](const std::filesystem::path& path) {
        return result_of(py::none(), [&](const Run& run) { return read_rig(path, run); });
      },
      py::arg("path"),
      "Reads a rig.toml.");
  module.def(
      "write_rig",
      [](const std::filesystem::path& path, const Rig& rig) { write_rig(path, rig); },
      py::arg("path"),
      py::arg("rig"),
      "Writes a rig.toml.");
  module.def(
      "rig_preset",
      [](const std::string& name) { return rig_preset(name); },
      py::arg("name"),
      "A built-in rig: digital, binocular, angular or carducci.");
}

}  // namespace frangia::python
