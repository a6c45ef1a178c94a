#include <algorithm>
#include <filesystem>
#include <iterator>
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
#include "frangia/simulate/simulate_calibration.h"
#include "frangia/simulate/simulate_scan.h"

#include "arrays.h"
#include "bindings.h"
#include "run_work.h"

namespace frangia::python {
namespace {

void check_view_number(const Scan& scan, std::size_t view) {
  if (view < scan.views.size()) return;
  throw Error(ErrorKind::Input,
              fmt::format("{} has no view {}; its views are 0 to {}",
                          scan.folder.string(),
                          view,
                          scan.views.size() - 1));
}

/// A value of the rig that the simulator can set, with its name in Python.
struct Fault {
  const char* name;
  void (*set)(SimulateOptions&, double);
};

constexpr Fault kFaults[] = {
    // NOLINT(*-avoid-c-arrays)
    {"exposure", [](SimulateOptions& o, double v) { o.exposure = v; }},
    {"ambient", [](SimulateOptions& o, double v) { o.ambient = v; }},
    {"contrast", [](SimulateOptions& o, double v) { o.contrast = v; }},
    {"step_error", [](SimulateOptions& o, double v) { o.step_error = v; }},
    {"step_jitter_deg", [](SimulateOptions& o, double v) { o.step_jitter_rad = rad_from_deg(v); }},
    {"display_gamma", [](SimulateOptions& o, double v) { o.display_gamma = v; }},
    {"flicker", [](SimulateOptions& o, double v) { o.flicker = v; }},
    {"projector_blur_px", [](SimulateOptions& o, double v) { o.projector_blur_px = v; }},
    {"texture", [](SimulateOptions& o, double v) { o.texture = v; }},
    {"gloss", [](SimulateOptions& o, double v) { o.gloss = v; }},
    {"bounces", [](SimulateOptions& o, double v) { o.bounces = v > 0.5 ? 1 : 0; }},
    {"subsurface_mm", [](SimulateOptions& o, double v) { o.subsurface_mm = v; }},
    {"speckle", [](SimulateOptions& o, double v) { o.speckle = v; }},
    {"angle_error_deg", [](SimulateOptions& o, double v) { o.angle_error_rad = rad_from_deg(v); }},
    {"axis_offset_mm", [](SimulateOptions& o, double v) { o.axis_offset_mm = v; }},
    {"axis_tilt_deg", [](SimulateOptions& o, double v) { o.axis_tilt_rad = rad_from_deg(v); }},
};

SimulateOptions options_of(std::uint64_t seed, int samples_per_px, const py::kwargs& faults) {
  SimulateOptions options;
  options.seed = seed;
  options.samples_per_px = samples_per_px;
  std::string known;
  for (const Fault& fault : kFaults)
    known += (known.empty() ? "" : ", ") + std::string(fault.name);
  for (const auto& [key, value] : faults) {
    const auto name = key.cast<std::string>();
    const auto* const found = std::find_if(std::begin(kFaults),
                                           std::end(kFaults),
                                           [&](const Fault& fault) { return fault.name == name; });
    if (found == std::end(kFaults)) {
      throw Error(ErrorKind::Input,
                  fmt::format("the simulator has no fault \"{}\"; it has {}", name, known));
    }
    found->set(options, value.cast<double>());
  }
  return options;
}

Rig rig_argument(const py::object& rig) {
  return py::isinstance<Rig>(rig) ? rig.cast<Rig>() : rig_preset(rig.cast<std::string>());
}

Scan simulate(const std::filesystem::path& folder,
              const py::object& part,
              const py::object& rig,
              int views,
              std::uint64_t seed,
              int samples_per_px,
              int shifts,
              const std::vector<double>& periods_px,
              const py::object& progress,
              const py::kwargs& faults) {
  const SimulateOptions options = options_of(seed, samples_per_px, faults);
  const Mesh mesh =
      py::isinstance<Mesh>(part) ? part.cast<Mesh>() : make_part(part.cast<std::string>());
  Scan plan;
  plan.folder = folder;
  plan.name = folder.filename().string();
  plan.rig = rig_argument(rig);
  PatternPlan patterns;
  patterns.shifts = shifts;
  patterns.periods_px = periods_px;
  plan.patterns = default_patterns(plan.rig, patterns);
  for (int i = 0; i < views; ++i)
    plan.views.push_back({kTwoPi * i / views, fmt::format("views/{:03}", i)});
  return result_of(progress,
                   [&](const Run& run) { return simulate_scan(mesh, plan, options, run); });
}

Scan simulate_poses(const std::filesystem::path& folder,
                    const py::object& rig,
                    int poses,
                    std::uint64_t seed,
                    int samples_per_px,
                    const std::vector<double>& periods_px,
                    const py::object& progress,
                    const py::kwargs& faults) {
  const SimulateOptions options = options_of(seed, samples_per_px, faults);
  CalibrationPlan plan;
  plan.folder = folder;
  plan.rig = rig_argument(rig);
  plan.poses = poses;
  plan.patterns.periods_px = periods_px;
  return result_of(progress,
                   [&](const Run& run) { return simulate_calibration(plan, options, run); });
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
        const RigContent content = value_named<RigContent>("rig", rig);
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
      py::arg("periods_px") = std::vector<double>(),
      py::arg("progress") = py::none(),
      "Renders a scan of a part (a name or a Mesh) with a rig (a preset or a Rig) into a new "
      "folder, with the true surface as truth.ply in the same folder. Without periods_px: the "
      "projector's width, an eighth and a 64th of it. Faults: exposure, ambient, contrast, "
      "step_error, step_jitter_deg, display_gamma, flicker, projector_blur_px, texture, gloss, "
      "bounces, subsurface_mm, speckle, angle_error_deg, axis_offset_mm, axis_tilt_deg.");
  module.def("simulate_poses",
             &simulate_poses,
             py::arg("folder"),
             py::arg("rig") = "digital",
             py::kw_only(),
             py::arg("poses") = 12,
             py::arg("seed") = 1,
             py::arg("samples_per_px") = 4,
             py::arg("periods_px") = std::vector<double>(),
             py::arg("progress") = py::none(),
             "Renders poses of a checkerboard for `calibrate` into a new folder, whose rig.toml "
             "holds the sizes of camera and projector only; truth-rig.toml is the true rig. "
             "Faults as those of `simulate`.");
}

}  // namespace frangia::python
