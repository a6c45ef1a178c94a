#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace frangia {

/// One of OpenCV's predefined dictionaries of square markers, such as DICT_5X5_100.
struct ArucoDictionary {
  int cells = 0;    ///< white or black cells along a side, without the black border of one cell
  int markers = 0;  ///< number of markers
};

/// The dictionary of a name, of 4x4 to 7x7 cells with 50, 100 or 250 markers: "DICT_4X4_50" to
/// "DICT_7X7_250". None for another name.
///
/// @source   Garrido-Jurado et al. 2014, Automatic generation and detection of highly reliable
///           fiducial markers; the bits are those of OpenCV
[[nodiscard]] std::optional<ArucoDictionary> find_aruco_dictionary(const std::string& name);

/// The cells of a marker, row by row, the first in the highest of `cells * cells` bits; 1 is white.
///
/// @errors   Error(Input) for a marker that the dictionary does not have
[[nodiscard]] std::uint64_t aruco_bits(const ArucoDictionary& dictionary, int marker);

}  // namespace frangia
