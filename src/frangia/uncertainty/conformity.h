#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "frangia/core/enum_names.h"

namespace frangia {

/// Whether a value conforms to its tolerance when its uncertainty counts.
enum class Conformity : std::uint8_t {
  In,        ///< proven to be within the limits
  Out,       ///< proven to be beyond a limit
  Undecided  ///< within the uncertainty of a limit
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(Conformity /*any*/) {
  return EnumNames<Conformity, 3>{
      {{Conformity::In, "in"}, {Conformity::Out, "out"}, {Conformity::Undecided, "undecided"}}};
}

/// Limits of a value.
struct ToleranceLimits {
  double lower = 0.0;  ///< least value in tolerance
  double upper = 0.0;  ///< largest value in tolerance

  /// @errors   Error(Input) when a limit is not finite or `lower` is not below `upper`
  void check() const;
};

/// Factor of the standard uncertainty between a limit and the values that are proven to lie on one
/// side of it, for an error probability of 5 %.
inline constexpr double kGuardBand = 1.6448536269514722;

/// Decides by the rule of ISO 14253-1: a value is in when it lies inside of the limits by the guard
/// band, and out when it lies beyond one by as much.
///
/// @units    those of the value
/// @missing  undecided when the value or its uncertainty is NaN
/// @source   ISO 14253-1:2017, 5.2 and 5.3, with the default probability of 95 %
[[nodiscard]] Conformity conformity_of(double value,
                                       double standard_uncertainty,
                                       const ToleranceLimits& limits,
                                       double guard_band = kGuardBand);

/// The guard band for `count` values of which, with a probability of 95 %, none is called out
/// when all are in.
///
/// @source   Bonferroni's inequality
[[nodiscard]] double guard_band_of_many(std::size_t count);

}  // namespace frangia
