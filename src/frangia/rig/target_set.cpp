#include "frangia/rig/target_set.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/rig/aruco_dictionary.h"

namespace frangia {
namespace {

void check_coded(const TargetSet& targets) {
  if (targets.dictionary.empty()) {
    require(targets.marker_mm == 0.0,
            "marker_mm is the size of coded targets: give their dictionary, one of DICT_4X4_50 to "
            "DICT_7X7_250");
    require(targets.distances.empty(),
            "known distances are between coded targets: give their dictionary and marker_mm");
    return;
  }
  const auto dictionary = find_aruco_dictionary(targets.dictionary);
  if (!dictionary) {
    throw Error(ErrorKind::Input,
                fmt::format("the dictionary \"{}\" is unknown; it must be one of DICT_4X4_50 to "
                            "DICT_7X7_250",
                            targets.dictionary));
  }
  require(targets.marker_mm > 0.0,
          "the size of the coded targets is unknown: give marker_mm, the side of a marker's black "
          "square");
  for (const KnownTargetDistance& known : targets.distances) {
    for (const int code : {known.first, known.second}) {
      if (code >= 0 && code < dictionary->markers) continue;
      throw Error(ErrorKind::Input,
                  fmt::format("a known distance names target {}, but {} has the codes 0 to {}",
                              code,
                              targets.dictionary,
                              dictionary->markers - 1));
    }
    require(known.first != known.second, "a known distance names one target twice; name two");
    require(known.distance_mm > 0.0 && known.sigma_mm > 0.0,
            "a known distance and its sigma_mm must be above 0");
  }
}

}  // namespace

double sticker_diameter_mm(const TargetSet& targets, bool coded) {
  const double printed = coded ? std::sqrt(2.0) * targets.marker_mm : targets.diameter_mm;
  return std::max(printed, targets.sticker_mm);
}

bool is_target_dark(const TargetSet& targets, int code, double x_mm, double y_mm) {
  const bool dark_ground = code < 0 && targets.tone == TargetTone::Light;
  const double radius_mm = std::hypot(x_mm, y_mm);
  if (code < 0) return (radius_mm < 0.5 * targets.diameter_mm) != dark_ground;
  const double side = targets.marker_mm;
  if (std::max(std::abs(x_mm), std::abs(y_mm)) >= 0.5 * side) return false;
  const ArucoDictionary dictionary = find_aruco_dictionary(targets.dictionary).value();
  const int all = dictionary.cells + 2;
  const int column = std::min(all - 1, static_cast<int>((x_mm / side + 0.5) * all)) - 1;
  const int row = std::min(all - 1, static_cast<int>((y_mm / side + 0.5) * all)) - 1;
  if (std::min(column, row) < 0 || std::max(column, row) >= dictionary.cells) return true;
  const auto bit = static_cast<unsigned>(dictionary.cells * dictionary.cells - 1 -
                                         (row * dictionary.cells + column));
  return (aruco_bits(dictionary, code) >> bit & 1U) == 0;
}

void check_targets(const TargetSet& targets) {
  require(targets.diameter_mm >= 0.0 && targets.marker_mm >= 0.0 && targets.sticker_mm >= 0.0,
          "sizes of targets must not be negative");
  require(
      targets.diameter_mm > 0.0 || !targets.dictionary.empty() || targets.marker_mm > 0.0,
      "the size of the targets is unknown: give diameter_mm of the discs of uncoded targets, or "
      "dictionary and marker_mm of coded ones");
  check_coded(targets);
}

}  // namespace frangia
