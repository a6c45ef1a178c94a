#include "frangia/devices/phase_shifter.h"

#include <cmath>

#include <fmt/format.h>

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

}  // namespace frangia
