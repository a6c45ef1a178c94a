#include "frangia/indirect_light/indirect_light_report.h"

#include <fmt/format.h>

namespace frangia {

std::string IndirectLightReport::text() const {
  const std::string found = fmt::format(
      "indirect light: the part lights its own concave sides (reflectance {:.2f}); {} {:.4f} mm "
      "{} in sigma, more than half of the noise at {:.0f} % of the points",
      albedo,
      corrected ? "the depth is corrected by what the surface predicts, and up to"
                : "the depth is not corrected, and up to",
      largest_mm,
      corrected ? "remain" : "are counted",
      100.0 * affected);
  if (!is_large()) return found;
  return found + "; project only fine fringes, as a plan for indirect light proposes";
}

void announce(const IndirectLightReport& report, const Run& run) {
  if (report.is_large()) {
    run.warn(report.text());
  } else {
    run.note(report.text());
  }
}

}  // namespace frangia
