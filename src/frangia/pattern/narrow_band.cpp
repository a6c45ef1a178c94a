#include "frangia/pattern/narrow_band.h"

#include <cmath>

#include "frangia/core/error.h"
#include "frangia/pattern/order_confusion.h"

namespace frangia {

SequencePlan plan_narrow_band(double fringes, int maps, double sigma_rad, double max_wrong_order) {
  constexpr double kStep = 0.02;
  constexpr double kLowest = 0.5;  // of `fringes`
  for (double band = kStep; band < kLowest; band += kStep) {
    const double lowest = std::floor((1.0 - band) * fringes);
    if (!(lowest >= 1.0 && lowest <= fringes - maps + 1.0)) continue;  // too few whole counts
    try {
      return plan_beats(fringes, maps, lowest, sigma_rad, max_wrong_order);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::Input) throw;
    }
  }
  return plan_beats(fringes, maps, std::floor(kLowest * fringes), sigma_rad, max_wrong_order);
}

}  // namespace frangia
