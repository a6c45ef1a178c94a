#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "frangia/acceptance/acceptance_plan.h"
#include "frangia/acceptance/measure_balls.h"
#include "frangia/uncertainty/conformity.h"

namespace frangia {

/// One arrangement and what was measured there.
struct ArrangementResult {
  std::string name;           ///< of the arrangement
  std::string scan;           ///< folder of its frames
  std::string frames_sha256;  ///< of the list of the frames' own checksums
  std::size_t frames = 0;     ///< files in that list
  MeasuredArtifact measured;  ///< at 20 degrees, see `at_reference_temperature`
};

/// A quantity of the test: the error that is farthest from zero, and the decision about it.
struct AcceptanceQuantity {
  std::string name;                ///< such as "probing size error"
  std::string symbol;              ///< of ISO 10360-13 where it has one
  bool is_form = false;            ///< a width, which has no sign
  double error_mm = 0.0;           ///< the worst of all arrangements, with its sign
  std::size_t arrangement = 0;     ///< where it was found, from 0
  double u95_mm = 0.0;             ///< expanded uncertainty of the test value
  std::optional<double> limit_mm;  ///< maximum permissible error; none: not judged
  /// By ISO 14253-1; `Undecided` without a limit, too.
  Conformity conformity = Conformity::Undecided;
};

/// The result of a test.
struct AcceptanceResult {
  std::vector<AcceptanceQuantity> quantities;  ///< form, size, and of a bar spacing and length
  std::vector<std::string> incomplete;         ///< what the test lacks of VDI/VDE 2634 part 3
  /// Out when a quantity is, in when all that have limits are; undecided without limits.
  Conformity conformity = Conformity::Undecided;
  bool judged = false;  ///< at least one quantity has a limit
};

/// Scales what was measured from the artifact's temperature to 20 degrees Celsius.
[[nodiscard]] MeasuredArtifact at_reference_temperature(MeasuredArtifact measured,
                                                        const AcceptancePlan& plan);

/// Gathers the errors of all arrangements and decides.
///
/// The uncertainty of a test value is that of the artifact: calibration, form and temperature. The
/// scanner's own noise is what is tested (ISO 23165).
/// @units    mm
/// @errors   Error(Input) without arrangements
/// @source   VDI/VDE 2634 part 3:2008; ISO 10360-13:2021; ISO 23165:2006
[[nodiscard]] AcceptanceResult acceptance_result(const AcceptancePlan& plan,
                                                 const std::vector<ArrangementResult>& results);

/// The result in one sentence.
[[nodiscard]] std::string sentence_of(const AcceptanceResult& result);

}  // namespace frangia
