#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "frangia/core/enum_names.h"
#include "frangia/inspection/inspect_part.h"

namespace frangia {

/// What a scan needs so that an inspection can decide.
enum class ScanNeed : std::uint8_t {
  Nothing,     ///< all is decided
  Coverage,    ///< surface or features that no station saw
  Noise,       ///< more light, finer fringes or more frames
  Calibration  ///< a smaller systematic uncertainty, which no further frame gives
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(ScanNeed /*any*/) {
  return EnumNames<ScanNeed, 4>{{{ScanNeed::Nothing, "nothing"},
                                 {ScanNeed::Coverage, "coverage"},
                                 {ScanNeed::Noise, "noise"},
                                 {ScanNeed::Calibration, "calibration"}}};
}

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

/// How far an inspection decides what a plan asks for.
struct ScanReach {
  ScanNeed need = ScanNeed::Coverage;  ///< what lacks most
  double decidable_share = 0.0;  ///< of the nominal area: measured well enough; 0 without a surface
  std::size_t decidable = 0;     ///< characteristics with a tolerance that are measured well enough
};

/// How far an inspection decides. A characteristic counts as decided when it is out, or when its
/// U95 is within the share of its tolerance that the plan allows.
[[nodiscard]] ScanReach reach_of(const Inspection& part, double max_uncertainty_share);

/// Whether one scan decides clearly more than another.
[[nodiscard]] bool decides_more(const ScanReach& one, const ScanReach& other);

}  // namespace frangia
