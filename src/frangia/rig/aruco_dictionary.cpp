#include "frangia/rig/aruco_dictionary.h"

#include <array>
#include <span>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/rig/internal/aruco_bits.h"

namespace frangia {

std::optional<ArucoDictionary> find_aruco_dictionary(const std::string& name) {
  for (const int cells : {4, 5, 6, 7}) {
    for (const int markers : {50, 100, 250}) {
      if (name == fmt::format("DICT_{}X{}_{}", cells, cells, markers))
        return ArucoDictionary{cells, markers};
    }
  }
  return std::nullopt;
}

std::uint64_t aruco_bits(const ArucoDictionary& dictionary, int marker) {
  const std::array<std::span<const std::uint64_t>, 4> tables = {kAruco4, kAruco5, kAruco6, kAruco7};
  require(
      marker >= 0 && marker < dictionary.markers && dictionary.cells >= 4 && dictionary.cells <= 7,
      "the dictionary does not have that marker");
  return tables.at(
      static_cast<std::size_t>(dictionary.cells - 4))[static_cast<std::size_t>(marker)];
}

}  // namespace frangia
