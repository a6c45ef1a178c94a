#include "frangia/phase/internal/is_split.h"

#include <cmath>
#include <cstddef>

namespace frangia {

bool is_split(std::span<const double> places) {
  constexpr std::size_t kBeside = 5;  // pixels on both sides that belong to the surface
  constexpr double kSameSide = 0.2;   // of the field
  constexpr double kAtTheEnd = 0.05;  // of the field: what two neighbouring pixels span
  for (std::size_t x = kBeside; x + kBeside + 1 < places.size(); ++x) {
    const double jump = std::abs(places[x] - places[x + 1]);
    if (std::abs(jump - 1.0) < kAtTheEnd && std::abs(places[x] - places[x - kBeside]) < kSameSide &&
        std::abs(places[x + 1] - places[x + 1 + kBeside]) < kSameSide)
      return true;
  }
  return false;
}

}  // namespace frangia
