#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/pattern/pattern.h"
#include "frangia/phase/algorithm/algorithm_errors.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/algorithm/published_algorithms.h"

#include "bindings.h"
#include "phase_arrays.h"

namespace frangia::python {
namespace {

namespace py = pybind11;

Pattern fringes(const std::vector<double>& shifts_rad,
                std::optional<double> period_px,
                std::optional<double> fringes_per_degree,
                FringeDirection direction,
                const std::string& name) {
  if (period_px.has_value() == fringes_per_degree.has_value()) {
    throw Error(
        ErrorKind::Input,
        "fringes have either period_px, of a digital projector, or fringes_per_degree, of an "
        "interferometer; give one of them");
  }
  const double value = period_px ? *period_px : *fringes_per_degree;
  if (!(value > 0.0) || !std::isfinite(value))
    throw Error(ErrorKind::Input, fmt::format("a period of {} is not above 0", value));
  Pattern pattern;
  pattern.name = name;
  pattern.direction = direction;
  pattern.period_px = period_px.value_or(0.0);
  pattern.fringes_per_degree = fringes_per_degree.value_or(0.0);
  pattern.shifts_rad = shifts_rad;
  return pattern;
}

py::dict row_of(const PhaseAlgorithm& algorithm, const std::vector<double>& shifts) {
  const AlgorithmErrors errors = algorithm_errors(algorithm, shifts);
  py::dict row;
  row["name"] = algorithm.name;
  row["ripple_rad"] = errors.ripple_rad;
  row["noise_gain"] = errors.noise_gain;
  row["second_harmonic"] = errors.second_harmonic;
  row["third_harmonic"] = errors.third_harmonic;
  return row;
}

}  // namespace

void bind_patterns(py::module_& module) {
  py::enum_<PatternKind>(module, "PatternKind", "What the frames of a pattern show.")
      .value("FRINGE", PatternKind::Fringe)
      .value("LINE", PatternKind::Line)
      .value("GRAY", PatternKind::Gray)
      .value("RAMP", PatternKind::Ramp)
      .value("WHITE", PatternKind::White)
      .value("AMBIENT", PatternKind::Ambient);
  py::enum_<FringeDirection>(module, "FringeDirection", "Orientation of the fringes.")
      .value("VERTICAL", FringeDirection::Vertical)
      .value("HORIZONTAL", FringeDirection::Horizontal);
  py::class_<Pattern>(module, "Pattern", "A pattern that the projector shows in several frames.")
      .def_static(
          "fringes",
          &fringes,
          py::arg("shifts_rad"),
          py::kw_only(),
          py::arg("period_px") = py::none(),
          py::arg("fringes_per_degree") = py::none(),
          py::arg("direction") = FringeDirection::Vertical,
          py::arg("name") = "fringes",
          "Sinusoidal fringes: one frame for each of shifts_rad (radians), with a period in "
          "projector pixels or in fringes per degree.")
      .def_readonly("name", &Pattern::name, "Name, and prefix of the frames' file names.")
      .def_readonly("kind", &Pattern::kind, "What the frames show.")
      .def_readonly("direction", &Pattern::direction, "Orientation of fringes and stripes.")
      .def_readonly("shifts_rad", &Pattern::shifts_rad, "Shift of each frame, radians.")
      .def_readonly("period_px", &Pattern::period_px, "Period in projector pixels; 0: angular.")
      .def_readonly("fringes_per_degree",
                    &Pattern::fringes_per_degree,
                    "Pitch of an interferometer; 0: none.")
      .def_readonly("bits", &Pattern::bits, "Number of bits of a Gray code.")
      .def_property_readonly("frame_count", &Pattern::frame_count, "Number of frames.")
      .def("__repr__", [](const Pattern& pattern) {
        return fmt::format(
            "<frangia.Pattern '{}', {} frames>", pattern.name, pattern.frame_count());
      });

  py::class_<PhaseAlgorithm>(
      module, "PhaseAlgorithm", "B sin(phi) = sum sine[k] I[k], B cos(phi) = sum cosine[k] I[k].")
      .def_readonly("name", &PhaseAlgorithm::name, "Name.")
      .def_readonly("sine", &PhaseAlgorithm::sine, "Weights of the frames for B sin(phi).")
      .def_readonly("cosine", &PhaseAlgorithm::cosine, "Weights of the frames for B cos(phi).")
      .def_readonly("noise_gain", &PhaseAlgorithm::noise_gain, "c in sigma_phi = c sigma_I / B.")
      .def("__repr__", [](const PhaseAlgorithm& algorithm) {
        return fmt::format(
            "<frangia.PhaseAlgorithm '{}', {} frames>", algorithm.name, algorithm.frames());
      });
  module.def("phase_algorithm",
             &make_algorithm,
             py::arg("name"),
             py::arg("shifts_rad"),
             py::arg("gain_error") = 0.0,
             "A published algorithm for these nominal shifts, radians.");
  module.def("least_squares",
             &least_squares_of,
             py::arg("shifts_rad"),
             "The least-squares algorithm for arbitrary shifts, radians (Greivenkamp 1984).");
  py::class_<LinearAlgorithm>(module, "LinearAlgorithm", "An algorithm of yours and its frames.")
      .def(py::init(&linear_algorithm),
           py::arg("name"),
           py::arg("shifts_rad"),
           py::arg("numerator"),
           py::arg("denominator"),
           "phase = atan2(numerator . frames, denominator . frames).")
      .def_readonly("algorithm", &LinearAlgorithm::algorithm, "As the other algorithms.")
      .def_readonly("shifts_rad", &LinearAlgorithm::shifts_rad, "Shifts of its frames, radians.");
  module.def(
      "read_algorithm",
      [](const std::filesystem::path& path) { return read_algorithm(path); },
      py::arg("path"),
      "Reads an algorithm of yours, as examples/algorithms/my-algorithm.toml.");
  module.def(
      "algorithm_errors",
      &row_of,
      py::arg("algorithm"),
      py::arg("shifts_rad"),
      "Ripple at a step error of 5 %, noise gain and sensitivity to harmonics, as in the table of "
      "`frangia algorithms`.");
  module.def(
      "algorithms",
      [] {
        std::vector<std::string> names;
        for (const PublishedAlgorithm& published : published_algorithms())
          names.push_back(published.name);
        return names;
      },
      "Names of the published phase-shift algorithms.");
}

}  // namespace frangia::python
