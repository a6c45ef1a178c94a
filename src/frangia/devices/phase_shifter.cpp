#include "frangia/devices/phase_shifter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

namespace frangia {

void PhaseShifter::set_fringe_frequency(double fringes_per_degree, const Deadline& /*deadline*/) {
  const double own = info().fringes_per_degree;
  if (own == 0.0 || std::abs(fringes_per_degree / own - 1.0) < 1e-6) return;
  fail_device(*this,
              fmt::format("its pitch is {:g} fringes per degree, but the pattern needs {:g}; "
                          "scan with patterns of its own pitch",
                          own,
                          fringes_per_degree));
}

void PhaseShifter::check_command(double command) const {
  if (command >= info().min_command && command <= info().max_command) return;
  fail_device(*this,
              fmt::format("{:.6g} {} is outside its range, {:.6g} to {:.6g}",
                          command,
                          info().unit,
                          info().min_command,
                          info().max_command));
}

void PhaseShiftController::return_to_start(const Deadline& deadline) {
  command_ = shifter_.info().min_command;
  shifter_.drive(command_, deadline);
  started_ = true;
}

void PhaseShiftController::shift_to(double shift_rad, const Deadline& deadline) {
  const PhaseCurve& curve = shifter_.info().curve;
  const double command = curve.command_for(curve.phases_rad.front() + scale_ * shift_rad);
  if (!started_ || command < command_) return_to_start(deadline);
  shifter_.drive(command, deadline);
  command_ = command;
}

namespace {

/// Linear interpolation of (xs, ys) at x, clamped; xs ascend.
double interpolate_linearly(const std::vector<double>& xs,
                            const std::vector<double>& ys,
                            double x) {
  const auto above = std::upper_bound(xs.begin() + 1, xs.end() - 1, x);
  const auto i = static_cast<std::size_t>(above - xs.begin());
  const double share = std::clamp((x - xs[i - 1]) / (xs[i] - xs[i - 1]), 0.0, 1.0);
  return ys[i - 1] + share * (ys[i] - ys[i - 1]);
}

bool strictly_increasing(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

}  // namespace

void PhaseCurve::check(const std::string& whose) const {
  const std::vector<double> back(phases_rad.rbegin(), phases_rad.rend());
  if (commands.size() >= 2 && commands.size() == phases_rad.size() &&
      strictly_increasing(commands) &&
      (strictly_increasing(phases_rad) || strictly_increasing(back))) {
    return;
  }
  throw Error(ErrorKind::Input,
              fmt::format("{}: a phase curve needs two points or more, rising commands and as many "
                          "phases that only rise or only fall; calibrate the phase shifter again",
                          whose));
}

double PhaseCurve::phase_at(double command) const {
  return interpolate_linearly(commands, phases_rad, command);
}

double PhaseCurve::command_for(double phase_rad) const {
  const bool rising = phases_rad.front() < phases_rad.back();
  const double low = std::min(phases_rad.front(), phases_rad.back());
  const double high = std::max(phases_rad.front(), phases_rad.back());
  double phase = phase_rad;
  if (phase < low) phase += kTwoPi * std::ceil((low - phase) / kTwoPi);
  if (phase > high) phase -= kTwoPi * std::ceil((phase - high) / kTwoPi);
  if (phase < low) {
    throw Error(ErrorKind::Input,
                fmt::format("the phase curve spans {:.1f} degrees and cannot reach a shift of "
                            "{:.1f}; widen the range of the phase shifter",
                            deg_from_rad(high - low),
                            deg_from_rad(phase_rad)));
  }
  if (rising) return interpolate_linearly(phases_rad, commands, phase);
  const std::vector<double> phases(phases_rad.rbegin(), phases_rad.rend());
  const std::vector<double> reversed(commands.rbegin(), commands.rend());
  return interpolate_linearly(phases, reversed, phase);
}

PhaseCurve read_phase_curve(DeviceSettings& settings, double min_command, double max_command) {
  PhaseCurve curve;
  if (settings.has("curve_commands")) {
    curve.commands = settings.numbers("curve_commands");
    for (const double phase_deg : settings.numbers("curve_phases_deg"))
      curve.phases_rad.push_back(rad_from_deg(phase_deg));
  } else {
    const double per_turn = settings.number("command_per_turn");
    if (per_turn == 0.0)
      settings.fail("command_per_turn", "is 0; it must be the command for one turn of phase");
    curve.commands = {min_command, max_command};
    curve.phases_rad = {0.0, kTwoPi * (max_command - min_command) / per_turn};
  }
  curve.check(fmt::format("{}: devices.{}", settings.file().string(), settings.device()));
  return curve;
}

}  // namespace frangia
