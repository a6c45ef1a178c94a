#include "frangia/devices/drive_curve.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

bool rises(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

/// y at x, straight between the points of (xs, ys) and beyond them.
double between(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  const auto above = std::upper_bound(xs.begin() + 1, xs.end() - 1, x);
  const auto i = static_cast<std::size_t>(above - xs.begin());
  const double part = (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
  return ys[i - 1] + part * (ys[i] - ys[i - 1]);
}

}  // namespace

DriveCurve::DriveCurve(std::vector<double> phase_rad, std::vector<double> volts)
    : phase_rad_(std::move(phase_rad)), volts_(std::move(volts)) {
  require(phase_rad_.size() == volts_.size() && volts_.size() >= 2,
          "a drive curve needs two or more points, as many degrees as volts");
  require(rises(phase_rad_) && rises(volts_),
          "a drive curve's degrees and volts must both rise from point to point");
}

double DriveCurve::volts_at(double phase_rad) const {
  constexpr double kRounding = 1e-9;
  if (phase_rad < phase_rad_.front() - kRounding || phase_rad > phase_rad_.back() + kRounding) {
    throw Error(ErrorKind::Input,
                fmt::format("a phase of {:.2f} degrees is outside of the phase shifter's curve, "
                            "which spans {:.2f} to {:.2f}; measure a longer one, or use fewer or "
                            "smaller shifts",
                            deg_from_rad(phase_rad),
                            deg_from_rad(phase_rad_.front()),
                            deg_from_rad(phase_rad_.back())));
  }
  return between(phase_rad_, volts_, phase_rad);
}

double DriveCurve::phase_at(double volts) const {
  return between(volts_, phase_rad_, volts);
}

}  // namespace frangia
