#include <string>
#include <vector>

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "frangia/core/enum_names.h"
#include "frangia/rig/rig.h"
#include "frangia/rig/target_set.h"
#include "frangia/targets/calibrate_find_targets.h"

#include "../bindings/arrays.h"
#include "../bindings/run_work.h"
#include "acquisition_bindings.h"

namespace frangia::python {

void bind_targets(py::module_& module) {
  py::class_<TargetSighting>(module, "TargetSighting", "A target as one view measured it.")
      .def_readonly("code", &TargetSighting::code, "Of a coded target; -1: it has none.")
      .def_readonly("center_px", &TargetSighting::center_px, "Image of its centre (x, y), px.")
      .def_readonly("center_mm", &TargetSighting::center_mm, "Its centre, rig frame, mm.")
      .def_readonly(
          "covariance_mm2", &TargetSighting::covariance_mm2, "Of `center_mm`, 3 x 3, mm^2.")
      .def_readonly("normal", &TargetSighting::normal, "Of its plane, unit, towards the camera.")
      .def_readonly(
          "size_ratio", &TargetSighting::size_ratio, "Measured over stated diameter or side.")
      .def_readonly("blur_px", &TargetSighting::blur_px, "Blur of its edge, sigma, px.")
      .def("__repr__", [](const TargetSighting& self) {
        return fmt::format("<frangia.TargetSighting, {}, at ({:.3f}, {:.3f}, {:.3f}) mm>",
                           self.code < 0 ? std::string("uncoded") : fmt::format("{}", self.code),
                           self.center_mm.x(),
                           self.center_mm.y(),
                           self.center_mm.z());
      });
  module.def(
      "find_targets",
      [](const py::object& image,
         const py::object& depth_mm,
         const py::object& sigma_mm,
         const Rig& rig,
         double diameter_mm,
         const std::string& tone,
         const std::string& dictionary,
         double marker_mm) {
        TargetSet targets;
        targets.diameter_mm = diameter_mm;
        targets.tone = value_named<TargetTone>("tone", tone);
        targets.dictionary = dictionary;
        targets.marker_mm = marker_mm;
        check_targets(targets);
        RangeGrid range;
        range.depth_mm = image_of<float>(depth_mm, "depth_mm");
        range.sigma_mm = image_of<float>(sigma_mm, "sigma_mm");
        const Image<float> counts = image_of<float>(image, "image");
        return result_of(py::none(), [&](const Run& /*run*/) {
          return find_targets(counts, range, rig.reference().model, targets);
        });
      },
      py::arg("image"),
      py::arg("depth_mm"),
      py::arg("sigma_mm"),
      py::arg("rig"),
      py::kw_only(),
      py::arg("diameter_mm") = 0.0,
      py::arg("tone") = "dark",
      py::arg("dictionary") = "",
      py::arg("marker_mm") = 0.0,
      "Finds round stickers in an image without fringes, and measures their centres by the points "
      "around them: discs of `diameter_mm` and `tone`, or markers of an ArUco dictionary. "
      "`depth_mm` and `sigma_mm` are those of `triangulate`.");
}

}  // namespace frangia::python
