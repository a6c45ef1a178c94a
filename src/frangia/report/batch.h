#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frangia/core/missing.h"
#include "frangia/inspection/measured_characteristics.h"

namespace frangia {

/// The results of one part of a batch.
struct BatchPart {
  std::string name;                          ///< of its mesh
  std::vector<MeasuredCharacteristic> rows;  ///< the same characteristics for each part
  /// About the part, by its surface and its characteristics.
  Conformity verdict = Conformity::Undecided;
  std::string reason;     ///< of the verdict, or why it was not inspected; may be empty
  bool inspected = true;  ///< false: it has neither rows nor a verdict
};

/// A characteristic over all parts of a batch.
struct BatchCharacteristic {
  std::string name;                       ///< of the plan
  std::string unit;                       ///< mm or degrees
  std::optional<ToleranceLimits> limits;  ///< of the value
  std::vector<double> values;             ///< one for each part; NaN where it was not found
  std::vector<double> u95;                ///< as `values`
  double mean = kMissing;                 ///< of the values that were found
  double deviation = kMissing;            ///< standard deviation of the values; needs two
  /// Process capability: (upper - lower) / 6 s, and the distance of the mean from the nearer limit
  /// over 3 s. NaN without the limits that they need, or below two values.
  double cp = kMissing;
  double cpk = kMissing;  ///< see `cp`; of one-sided limits, too
  /// The Cpk that the process exceeds with a probability of 95 %: of few parts it lies far below,
  /// and negative where they prove nothing.
  double cpk_lower_95 = kMissing;
};

/// Gathers the characteristics of a batch.
///
/// @missing  those of a part that was not inspected are NaN
/// @errors   Error(Input) when the parts do not have the same characteristics
/// @source   ISO 22514-2; Bissell 1990 for the lower limit of Cpk; the standard deviation contains
/// the uncertainty of the measurement
[[nodiscard]] std::vector<BatchCharacteristic> batch_characteristics(
    const std::vector<BatchPart>& parts);

/// A table with a line for each part, with its verdict and the reason, and lines of mean, standard
/// deviation, Cp and Cpk.
[[nodiscard]] std::string batch_csv(const std::vector<BatchPart>& parts,
                                    const std::vector<BatchCharacteristic>& characteristics);

/// The batch as one page of HTML: the table, why parts are not in, and a trend plot for each
/// characteristic.
[[nodiscard]] std::string batch_html(const std::string& title,
                                     const std::vector<BatchPart>& parts,
                                     const std::vector<BatchCharacteristic>& characteristics);

}  // namespace frangia
