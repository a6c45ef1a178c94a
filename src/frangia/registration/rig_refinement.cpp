#include "frangia/registration/rig_refinement.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace frangia {

std::string RigRefinement::text() const {
  const std::string scaled =
      scale == 1.0 ? std::string("; no surface determines the scale: a known length does")
                   : fmt::format("; the known length scales the rig by {:.6f}", scale);
  if (kept_rig) {
    return fmt::format(
               "the rig is kept: its surfaces agree to {:.3g} mm RMS, and no drift explains them "
               "better ({:.3g} mm)",
               rms_before_mm,
               rms_after_mm) +
           scaled;
  }
  std::vector<std::string> held_names;
  for (const RefinedParameter& parameter : parameters)
    if (!parameter.determined) held_names.push_back(parameter.name);
  std::string words = fmt::format(
      "the rig has drifted: its surfaces agree to {:.3g} mm RMS (before: {:.3g} mm); the part "
      "determines {} of {} independent changes, and the others are held",
      rms_after_mm,
      rms_before_mm,
      directions - held,
      directions);
  if (!beyond_prior.empty()) {
    words +=
        fmt::format("; farther from the rig's than a drift goes, so that they count as open: {}",
                    fmt::join(beyond_prior, ", "));
  }
  words += scaled;
  if (!held_names.empty()) {
    words += fmt::format("; not determined by themselves: {}", fmt::join(held_names, ", "));
  }
  return words;
}

}  // namespace frangia
