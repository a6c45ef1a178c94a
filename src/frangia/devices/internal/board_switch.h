#pragma once

#include <memory>
#include <string>

#include "frangia/devices/internal/motion_controller.h"
#include "frangia/devices/switch_device.h"

namespace frangia {

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
