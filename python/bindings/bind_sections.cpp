// Sections of a mesh by a plane.
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/inspect/section_curves.h"
#include "frangia/report/section_drawing.h"

#include "arrays.h"
#include "bindings.h"

namespace frangia::python {
namespace {

double length_of(const std::vector<SectionCurve>& curves) {
  double length = 0.0;
  for (const SectionCurve& curve : curves)
    length += length_mm(curve);
  return length;
}

SectionResult cut(const Mesh& mesh,
                  const Eigen::Vector3d& point_mm,
                  const Eigen::Vector3d& normal) {
  SectionResult section;
  section.plane = section_plane(point_mm, normal);
  section.measured = section_curves(mesh, section.plane);
  return section;
}

void write_section(const SectionResult& section, const std::filesystem::path& path) {
  const std::string format = path.extension().string();
  require(format == ".dxf" || format == ".svg", "a section is written as .dxf or .svg");
  AtomicFile file(path);
  file.stream() << (format == ".dxf" ? dxf_of(section) : svg_of(section));
  file.commit();
}

}  // namespace

void bind_sections(py::module_& module) {
  py::class_<SectionResult>(
      module, "Section", "The curves in which a plane cuts a mesh, the longest first.")
      .def_property_readonly(
          "curves",
          [](const py::object& self) {
            std::vector<py::array_t<double>> curves;
            for (const SectionCurve& curve : self.cast<const SectionResult&>().measured)
              curves.push_back(view_of<double>(curve.points_mm, self));
            return curves;
          },
          "N x 2 for each curve: along u and v, with the material at the left.")
      .def_property_readonly(
          "closed",
          [](const SectionResult& self) {
            std::vector<bool> closed;
            for (const SectionCurve& curve : self.measured)
              closed.push_back(curve.closed);
            return closed;
          },
          "Whether the last point of each curve is followed by the first.")
      .def_property_readonly(
          "length_mm",
          [](const SectionResult& self) { return length_of(self.measured); },
          "Of all curves.")
      .def_property_readonly(
          "area_mm2",
          [](const SectionResult& self) { return area_mm2(self.measured); },
          "Of the material; NaN where a curve is open.")
      .def_property_readonly(
          "point_mm", [](const SectionResult& self) { return self.plane.point_mm; }, "Origin.")
      .def_property_readonly(
          "u", [](const SectionResult& self) { return self.plane.u; }, "Unit, in the plane.")
      .def_property_readonly(
          "v", [](const SectionResult& self) { return self.plane.v; }, "Unit, normal x u.")
      .def("write", &write_section, py::arg("path"), "Writes .dxf (release 12) or .svg, in mm.")
      .def("__repr__", [](const SectionResult& self) {
        return fmt::format("<frangia.Section: {} curves, {:.3f} mm>",
                           self.measured.size(),
                           length_of(self.measured));
      });
  module.def("section",
             &cut,
             py::arg("mesh"),
             py::arg("point_mm"),
             py::arg("normal"),
             "Cuts a mesh by the plane through a point. Synthesized triangles are left out, so "
             "that curves are open at filled holes.");
}

}  // namespace frangia::python
