#include "frangia/registration/registration_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frangia/core/angles.h"

namespace frangia {

std::string RegistrationReport::text() const {
  if (kept_rig) {
    return fmt::format(
        "views agree to {:.4f} mm RMS with the rig's own axis and angles, which are kept: others "
        "fit "
        "no better; {:.0f} % of their points overlap",
        rms_after_mm,
        100.0 * overlap);
  }
  std::string words = fmt::format(
      "views agree to {:.4f} mm RMS (before: {:.3g} mm), {:.0f} % of their points overlap; the "
      "axis "
      "moved by {:.3f} mm and {:.3f} degrees, the angles by up to {:.3f} degrees",
      rms_after_mm,
      rms_before_mm,
      100.0 * overlap,
      axis_moved_mm(),
      deg_from_rad(axis_turned_rad()),
      deg_from_rad(largest_turn_rad()));
  if (!std::isnan(closure_after_rad)) {
    words += fmt::format("; the turn closes to {:.4f} degrees (before: {:.4f})",
                         std::abs(deg_from_rad(closure_after_rad)),
                         std::abs(deg_from_rad(closure_before_rad)));
  }
  if (!part_poses.empty()) {
    words +=
        fmt::format("; the part's pose in {} further setups is found with them", part_poses.size());
  }
  for (const std::string& unknown : undetermined) {
    words += fmt::format("; the part does not determine {}, which stays as the rig says", unknown);
  }
  return words;
}

double RegistrationReport::axis_moved_mm() const {
  return (table.point_mm - given.point_mm).norm();
}

double RegistrationReport::axis_turned_rad() const {
  return std::asin(std::min(1.0, given.axis.cross(table.axis).norm()));
}

double RegistrationReport::largest_turn_rad() const {
  double largest = 0.0;
  for (std::size_t i = 0; i < angles_rad.size(); ++i)
    largest = std::max(largest, std::abs(angles_rad[i] - given_angles_rad[i]));
  return largest;
}

}  // namespace frangia
