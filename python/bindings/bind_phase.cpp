#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <pybind11/stl.h>

#include "frangia/decode/plan_decoding.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/gray/decode_gray_code.h"
#include "frangia/phase/spatial/unwrap_spatially.h"
#include "frangia/phase/temporal/unwrap_sequence.h"
#include "frangia/phase/temporal/unwrap_temporally.h"
#include "frangia/phase/wrap/estimate_noise.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/phase/wrap/wrap_phase.h"
#include "frangia/range/triangulate.h"
#include "frangia/rig/rig.h"

#include "arrays.h"
#include "bindings.h"
#include "phase_arrays.h"

namespace frangia::python {
namespace {

/// Adds a map of the class `Map` as a read-only array.
template <typename Number, typename Map, typename Pixel>
void add_map(py::class_<Map>& bound, const char* name, Image<Pixel> Map::*member, const char* doc) {
  bound.def_property_readonly(
      name,
      [member](const py::object& self) {
        return view_of<Number>(self.cast<const Map&>().*member, self);
      },
      doc);
}

template <typename Map>
void add_phase_maps(py::class_<Map>& bound) {
  bound.def_readonly("pattern", &Map::pattern, "Pattern that was decoded.");
  add_map<float>(bound, "phase", &Map::phase_rad, "Radians, height x width; NaN: not measured.");
  add_map<float>(bound, "sigma", &Map::sigma_rad, "Standard deviation of the phase, radians.");
  add_map<float>(bound,
                 "systematic",
                 &Map::systematic_rad,
                 "Systematic standard uncertainty, radians; 0 x 0: none is known.");
  add_map<std::uint8_t>(bound, "status", &Map::status, "Number of a PixelStatus for each pixel.");
}

WrappedPhase wrap(const FrameStack& stack,
                  const std::optional<PhaseAlgorithm>& algorithm,
                  const std::optional<NoiseModel>& noise,
                  float max_sigma_rad) {
  const PhaseAlgorithm& chosen =
      algorithm ? *algorithm : least_squares_of(stack.pattern.shifts_rad);
  const NoiseModel model = noise ? *noise : estimate_noise({&stack, 1});
  return wrap_phase(stack, chosen, model, {.max_sigma_rad = max_sigma_rad});
}

/// Frames of sinusoidal fringes that differ in their shifts alone.
WrappedPhase wrap_frames(const py::object& frames,
                         const std::vector<double>& shifts_rad,
                         double period_px,
                         int white_level,
                         const std::optional<PhaseAlgorithm>& algorithm,
                         const std::optional<NoiseModel>& noise,
                         float max_sigma_rad) {
  Pattern pattern;
  pattern.name = "fringes";
  pattern.period_px = period_px;
  pattern.shifts_rad = shifts_rad;
  const FrameStack stack = stack_of(frames, std::move(pattern), white_level);
  const py::gil_scoped_release release;
  return wrap(stack, algorithm, noise, max_sigma_rad);
}

/// A map without a period has a phase, but no place on the projector.
void require_period(const Pattern& pattern, const char* what) {
  if (pattern.period_px > 0.0 || pattern.fringes_per_degree > 0.0) return;
  throw Error(ErrorKind::Input,
              fmt::format("{} has no period; give it with the frames, as in wrap_phase(frames, "
                          "shifts_rad, period_px=20), or a Pattern with the phase",
                          what));
}

Projector screen_of(int width_px, int height_px) {
  PinholeModel model;
  model.width_px = width_px;
  model.height_px = height_px;
  Projector projector;
  projector.model = model;
  return projector;
}

AbsolutePhase unwrap_maps(const std::vector<WrappedPhase>& maps, const Projector& projector) {
  if (maps.empty()) throw Error(ErrorKind::Input, "there are no maps to unwrap");
  std::vector<Pattern> patterns;
  for (const WrappedPhase& map : maps) {
    require_period(map.pattern, "a map");
    patterns.push_back(map.pattern);
  }
  const OrderSource orders = plan_maps(patterns, projector, WrapOptions{}.max_sigma_rad);
  if (std::holds_alternative<FromCoarserMaps>(orders)) return unwrap_temporally(maps, projector);
  if (const auto* slope = std::get_if<FromSlope>(&orders))
    return unwrap_sequence(maps, projector, slope->method);
  throw Error(ErrorKind::Input,
              "the maps do not determine an absolute phase: no combination of them is unique over "
              "the projector's field; add a coarser map");
}

void bind_maps(py::module_& module) {
  py::enum_<PixelStatus>(module, "PixelStatus", py::arithmetic(), "Why a pixel has no phase.")
      .value("MEASURED", PixelStatus::Measured)
      .value("FILLED", PixelStatus::Filled)
      .value("UNMODULATED", PixelStatus::Unmodulated)
      .value("SATURATED", PixelStatus::Saturated)
      .value("RESIDUE", PixelStatus::Residue)
      .value("UNCERTAIN_ORDER", PixelStatus::UncertainOrder)
      .value("UNRESOLVED", PixelStatus::Unresolved)
      .value("MIXED_PIXEL", PixelStatus::MixedPixel)
      .value("OUT_OF_FIELD", PixelStatus::OutOfField)
      .value("CONTRADICTING", PixelStatus::Contradicting);

  py::class_<NoiseModel>(
      module,
      "NoiseModel",
      "Variance of a pixel: floor + slope * counts + dark * (range / (counts + range))^2.")
      .def(py::init([](double floor, double slope) {
             return NoiseModel{.floor_counts2 = floor, .slope_counts = slope};
           }),
           py::arg("floor_counts2"),
           py::arg("slope_counts"))
      .def_readonly("floor_counts2", &NoiseModel::floor_counts2, "Variance of a dark pixel.")
      .def_readonly("slope_counts", &NoiseModel::slope_counts, "Its increase per count.")
      .def_readonly("dark_counts2",
                    &NoiseModel::dark_counts2,
                    "What a dark pixel has beyond the floor, of a camera that encodes its light.")
      .def_readonly("dark_range_counts",
                    &NoiseModel::dark_range_counts,
                    "Brightness at which a quarter of that is left.")
      .def("variance", &NoiseModel::variance, py::arg("counts"), "Counts squared.");

  py::class_<FrameStack>(module, "FrameStack", "The frames of one pattern, in the order of shifts.")
      .def(py::init(&stack_of),
           py::arg("frames"),
           py::arg("pattern"),
           py::arg("white_level") = 0,
           "Arrays of uint8 or uint16, height x width, one for each shift; contiguous ones are not "
           "copied. A white level of 0 is the largest value of their type.")
      .def_readonly("pattern", &FrameStack::pattern, "Pattern that the frames show.")
      .def_readonly("white_level", &FrameStack::white_level, "Counts from which it is saturated.")
      .def_property_readonly(
          "frames",
          [](const py::object& self) {
            py::list out;
            for (const Frame& frame : self.cast<const FrameStack&>().frames) {
              std::visit(
                  [&]<typename Pixel>(const Image<Pixel>& image) {
                    out.append(view_of<Pixel>(image, self));
                  },
                  frame);
            }
            return out;
          },
          "The frames as arrays, without a copy.");

  py::class_<WrappedPhase> wrapped(module, "WrappedPhase", "A phase modulo 2 pi, in (-pi, pi].");
  wrapped.def(py::init(&wrapped_of),
              py::arg("phase"),
              py::arg("sigma") = py::none(),
              py::arg("modulation") = py::none(),
              py::arg("mean") = py::none(),
              py::arg("pattern") = Pattern{},
              "A map made elsewhere; NaN where nothing was measured.");
  add_phase_maps(wrapped);
  add_map<float>(wrapped, "modulation", &WrappedPhase::modulation_counts, "Amplitude, counts.");
  add_map<float>(wrapped, "mean", &WrappedPhase::mean_counts, "Mean intensity, counts.");

  py::class_<RelativePhase> relative(
      module, "RelativePhase", "Continuous in each region, up to a whole number of fringes.");
  add_phase_maps(relative);
  add_map<std::int32_t>(relative, "region", &RelativePhase::region, "0, 1, ...; -1: not measured.");
  relative.def_readonly("region_count", &RelativePhase::region_count, "Number of regions.");

  py::class_<AbsolutePhase> absolute(module, "AbsolutePhase", "Relative to the projector.");
  absolute.def(py::init([](const py::object& phase, const py::object& sigma, Pattern pattern) {
                 return absolute_of(phase, sigma, nullptr, std::move(pattern));
               }),
               py::arg("phase"),
               py::arg("sigma") = py::none(),
               py::arg("pattern") = Pattern{},
               "A phase made elsewhere; NaN where nothing was measured.");
  add_phase_maps(absolute);

  py::class_<RangeGrid> range(module, "RangeGrid", "A point for each pixel, rig frame.");
  add_map<float>(range, "depth_mm", &RangeGrid::depth_mm, "z in mm; NaN: no point.");
  add_map<float>(range, "sigma_mm", &RangeGrid::sigma_mm, "Noise along the viewing ray, mm.");
  add_map<float>(range, "systematic_mm", &RangeGrid::systematic_mm, "0 x 0: none is known.");
}

}  // namespace

void bind_phase(py::module_& module) {
  bind_maps(module);
  using Release = py::call_guard<py::gil_scoped_release>;
  module.def(
      "wrap_phase",
      &wrap,
      py::arg("stack"),
      py::kw_only(),
      py::arg("algorithm") = py::none(),
      py::arg("noise") = py::none(),
      py::arg("max_sigma_rad") = 0.1F,
      Release(),
      "Phase, modulation, mean and noise of each pixel. Without an algorithm: least squares; "
      "without a noise model: estimated from the frames.");
  module.def("wrap_phase",
             &wrap_frames,
             py::arg("frames"),
             py::arg("shifts_rad"),
             py::kw_only(),
             py::arg("period_px") = 0.0,
             py::arg("white_level") = 0,
             py::arg("algorithm") = py::none(),
             py::arg("noise") = py::none(),
             py::arg("max_sigma_rad") = 0.1F,
             "The same for an array of uint8 or uint16, frames x height x width, or a list of "
             "images, one for each shift in radians. unwrap_temporal needs the period, in "
             "projector pixels. A white level of 0 is the largest value of the type.");
  module.def(
      "unwrap_spatial",
      [](WrappedPhase map, const std::string& method) {
        SpatialUnwrapOptions options;
        options.method = value_named<SpatialMethod>("method", method);
        return unwrap_spatially(std::move(map), options);
      },
      py::arg("map"),
      py::arg("method") = "run-merging",
      Release(),
      "A phase that is continuous in each region. Methods: run-merging, quality-guided (the 1997 "
      "paper's), reliability-sorted (Herraez 2002).");
  module.def(
      "unwrap_temporal",
      [](const std::vector<WrappedPhase>& maps, const Rig& rig) {
        return unwrap_maps(maps, rig.projector);
      },
      py::arg("maps"),
      py::arg("rig"),
      Release(),
      "Absolute phase of the finest fringes from maps, coarse to fine.");
  module.def(
      "unwrap_temporal",
      [](const std::vector<WrappedPhase>& maps, const std::pair<int, int>& projector_px) {
        return unwrap_maps(maps, screen_of(projector_px.first, projector_px.second));
      },
      py::arg("maps"),
      py::arg("projector_px"),
      Release(),
      "The same for a projector of which only its width and height in pixels are known.");
  module.def(
      "decode_gray_code",
      [](const FrameStack& gray,
         const WrappedPhase& fringes,
         const std::optional<NoiseModel>& noise) {
        require_period(fringes.pattern, "the map of the fringes");
        return decode_gray_code({&gray, 1}, fringes, noise ? *noise : estimate_noise({&gray, 1}));
      },
      py::arg("gray"),
      py::arg("fringes"),
      py::arg("noise") = py::none(),
      Release(),
      "Absolute phase of fringes whose orders a Gray code gives.");
  module.def(
      "triangulate",
      [](AbsolutePhase phase, const Rig& rig) {
        require_period(phase.pattern, "the phase");
        return triangulate(phase, rig, rays_of(rig.reference().model));
      },
      py::arg("phase"),
      py::arg("rig"),
      Release(),
      "A point in mm, rig frame, for each pixel that has a phase.");
}

}  // namespace frangia::python
