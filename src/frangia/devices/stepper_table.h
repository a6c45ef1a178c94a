#pragma once

#include <limits>
#include <memory>
#include <optional>

#include "frangia/devices/table_firmware.h"

namespace frangia {

struct StepperTableOptions {
  double units_per_degree = 1.0;  ///< the board's units for a degree of the table
  bool reversed = false;          ///< the board's positive turns the table the negative way
  bool home_switch = false;       ///< else home is where the table stands
  double backlash_deg = 0.0;  ///< every stop is reached upwards, from this far below after a way
                              ///< down, which may be beyond `least_deg`
  double speed_deg_per_s = 20.0;
  double least_deg = -std::numeric_limits<double>::infinity();  ///< cables and clamps forbid more
  double most_deg = std::numeric_limits<double>::infinity();
  double settle_s = 0.0;  ///< how long the part swings after standstill
};

/// A turntable on a stepper motor board. Its angle is known after `home` only, and is lost by any
/// call that fails: it then refuses to move until it is homed again, rather than go on from where
/// it may not be.
///
/// units    rad
/// errors   Error(Device) from the board, or when the angle is not known; Error(Input) when it is
///          beyond the limits or not a number, and then nothing has moved
class StepperTable {
 public:
  explicit StepperTable(std::unique_ptr<TableFirmware> firmware,
                        const StepperTableOptions& options = {});
  StepperTable(const StepperTable&) = delete;
  StepperTable& operator=(const StepperTable&) = delete;
  StepperTable(StepperTable&&) = delete;
  StepperTable& operator=(StepperTable&&) = delete;
  /// Leaves the board stopped and its outputs off.
  ~StepperTable();

  void connect(const Deadline& deadline) { firmware_->connect(deadline); }
  void home(const Deadline& deadline);
  /// Returns when the table stands there and has settled.
  void move_to(double angle_rad, const Deadline& deadline);
  void stop() noexcept;
  [[nodiscard]] std::optional<double> angle_rad() const { return angle_rad_; }
  [[nodiscard]] TableFirmware& firmware() { return *firmware_; }

 private:
  void go_to(double angle_deg, const Deadline& deadline);

  std::unique_ptr<TableFirmware> firmware_;
  StepperTableOptions options_;
  std::optional<double> angle_rad_;
  bool pushed_up_ = false;  ///< the last move took the slack up
};

}  // namespace frangia
