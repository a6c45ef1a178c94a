#pragma once

#include <string>
#include <vector>

#include "frangia/pattern/pattern.h"

namespace frangia {

/// The shifts that an algorithm accepts.
enum class ShiftRule {
  Any,         ///< any shifts that determine the phase
  ManyUneven,  ///< six or more shifts, estimated from the frames
  ManyEqual,   ///< four or more equal steps, estimated from the frames
  Listed,      ///< `frames` equal steps of `step_deg`; any step if that is 0
  PlusOne,     ///< N + 1 steps of 360 / N degrees, N at least 4
  Windowed     ///< 2N - 1 steps of 360 / N degrees, N at least 3
};

/// Properties of an algorithm that do not depend on frames.
struct PublishedAlgorithm {
  std::string name;                    ///< name that options accept: "4-step"
  ShiftRule rule = ShiftRule::Listed;  ///< shifts that the algorithm accepts
  int frames = 0;                      ///< for the rule Listed
  double step_deg = 0.0;               ///< for the rule Listed; 0 for any step
  std::string source;                  ///< author and year of the publication
};

/// Returns all algorithms, in the order of the table in docs/phase.md.
[[nodiscard]] const std::vector<PublishedAlgorithm>& published_algorithms();

/// Describes the accepted frames in words, for example "4 frames 90 degrees apart".
[[nodiscard]] std::string describe_frames(const PublishedAlgorithm& algorithm);

/// Returns whether an algorithm accepts these shifts, ascending or descending, from any start.
[[nodiscard]] bool fits(const PublishedAlgorithm& algorithm, const std::vector<double>& shifts_rad);

/// Returns shifts that the algorithm accepts, for its table of errors; N = 6 where N is free.
[[nodiscard]] std::vector<double> example_shifts(const PublishedAlgorithm& algorithm);

/// Returns the common step of equally spaced shifts, in (-pi, pi].
///
/// @missing  NaN when the shifts are not equally spaced
[[nodiscard]] double common_step(const std::vector<double>& shifts_rad);

/// Returns the name of the preferred algorithm for a pattern. For an angular projector (an
/// interferometer) it compensates errors of the step; for a digital projector it suppresses the
/// harmonics of a nonlinear display.
[[nodiscard]] std::string default_algorithm(const Pattern& pattern);

}  // namespace frangia
