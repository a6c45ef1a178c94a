#include "frangia/scan_plan/scan_recipe.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/simulate/default_patterns.h"

namespace frangia {
namespace {

constexpr double kExposure_ms = 10.0;  ///< right for white; only the ratio of exposures matters

}  // namespace

std::vector<Pattern> ScanRecipe::patterns(const Rig& rig) const {
  PatternPlan plan;
  plan.shifts = shifts;
  plan.periods_px = periods_px;
  if (exposure > 1.0) plan.exposures_ms = {kExposure_ms, exposure * kExposure_ms};
  return default_patterns(rig, plan);
}

std::size_t ScanRecipe::frames(const Rig& rig) const {
  int of_view = 0;
  for (const Pattern& pattern : patterns(rig))
    of_view += pattern.frame_count() * pattern.exposure_count();
  return tilts_rad.size() * static_cast<std::size_t>(stations) * static_cast<std::size_t>(of_view);
}

std::string ScanRecipe::text() const {
  std::vector<std::string> tilts;
  for (const double tilt : tilts_rad)
    tilts.push_back(fmt::format("{:.0f}", deg_from_rad(tilt)));
  std::string text = fmt::format(
      "{} setup{}{}, {} stations each, {} shifts",
      tilts.size(),
      tilts.size() == 1 ? "" : "s",
      tilts.size() == 1 ? "" : fmt::format(" (tilted by {} degrees)", fmt::join(tilts, ", ")),
      stations,
      shifts);
  if (!periods_px.empty()) text += fmt::format(", periods {:.4g} px", fmt::join(periods_px, ", "));
  if (exposure > 1.0)
    text += fmt::format(", exposures of 1 and {:.3g} times that of white", exposure);
  return text;
}

}  // namespace frangia
