#pragma once

#include <string>
#include <vector>

#include "frangia/inspection/measured_characteristics.h"

namespace frangia {

/// What a QIF document states about one inspection.
struct QifResults {
  std::vector<NamedFeature> features;                   ///< that the plan names and that were found
  std::vector<MeasuredCharacteristic> characteristics;  ///< those without limits are left out
  Conformity verdict = Conformity::Undecided;           ///< about the part
};

/// Returns the results as a document of QIF 3.0 (ANSI/DMSC, ISO 23952:2020): the definitions,
/// nominals and items of the characteristics, and one MeasurementResults with the features and the
/// characteristics that were measured.
///
/// Undecided characteristics have the status INDETERMINATE, those that were not found NOT_ANALYZED;
/// an undecided part has the status UNKNOWN. `combinedUncertainty` is a standard uncertainty. The
/// document's identifier follows from its contents: the same results give the same bytes.
/// @units    mm, degrees
/// @missing  planes, cylinders and spheres have a place and a size; other features a name alone
[[nodiscard]] std::string qif_of(const QifResults& results);

}  // namespace frangia
