#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "frangia/acquisition/capture_scan.h"
#include "frangia/core/angles.h"
#include "frangia/core/folder_lock.h"
#include "frangia/devices/guardian.h"
#include "frangia/devices/hardware_drivers.h"
#include "frangia/rig/read_rig.h"
#include "frangia/simulate/default_patterns.h"
#include "frangia/simulate/simulated_drivers.h"

#include "../bindings/arrays.h"
#include "../bindings/run_work.h"
#include "acquisition_bindings.h"

namespace frangia::python {
namespace {

/// Python as the guardian process that switches devices off when this one dies.
GuardianProgram guardian_of_python() {
  const auto python = py::module_::import("sys").attr("executable").cast<std::string>();
  return {python,
          {"frangia-guardian",
           "-c",
           "from frangia import _acquisition as a; raise SystemExit(a._run_guardian())"}};
}

std::vector<Driver> every_driver() {
  std::vector<Driver> drivers = hardware_drivers();
  for (Driver& driver : simulated_drivers())
    drivers.push_back(std::move(driver));
  return drivers;
}

void set_exposure(const py::object& exposure, CaptureOptions& options) {
  if (!py::isinstance<py::str>(exposure)) {
    options.camera.exposure_ms = exposure.cast<double>();
    if (!(options.camera.exposure_ms > 0.0))
      throw Error(ErrorKind::Input, "exposure_ms is not above 0; give milliseconds");
    return;
  }
  const auto name = exposure.cast<std::string>();
  if (name == "auto") {
    options.exposure = ExposureChoice::Automatic;
  } else if (name == "bracket") {
    options.exposure = ExposureChoice::Bracketed;
  } else {
    throw Error(ErrorKind::Input,
                fmt::format("exposure_ms = \"{}\" is not known; give milliseconds, \"auto\" or "
                            "\"bracket\"",
                            name));
  }
}

CaptureReport capture(const std::filesystem::path& rig_file,
                      const std::filesystem::path& folder,
                      int views,
                      int shifts,
                      const std::vector<double>& periods_px,
                      double fringes_per_degree,
                      const py::object& exposure_ms,
                      std::optional<double> table_at_deg,
                      const py::object& progress) {
  if (views < 1)
    throw Error(ErrorKind::Input, fmt::format("views = {}; capture at least one", views));
  PatternPlan patterns;
  patterns.shifts = shifts;
  patterns.periods_px = periods_px;
  patterns.fringes_per_degree = fringes_per_degree;
  CaptureOptions options;
  set_exposure(exposure_ms, options);
  if (table_at_deg) options.table_at_rad = rad_from_deg(*table_at_deg);
  const GuardianProgram program = guardian_of_python();
  return result_of(progress, [&](const Run& run) {
    run.stage("devices");
    Scan plan;
    plan.folder = folder;
    plan.name = std::filesystem::weakly_canonical(folder).filename().string();
    plan.rig = read_rig(rig_file, run);
    plan.patterns = default_patterns(plan.rig, patterns);
    for (int i = 0; i < views; ++i)
      plan.views.push_back({kTwoPi * i / views, fmt::format("views/{:03}", i)});
    const FolderLock lock(plan.folder);  // before opening the devices, which may be in use
    Guardian guardian(program);
    RigDevices devices = open_devices(
        rig_file, plan.rig, every_driver(), Deadline::in(30.0, run.stop), run, &guardian);
    run.stage("scan");
    return capture_scan(plan, devices, lock, options, run);
  });
}

}  // namespace

void bind_capture(py::module_& module) {
  py::class_<CaptureReport>(module, "CaptureReport", "Frames, retries and times of a capture.")
      .def_readonly("captured", &CaptureReport::captured, "Frames stored in this session.")
      .def_readonly("resumed", &CaptureReport::resumed, "Frames stored by earlier sessions.")
      .def_readonly("frame_retries", &CaptureReport::frame_retries, "Repeated exposures.")
      .def_readonly("set_retakes", &CaptureReport::set_retakes, "Sets repeated because of motion.")
      .def_property_readonly(
          "skipped",
          [](const CaptureReport& self) {
            std::vector<std::string> out;
            for (const SkippedView& view : self.skipped)
              out.push_back(view.sentence());
            return out;
          },
          "Views that could not be captured, and why.")
      .def_readonly("exposures_ms", &CaptureReport::exposures_ms, "Of the fringes.")
      .def_readonly("device_s", &CaptureReport::device_s, "Time in calls to devices, s.")
      .def_readonly("disk_s", &CaptureReport::disk_s, "Time waiting for the disk, s.");
  module.def("capture",
             &capture,
             py::arg("rig_file"),
             py::arg("folder"),
             py::kw_only(),
             py::arg("views") = 8,
             py::arg("shifts") = 4,
             py::arg("periods_px") = std::vector<double>(),
             py::arg("fringes_per_degree") = 1.0,
             py::arg("exposure_ms") = 10.0,
             py::arg("table_at_deg") = py::none(),
             py::arg("progress") = py::none(),
             "Captures a scan with the devices that rig.toml names, simulated ones too, as "
             "`frangia scan`; read_scan(folder) reads it. An interrupted capture is continued by "
             "the same call. exposure_ms: milliseconds, \"auto\" or \"bracket\".");
  module.def(
      "_run_guardian", [] { return run_guardian(); }, py::call_guard<py::gil_scoped_release>());
}

}  // namespace frangia::python
