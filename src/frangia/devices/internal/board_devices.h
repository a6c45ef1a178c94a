#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "frangia/devices/device.h"
#include "frangia/devices/internal/motion_controller.h"
#include "frangia/devices/turntable_device.h"

namespace frangia {

struct StepperTurntableOptions {
  TurntableInfo info;
  double units_per_degree = 1.0;  ///< units of the board per degree of the table
  bool reversed = false;      ///< positive motion of the board is negative rotation of the table
  double backlash_deg = 0.0;  ///< targets are approached upwards; after a downward move from this
                              ///< far below, which may be beyond the limits
  double speed_deg_per_s = 20.0;
  double settle_s = 0.0;      ///< time for the part to stop vibrating
  double home_time_s = 60.0;  ///< expected duration of homing, for boards that do not report it
};

/// A turntable on a stepper motor board. Any failed call stops the board and invalidates the angle;
/// the table then refuses to move until it is homed.
class StepperTurntable final : public TurntableDevice {
 public:
  /// `board` is already connected; lamps may share it.
  explicit StepperTurntable(std::shared_ptr<MotionController> board,
                            const StepperTurntableOptions& options = {});
  StepperTurntable(const StepperTurntable&) = delete;
  StepperTurntable& operator=(const StepperTurntable&) = delete;
  StepperTurntable(StepperTurntable&&) = delete;
  StepperTurntable& operator=(StepperTurntable&&) = delete;
  ~StepperTurntable() override;

  [[nodiscard]] std::string name() const override { return "turntable at " + board_->name(); }
  [[nodiscard]] std::string test(const Deadline& deadline) override;
  [[nodiscard]] std::vector<std::string> take_warnings() override {
    return std::exchange(warnings_, {});
  }
  void make_safe() noexcept override;
  [[nodiscard]] std::optional<SafeOff> safe_off() const override { return board_->safe_off(); }
  [[nodiscard]] const TurntableInfo& info() const override { return options_.info; }
  void enable(bool on, const Deadline& deadline) override;
  void home(const Deadline& deadline) override;
  void set_angle(double angle_rad, const Deadline& deadline) override;
  [[nodiscard]] std::optional<double> angle_rad() const override;
  void move_to(double angle_rad, const Deadline& deadline) override;
  [[nodiscard]] double move_time_s(double angle_rad) const override;
  [[nodiscard]] double home_time_s() const override;

 private:
  void check_target(double angle_rad) const;
  void command_angle(double angle_deg, const Deadline& deadline);

  std::shared_ptr<MotionController> board_;
  StepperTurntableOptions options_;
  std::vector<std::string> warnings_;
  std::optional<double> angle_rad_;
  double zero_deg_ = 0.0;  ///< angle at the board's position 0
  int stop_count_ = 0;     ///< of the board when the angle was found
  bool enabled_ = false;
  bool backlash_taken_up_ = false;  ///< the last move ended upwards
};

/// A lamp or laser on an output of the turntable board: spindle (M3, M5) or coolant (M8, M9) of
/// GRBL, a laser of the Ciclop (M71T1, M70T1). When switching off fails, the board is stopped.
class BoardSwitch final : public SwitchDevice {
 public:
  BoardSwitch(std::shared_ptr<MotionController> board, std::string on, std::string off);
  BoardSwitch(const BoardSwitch&) = delete;
  BoardSwitch& operator=(const BoardSwitch&) = delete;
  BoardSwitch(BoardSwitch&&) = delete;
  BoardSwitch& operator=(BoardSwitch&&) = delete;
  ~BoardSwitch() override;

  [[nodiscard]] std::string name() const override { return "light at " + board_->name(); }
  [[nodiscard]] std::string test(const Deadline& deadline) override;
  void make_safe() noexcept override;
  [[nodiscard]] std::optional<SafeOff> safe_off() const override { return board_->safe_off(); }
  void set(bool on, const Deadline& deadline) override;
  [[nodiscard]] bool is_on() const override { return on_ && stop_count_ == board_->stop_count(); }

 private:
  std::shared_ptr<MotionController> board_;
  std::string on_command_;
  std::string off_command_;
  int stop_count_ = 0;  ///< of the board when the light was set; a stop switches it off
  bool on_ = false;
};

}  // namespace frangia
