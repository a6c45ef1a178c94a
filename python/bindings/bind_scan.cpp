#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "frangia/core/angles.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/parts.h"
#include "frangia/simulate/rig_presets.h"
#include "frangia/simulate/simulate_scan.h"

#include "arrays.h"
#include "bindings.h"
#include "run_work.h"

namespace frangia::python {
namespace {

RigContent content_of(const std::string& rig) {
  if (rig == "complete") return RigContent::Complete;
  if (rig == "start-values") return RigContent::StartValues;
  if (rig == "phase-only") return RigContent::PhaseOnly;
  throw Error(
      ErrorKind::Input,
      fmt::format("rig = \"{}\" is not known; use complete, start-values or phase-only", rig));
}

void check_view_number(const Scan& scan, std::size_t view) {
  if (view < scan.views.size()) return;
  throw Error(ErrorKind::Input,
              fmt::format("{} has no view {}; its views are 0 to {}",
                          scan.folder.string(),
                          view,
                          scan.views.size() - 1));
}

Scan simulate(const std::filesystem::path& folder,
              const py::object& part,
              const py::object& rig,
              int views,
              std::uint64_t seed,
              int samples_per_px,
              int shifts,
              double display_gamma,
              double flicker,
              double step_error,
              const py::object& progress) {
  const Mesh mesh =
      py::isinstance<Mesh>(part) ? part.cast<Mesh>() : make_part(part.cast<std::string>());
  Scan plan;
  plan.folder = folder;
  plan.name = folder.filename().string();
  plan.rig = py::isinstance<Rig>(rig) ? rig.cast<Rig>() : rig_preset(rig.cast<std::string>());
  PatternPlan patterns;
  patterns.shifts = shifts;
  plan.patterns = default_patterns(plan.rig, patterns);
  for (int i = 0; i < views; ++i)
    plan.views.push_back({kTwoPi * i / views, fmt::format("views/{:03}", i)});
  SimulateOptions options;
  options.seed = seed;
  options.samples_per_px = samples_per_px;
  options.display_gamma = display_gamma;
  options.flicker = flicker;
  options.step_error = step_error;
  return result_of(progress,
                   [&](const Run& run) { return simulate_scan(mesh, plan, options, run); });
}

}  // namespace

void bind_scan(py::module_& module) {
  py::class_<ScanView>(module, "ScanView", "One view of a scan.")
      .def_property_readonly(
          "angle_deg",
          [](const ScanView& view) { return deg_from_rad(view.angle_rad); },
          "Angle of the turntable.")
      .def_readonly("folder", &ScanView::folder, "Folder of its frames, in the scan's.")
      .def_readonly("setup", &ScanView::setup, "Views of one setup share a pose of the part.");
  py::class_<Scan>(module, "Scan", "What scan.toml and rig.toml hold.")
      .def_readonly("folder", &Scan::folder, "Folder of scan.toml.")
      .def_readonly("name", &Scan::name, "Name of the scan.")
      .def_readonly("rig", &Scan::rig, "Calibrated rig.")
      .def_readonly("patterns", &Scan::patterns, "In the order of capture.")
      .def_readonly("views", &Scan::views, "In the order of capture.")
      .def(
          "frames",
          [](const Scan& scan, std::size_t view) {
            check_view_number(scan, view);
            return result_of(py::none(),
                             [&](const Run& run) { return read_frames(scan, view, run); });
          },
          py::arg("view"),
          "The frames of a view: a FrameStack for each pattern and exposure.")
      .def("__repr__", [](const Scan& scan) {
        return fmt::format("<frangia.Scan '{}', {} views, {} patterns>",
                           scan.name,
                           scan.views.size(),
                           scan.patterns.size());
      });
  module.def(
      "read_scan",
      [](const std::filesystem::path& folder, const std::string& rig) {
        const RigContent content = content_of(rig);
        return result_of(py::none(),
                         [&](const Run& run) { return read_scan(folder, run, content); });
      },
      py::arg("folder"),
      py::kw_only(),
      py::arg("rig") = "complete",
      "Reads scan.toml and rig.toml of a folder. rig: complete; start-values, before a "
      "calibration; "
      "phase-only, to decode without geometry.");
  module.def(
      "simulate",
      &simulate,
      py::arg("folder"),
      py::arg("part") = "bust",
      py::arg("rig") = "digital",
      py::kw_only(),
      py::arg("views") = 8,
      py::arg("seed") = 1,
      py::arg("samples_per_px") = 4,
      py::arg("shifts") = 4,
      py::arg("display_gamma") = 1.0,
      py::arg("flicker") = 0.0,
      py::arg("step_error") = 0.0,
      py::arg("progress") = py::none(),
      "Renders a scan of a part (a name or a Mesh) with a rig (a preset or a Rig) into a new "
      "folder, with the true surface as truth.ply in the same folder.");
}

}  // namespace frangia::python
