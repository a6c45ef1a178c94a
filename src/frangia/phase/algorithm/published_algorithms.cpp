#include "frangia/phase/algorithm/published_algorithms.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

/// Largest deviation from equal steps that an algorithm for equal steps accepts.
constexpr double kTolerance_rad = 1e-3;  ///< shifts_deg typed with two decimals fits

/// N of the examples in the table of docs/phase.md.
constexpr int kExampleSteps = 6;

/// Returns N for an algorithm of `frames` frames 360 / N degrees apart; 0 if there is none.
int steps_per_period(ShiftRule rule, int frames) {
  if (rule == ShiftRule::PlusOne) return frames >= 5 ? frames - 1 : 0;
  return frames >= 5 && frames % 2 == 1 ? (frames + 1) / 2 : 0;
}

bool is_step(double step_rad, double wanted_deg) {
  return std::abs(std::abs(step_rad) - rad_from_deg(wanted_deg)) < kTolerance_rad;
}

}  // namespace

const std::vector<PublishedAlgorithm>& published_algorithms() {
  using enum ShiftRule;
  static const std::vector<PublishedAlgorithm> all = {
      {"3-step-120", Listed, 3, 120.0, "Bruning 1974, least squares"},
      {"3-step-90", Listed, 3, 90.0, "Wyant 1984"},
      {"4-step", Listed, 4, 90.0, "Bruning 1974; Wyant 1982"},
      {"schwider", Listed, 4, 90.0, "Schwider 1993, the paper's reference [33]"},
      {"carre", Listed, 4, 0.0, "Carre 1966"},
      {"hariharan", Listed, 5, 90.0, "Schwider 1983; Hariharan 1987"},
      {"schmit-creath", Listed, 6, 90.0, "Schmit and Creath 1995"},
      {"de-groot", Listed, 7, 90.0, "de Groot 1995"},
      {"larkin-oreb", PlusOne, 0, 0.0, "Larkin and Oreb 1992, N + 1 frames"},
      {"surrel", Windowed, 0, 0.0, "Surrel 1993, 2N - 1 frames"},
      {"least-squares", Any, 0, 0.0, "Greivenkamp 1984"},
      {"global-carre", ManyEqual, 0, 0.0, "Carre's step, one for the image, then least squares"},
      {"aia", ManyUneven, 0, 0.0, "Wang and Han 2004, iterated shifts"}};
  return all;
}

std::string describe_frames(const PublishedAlgorithm& algorithm) {
  switch (algorithm.rule) {
    case ShiftRule::Any:
      return "3 frames or more";
    case ShiftRule::ManyUneven:
      return "6 frames or more";
    case ShiftRule::ManyEqual:
      return "4 or more equal steps";
    case ShiftRule::PlusOne:
      return "N + 1 frames 360/N degrees apart";
    case ShiftRule::Windowed:
      return "2N - 1 frames 360/N degrees apart";
    case ShiftRule::Listed:
      break;
  }
  return algorithm.step_deg > 0.0
             ? fmt::format("{} frames {:g} degrees apart", algorithm.frames, algorithm.step_deg)
             : fmt::format("{} equal steps", algorithm.frames);
}

double common_step(const std::vector<double>& shifts_rad) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (shifts_rad.size() < 2) return kNone;
  const double step = wrap_rad(shifts_rad[1] - shifts_rad[0]);
  for (std::size_t k = 2; k < shifts_rad.size(); ++k) {
    const double expected = shifts_rad[0] + step * static_cast<double>(k);
    if (!(std::abs(wrap_rad(shifts_rad[k] - expected)) < kTolerance_rad)) return kNone;
  }
  return step;
}

bool fits(const PublishedAlgorithm& algorithm, const std::vector<double>& shifts_rad) {
  const int frames = static_cast<int>(shifts_rad.size());
  if (algorithm.rule == ShiftRule::Any) return frames >= 3;
  if (algorithm.rule == ShiftRule::ManyUneven) return frames >= 6;
  const double step = common_step(shifts_rad);
  // Steps of 0 or 180 degrees do not determine the phase.
  if (!(std::abs(std::sin(step)) > 0.01)) return false;
  if (algorithm.rule == ShiftRule::ManyEqual) return frames >= 4;
  if (algorithm.rule == ShiftRule::Listed) {
    return frames == algorithm.frames &&
           (algorithm.step_deg == 0.0 || is_step(step, algorithm.step_deg));
  }
  const int n = steps_per_period(algorithm.rule, frames);
  return n > 0 && is_step(step, 360.0 / n);
}

std::vector<double> example_shifts(const PublishedAlgorithm& algorithm) {
  int frames = algorithm.frames;
  double step_deg = algorithm.step_deg > 0.0 ? algorithm.step_deg : 90.0;
  if (algorithm.rule != ShiftRule::Listed) {
    frames = algorithm.rule == ShiftRule::PlusOne    ? kExampleSteps + 1
             : algorithm.rule == ShiftRule::Windowed ? 2 * kExampleSteps - 1
                                                     : kExampleSteps;
    step_deg = 360.0 / kExampleSteps;
  }
  if (algorithm.rule == ShiftRule::ManyEqual) {
    frames = 4;
    step_deg = 90.0;
  }
  std::vector<double> shifts;
  for (int k = 0; k < frames; ++k)
    shifts.push_back(rad_from_deg(step_deg * k));
  return shifts;
}

std::string default_algorithm(const Pattern& pattern) {
  if (pattern.fringes_per_degree > 0.0) {
    for (const auto* name :
         {"schwider", "hariharan", "schmit-creath", "de-groot", "larkin-oreb", "global-carre"}) {
      for (const PublishedAlgorithm& algorithm : published_algorithms()) {
        if (algorithm.name == name && fits(algorithm, pattern.shifts_rad)) return name;
      }
    }
  }
  return "least-squares";
}

}  // namespace frangia
