#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frangia/inspection/inspect_part.h"

namespace frangia {

/// What a scan needs so that an inspection can decide.
enum class ScanNeed : std::uint8_t {
  Nothing,     ///< all is decided
  Coverage,    ///< surface or features that no station saw
  Noise,       ///< more light, finer fringes or more frames
  Calibration  ///< a smaller systematic uncertainty, which no further frame gives
};

/// The name in files: nothing, coverage, noise, calibration.
[[nodiscard]] std::string_view name_of(ScanNeed need);

/// How well a characteristic with a tolerance is measured.
struct DecidableCharacteristic {
  std::string name;           ///< of the plan, with the quantity
  std::string unit;           ///< mm or degrees
  double half_width = 0.0;    ///< of the tolerance; of an upper limit alone half of it
  double u95 = 0.0;           ///< NaN: it was not found
  bool is_decidable = false;  ///< `u95` is within the share of `half_width` that the plan allows
};

/// The characteristics of an inspection that have a tolerance, in the order of the plan.
[[nodiscard]] std::vector<DecidableCharacteristic> decidable_characteristics(
    const Inspection& part, double max_uncertainty_share);

/// What an inspection needs most. A characteristic counts as decided when it is out, or when its
/// U95 is within the share of its tolerance that the plan allows.
[[nodiscard]] ScanNeed need_of(const Inspection& part, double max_uncertainty_share);

}  // namespace frangia
