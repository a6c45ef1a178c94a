#include "frangia/pipeline/indirect_light_report.h"

#include <fmt/format.h>

namespace frangia {

std::string IndirectLightReport::text() const {
  const std::string found = fmt::format(
      "indirect light: the part lights its own concave sides (reflectance {:.2f}); the depth is "
      "corrected by what the surface predicts, and up to {:.4f} mm remain in sigma, more than half "
      "of "
      "the noise at {:.0f} % of the points",
      albedo,
      largest_mm,
      100.0 * affected);
  if (!is_large()) return found;
  return found + "; project only fine fringes, as a plan for indirect light proposes";
}

}  // namespace frangia
