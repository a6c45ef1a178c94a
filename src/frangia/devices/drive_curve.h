#pragma once

#include <vector>

namespace frangia {

/// Which volts make which phase: measured points, straight between them, as `frangia calibrate
/// piezo` finds them. A phase shifter's settings hold it as `curve_deg` and `curve_v`.
///
/// units    rad, volts; both rise strictly
/// errors   Error(Input) for fewer than two points, or points that do not rise
class DriveCurve {
 public:
  DriveCurve(std::vector<double> phase_rad, std::vector<double> volts);

  /// errors   Error(Input) outside of the points, with the range that they span in degrees
  [[nodiscard]] double volts_at(double phase_rad) const;
  /// Beyond the ends the last stretch goes on straight.
  [[nodiscard]] double phase_at(double volts) const;

  [[nodiscard]] const std::vector<double>& phase_rad() const { return phase_rad_; }
  [[nodiscard]] const std::vector<double>& volts() const { return volts_; }

 private:
  std::vector<double> phase_rad_;
  std::vector<double> volts_;
};

}  // namespace frangia
