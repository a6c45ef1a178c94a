#include "frangia/registration/registration_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frangia/core/angles.h"

namespace frangia {

namespace {

std::string text_of(const TurntableSigma& sigma) {
  return fmt::format("axis {:.2g} mm and {:.2g}°, angles {:.2g}°",
                     sigma.point_mm,
                     deg_from_rad(sigma.axis_rad),
                     deg_from_rad(sigma.angle_rad));
}

std::string residual_text(const RegistrationReport& report) {
  const double overlap_percent = 100.0 * report.overlap;
  if (!report.untrusted_reason().empty()) {
    return fmt::format("the registration is not trustworthy: {}; {:.0f} % of the points overlap",
                       report.untrusted_reason(),
                       overlap_percent);
  }
  if (report.kept_rig) {
    return fmt::format(
        "views agree to {:.3g} mm RMS with the rig's own axis and angles, which are kept because "
        "no others fit better; {:.0f} % of the points overlap",
        report.rms_after_mm,
        overlap_percent);
  }
  return fmt::format(
      "views agree to {:.3g} mm RMS (before: {:.3g} mm), {:.0f} % of the points "
      "overlap",
      report.rms_after_mm,
      report.rms_before_mm,
      overlap_percent);
}

}  // namespace

std::string RegistrationReport::untrusted_reason() const {
  constexpr double kContradicts = 3.0;  // standard deviations of a median, which noise never gives
  if (trustworthy && disagreement_over_sigma > kContradicts) {
    return fmt::format(
        "where the views overlap, they disagree by {:.2g} mm, {:.1f} times what noise and the "
        "standard deviations of the turntable ({}) explain: calibrate the turntable",
        disagreement_mm,
        disagreement_over_sigma,
        text_of(sigma));
  }
  if (trustworthy) {
    const std::size_t views = given_angles_rad.size();
    if (4 * outliers.size() <= views) return {};
    return fmt::format(
        "{} of {} views are left out, more than a quarter: what the surface shows is not the whole "
        "scan",
        outliers.size(),
        views);
  }
  return fmt::format(
      "the views contradict each other, up to {:.0f} % of a view's points lie in front of the "
      "surface that another view measured: either the part moved between views, or the rig's "
      "calibration is wrong",
      100.0 * contradiction);
}

std::string RegistrationReport::rig_alone_text() const {
  std::string words =
      "the axis and angles of the rig are kept, and the places of the views rest on them alone: ";
  const bool exact = sigma.point_mm == 0.0 && sigma.axis_rad == 0.0 && sigma.angle_rad == 0.0;
  words += exact ? "[turntable] of rig.toml states that they are exact"
                 : fmt::format("sigma counts {} as their standard deviations", text_of(sigma));
  if (!sigma.stated) {
    words +=
        ", because rig.toml does not state point_sigma_mm, axis_sigma_deg and angle_sigma_deg of "
        "[turntable]";
  }
  if (std::isnan(disagreement_over_noise)) return words + "; nothing verifies them";
  return words + fmt::format(
                     "; where the views overlap, they disagree by {:.2g} mm, {:.1f} times "
                     "their noise",
                     disagreement_mm,
                     disagreement_over_noise);
}

std::string RegistrationReport::text() const {
  std::string words = residual_text(*this);
  if (!explanation.text.empty() && untrusted_reason().empty())
    words = explanation.text + "; " + words;
  if (kept_rig) return words;
  words += fmt::format(
      "; the axis moved by {:.3g} mm and {:.3f} degrees, the angles by up to {:.3f} degrees",
      axis_moved_mm(),
      deg_from_rad(axis_turned_rad()),
      deg_from_rad(largest_turn_rad()));
  if (!std::isnan(closure_after_rad)) {
    words += fmt::format("; the full turn closes to {:.4f} degrees (before: {:.4f})",
                         std::abs(deg_from_rad(closure_after_rad)),
                         std::abs(deg_from_rad(closure_before_rad)));
  }
  if (!part_poses.empty()) {
    words += part_poses.size() == 1
                 ? std::string("; the part pose of 1 further setup is refined with them")
                 : fmt::format("; the part poses of {} further setups are refined with them",
                               part_poses.size());
  }
  for (const std::string& unknown : undetermined)
    words += fmt::format("; the part does not determine {}, so the rig's values stay", unknown);
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
