#pragma once

#include <string>
#include <vector>

#include "frangia/pattern/pattern.h"

namespace frangia {

/// Which frames an algorithm takes.
enum class ShiftRule {
  Any,         ///< any shifts that determine the phase
  ManyUneven,  ///< six or more, whose true shifts are found out
  ManyEqual,   ///< four or more equal steps, whose true length is found out
  Listed,      ///< `frames` equal steps of `step_deg`; of any length where that is 0
  PlusOne,     ///< N + 1 steps of 360 / N degrees, N at least 4
  Windowed     ///< 2N - 1 steps of 360 / N degrees, N at least 3
};

/// What is known of an algorithm before any frame is seen.
struct PublishedAlgorithm {
  std::string name;
  ShiftRule rule = ShiftRule::Listed;
  int frames = 0;         ///< of rule Listed
  double step_deg = 0.0;  ///< of rule Listed; 0 for any
  std::string source;
};

/// All of them, in the order of the table in docs/phase.md.
[[nodiscard]] const std::vector<PublishedAlgorithm>& published_algorithms();

/// "4 frames 90 degrees apart", for a person.
[[nodiscard]] std::string describe_frames(const PublishedAlgorithm& algorithm);

/// Whether the shifts are the algorithm's own, rising or falling, from any start.
[[nodiscard]] bool fits(const PublishedAlgorithm& algorithm, const std::vector<double>& shifts_rad);

/// Shifts that the algorithm takes, for its table of errors: N = 6 where it may be chosen.
[[nodiscard]] std::vector<double> example_shifts(const PublishedAlgorithm& algorithm);

/// The common step of equally spaced shifts, in (-pi, pi]; NaN when they are not.
[[nodiscard]] double common_step(const std::vector<double>& shifts_rad);

/// The best algorithm for frames of a projector that is linear (an interferometer, angular) or may
/// not be (a digital one): the former compensate errors of the step, the latter keep the harmonics
/// of a display out.
[[nodiscard]] std::string default_algorithm(const Pattern& pattern);

}  // namespace frangia
