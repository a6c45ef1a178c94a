#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frangia/core/enum_names.h"

namespace frangia {

/// Tone of the disc of a target against the ground around it.
enum class TargetTone : std::uint8_t {
  Dark,  ///< on a light part or sticker
  Light  ///< on a dark part or sticker
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(TargetTone /*any*/) {
  return EnumNames<TargetTone, 2>{{{TargetTone::Dark, "dark"}, {TargetTone::Light, "light"}}};
}

/// A distance between two coded targets that another instrument measured.
struct KnownTargetDistance {
  int first = 0;             ///< code
  int second = 0;            ///< code
  double distance_mm = 0.0;  ///< between their centres
  double sigma_mm = 0.0;     ///< standard uncertainty of the distance
};

/// Round stickers on a part or on what is fixed to it; the `[targets]` table of scan.toml.
///
/// Uncoded targets are discs; coded ones hold a square marker of a dictionary of OpenCV's ArUco.
struct TargetSet {
  double diameter_mm = 0.0;            ///< of the discs; 0: no uncoded targets
  TargetTone tone = TargetTone::Dark;  ///< of the discs
  std::string dictionary;              ///< of coded targets; empty: none
  double marker_mm = 0.0;              ///< side of the black square of a marker
  double sticker_mm = 0.0;  ///< diameter of the sticker, which is no part of the surface; 0: of
                            ///< what is printed
  std::vector<KnownTargetDistance> distances;  ///< which give the scale
};

/// Diameter of what hides the surface of the part at an uncoded target, or at a coded one.
///
/// @units    mm
[[nodiscard]] double sticker_diameter_mm(const TargetSet& targets, bool coded);

/// Whether a point of the plane of a target is dark.
///
/// @units    mm, from the centre
/// @missing  `code` below 0: an uncoded target
[[nodiscard]] bool is_target_dark(const TargetSet& targets, int code, double x_mm, double y_mm);

/// Checks the values of a set.
///
/// @errors   Error(Input) when no size is given, the dictionary is unknown, or a distance is not
///           between two different codes of the dictionary
void check_targets(const TargetSet& targets);

}  // namespace frangia
