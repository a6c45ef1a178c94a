#include "frangia/registration/registration_report.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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

/// Largest angle between neighbouring views all around, without some of them.
double largest_gap_rad(std::vector<double> angles_rad) {
  if (angles_rad.size() < 2) return kTwoPi;
  for (double& angle : angles_rad)
    angle -= kTwoPi * std::floor(angle / kTwoPi);
  std::sort(angles_rad.begin(), angles_rad.end());
  double gap = angles_rad.front() + kTwoPi - angles_rad.back();
  for (std::size_t i = 1; i < angles_rad.size(); ++i)
    gap = std::max(gap, angles_rad[i] - angles_rad[i - 1]);
  return gap;
}

/// Why the views that remain do not show the part as the scan was planned; empty where they do.
std::string incomplete_reason(const RegistrationReport& report) {
  // A view shows surfaces that are turned away by up to 60 degrees to either side.
  constexpr double kSide = rad_from_deg(120.0);
  constexpr double kSame = 1e-6;
  const std::size_t views = report.given_angles_rad.size();
  if (4 * report.outliers.size() > views) {
    return fmt::format(
        "{} of {} views are left out, more than a quarter: what the surface shows is not the whole "
        "scan",
        report.outliers.size(),
        views);
  }
  if (report.outliers.empty() || !report.part_poses.empty()) return {};
  std::vector<double> left;
  for (std::size_t view = 0; view < views; ++view) {
    if (std::find(report.outliers.begin(), report.outliers.end(), view) == report.outliers.end())
      left.push_back(report.given_angles_rad[view]);
  }
  const double gap_rad = largest_gap_rad(std::move(left));
  if (gap_rad < kSide + kSame || gap_rad < largest_gap_rad(report.given_angles_rad) + kSame)
    return {};
  return fmt::format(
      "a whole side of the part is missing: without the views that are left out, no view looks "
      "from {:.0f}° of the turn",
      deg_from_rad(gap_rad));
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

/// What rests on the rig's statement alone, with its standard deviation; empty for nothing.
std::string stated_text(const RegistrationReport& report) {
  if (report.undetermined.empty()) return {};
  std::string list;  // "the angles of the views (0.05°)"
  for (const std::string& unknown : report.undetermined) {
    const bool length = unknown == kPositionOfAxis;
    const double sigma = length                   ? report.sigma.point_mm
                         : unknown == kTiltOfAxis ? deg_from_rad(report.sigma.axis_rad)
                                                  : deg_from_rad(report.sigma.angle_rad);
    const std::string stated =
        sigma > 0.0 ? fmt::format("{:.2g}{}", sigma, length ? " mm" : "°") : "stated as exact";
    list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", unknown, stated);
  }
  return fmt::format(
      "; the overlap of the views hardly shows {}: there what the rig states decides, and its "
      "standard deviation is in sigma",
      list);
}

}  // namespace

std::string RegistrationReport::untrusted_reason() const {
  constexpr double kContradicts = 3.0;  // standard deviations of a median, which noise never gives
  if (trustworthy && explanation.best == PoseCause::Unexplained) {
    return fmt::format(
        "the views disagree by {:.2g} mm, and no single cause explains it: the part moved before "
        "several views, or fringe orders are wrong",
        explanation.effect_mm);
  }
  if (trustworthy && disagreement_over_sigma > kContradicts) {
    return fmt::format(
        "where the views overlap, they disagree by {:.2g} mm, {:.1f} times what noise and the "
        "standard deviations of the turntable ({}) explain: calibrate the turntable",
        disagreement_mm,
        disagreement_over_sigma,
        text_of(sigma));
  }
  if (trustworthy) return incomplete_reason(*this);
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
  if (explanation.text.empty() || !untrusted_reason().empty()) return fit_text();
  return explanation.text + "; " + fit_text();
}

std::string RegistrationReport::fit_text() const {
  std::string words = residual_text(*this);
  if (kept_rig) return words + stated_text(*this);
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
