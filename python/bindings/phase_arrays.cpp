#include "phase_arrays.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"

#include "arrays.h"

namespace frangia::python {
namespace {

constexpr float kAssumedSigma_rad = 0.01F;

Image<float> filled(const Image<float>& like, float value) {
  return Image<float>(like.width(), like.height(), value);
}

/// The array, or an image of `value` of the size of `like`.
Image<float> image_or(const py::object& values,
                      const char* what,
                      const Image<float>& like,
                      float value) {
  if (values.is_none()) return filled(like, value);
  Image<float> image = image_of<float>(values, what);
  if (!same_size(image, like)) {
    throw Error(ErrorKind::Input,
                fmt::format("{} has {} x {} pixels and the phase {} x {}; give arrays of one shape",
                            what,
                            image.height(),
                            image.width(),
                            like.height(),
                            like.width()));
  }
  return image;
}

/// Measured where the phase is a number.
Image<PixelStatus> status_of(const Image<float>& phase) {
  Image<PixelStatus> status(phase.width(), phase.height(), PixelStatus::Measured);
  for (std::size_t i = 0; i < status.pixels().size(); ++i)
    if (std::isnan(phase.pixels()[i])) status.pixels()[i] = PixelStatus::Unmodulated;
  return status;
}

/// NaN where the phase is.
void mask(const Image<float>& phase, Image<float>& values) {
  Image<float> own = values;  // the caller's array stays as it is
  for (std::size_t i = 0; i < own.pixels().size(); ++i)
    if (std::isnan(phase.pixels()[i])) own.pixels()[i] = kMissing;
  values = std::move(own);
}

/// The phase in memory of the library, which later stages change.
Image<float> own_phase(const py::object& phase, const char* what) {
  const Image<float> borrowed = image_of<float>(phase, what);
  return Image<float>(borrowed);
}

Frame frame_of(const py::handle& values) {
  const py::array array = py::array::ensure(values);
  if (array && py::isinstance<py::array_t<std::uint8_t>>(array))
    return image_of<std::uint8_t>(array, "a frame");
  if (array && py::isinstance<py::array_t<std::uint16_t>>(array))
    return image_of<std::uint16_t>(array, "a frame");
  PyErr_Clear();
  throw Error(ErrorKind::Input,
              fmt::format("a frame is an array of {}; give uint8 or uint16 counts, such as "
                          "frames.round().astype(numpy.uint16)",
                          array ? py::str(array.dtype()).cast<std::string>() : "objects"));
}

}  // namespace

FrameStack stack_of(const py::object& frames, Pattern pattern, int white_level) {
  FrameStack stack;
  if (!py::isinstance<py::iterable>(frames))
    throw Error(ErrorKind::Input, "frames is no list of arrays; give one array for each shift");
  for (const py::handle frame : frames)
    stack.frames.push_back(frame_of(frame));
  if (stack.frames.size() != static_cast<std::size_t>(pattern.frame_count())) {
    throw Error(ErrorKind::Input,
                fmt::format("there are {} frames and {} shifts; give one frame for each",
                            stack.frames.size(),
                            pattern.frame_count()));
  }
  for (const Frame& frame : stack.frames) {
    const Frame& first = stack.frames.front();
    if (width_of(frame) != width_of(first) || height_of(frame) != height_of(first) ||
        frame.index() != first.index())
      throw Error(ErrorKind::Input, "the frames differ in size or type; give arrays of one shape");
  }
  const bool is_wide = std::holds_alternative<Image<std::uint16_t>>(stack.frames.front());
  stack.white_level = white_level > 0 ? white_level : is_wide ? 65535 : 255;
  stack.pattern = std::move(pattern);
  return stack;
}

PhaseAlgorithm least_squares_of(const std::vector<double>& shifts_rad) {
  constexpr double kSameTurn = 1e-6;  // of a turn: shifts from a file have six digits
  std::vector<double> turns;          // the shifts that differ, by the angle between their fringes
  for (const double shift : shifts_rad) {
    const bool is_new = std::none_of(turns.begin(), turns.end(), [&](double other) {
      return std::abs(std::remainder(shift - other, kTwoPi)) < kSameTurn * kTwoPi;
    });
    if (is_new) turns.push_back(shift);
  }
  if (turns.size() < 3) {
    throw Error(ErrorKind::Input,
                fmt::format("{} shifts, of which {} differ, do not determine a phase; give three "
                            "or more in radians, such as [0, pi / 2, pi, 3 * pi / 2]",
                            shifts_rad.size(),
                            turns.size()));
  }
  return least_squares(shifts_rad);
}

WrappedPhase wrapped_of(const py::object& phase,
                        const py::object& sigma,
                        const py::object& modulation,
                        const py::object& mean,
                        Pattern pattern) {
  WrappedPhase map;
  map.pattern = std::move(pattern);
  map.phase_rad = own_phase(phase, "the phase");
  map.sigma_rad = image_or(sigma, "sigma", map.phase_rad, kAssumedSigma_rad);
  mask(map.phase_rad, map.sigma_rad);
  map.modulation_counts = image_or(modulation, "the modulation", map.phase_rad, 1.0F);
  map.mean_counts = image_or(mean, "the mean", map.phase_rad, 1.0F);
  map.status = status_of(map.phase_rad);
  return map;
}

RelativePhase relative_of(const py::object& phase,
                          const py::object& region,
                          const WrappedPhase& from) {
  RelativePhase out;
  out.pattern = from.pattern;
  out.phase_rad = own_phase(phase, "the phase");
  if (!same_size(out.phase_rad, from.phase_rad))
    throw Error(ErrorKind::Input, "the unwrapped phase has another shape than the wrapped one");
  out.sigma_rad = from.sigma_rad;
  mask(out.phase_rad, out.sigma_rad);
  out.status = status_of(out.phase_rad);
  if (region.is_none()) {
    out.region = Image<std::int32_t>(out.phase_rad.width(), out.phase_rad.height(), 0);
  } else {
    const auto borrowed = image_of<std::int32_t>(region, "the regions");
    out.region = Image<std::int32_t>(borrowed);
    if (!same_size(out.region, out.phase_rad))
      throw Error(ErrorKind::Input, "the regions have another shape than the phase");
  }
  for (std::size_t i = 0; i < out.region.pixels().size(); ++i) {
    std::int32_t& number = out.region.pixels()[i];
    if (number < 0 || std::isnan(out.phase_rad.pixels()[i])) {
      number = -1;
      out.phase_rad.pixels()[i] = kMissing;
      out.sigma_rad.pixels()[i] = kMissing;
    }
    out.region_count = std::max(out.region_count, number + 1);
  }
  return out;
}

AbsolutePhase absolute_of(const py::object& phase,
                          const py::object& sigma,
                          const WrappedPhase* from,
                          Pattern pattern) {
  AbsolutePhase out;
  out.pattern = std::move(pattern);
  out.phase_rad = own_phase(phase, "the phase");
  if (from != nullptr && !same_size(out.phase_rad, from->phase_rad))
    throw Error(ErrorKind::Input, "the unwrapped phase has another shape than the wrapped one");
  out.sigma_rad = sigma.is_none() && from != nullptr
                      ? from->sigma_rad
                      : image_or(sigma, "sigma", out.phase_rad, kAssumedSigma_rad);
  mask(out.phase_rad, out.sigma_rad);
  out.status = status_of(out.phase_rad);
  return out;
}

}  // namespace frangia::python
