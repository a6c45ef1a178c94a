#include "frangia/devices/internal/board_switch.h"

#include <utility>

namespace frangia {

BoardSwitch::BoardSwitch(std::shared_ptr<MotionController> board, std::string on, std::string off)
    : board_(std::move(board)), on_command_(std::move(on)), off_command_(std::move(off)) {
  board_->add_off_command(off_command_);
}

BoardSwitch::~BoardSwitch() {
  make_safe();
}

std::string BoardSwitch::test(const Deadline& deadline) {
  return board_->identify(deadline);
}

void BoardSwitch::make_safe() noexcept {
  constexpr double kAnswer_s = 0.3;  // boards at rest answer within 10 ms
  const std::scoped_lock lock(board_->mutex());
  if (!is_on()) return;
  try {
    set(false, Deadline::in(kAnswer_s));
  } catch (const Error&) {
    board_->stop();
    on_ = false;
  }
}

void BoardSwitch::set(bool on, const Deadline& deadline) {
  stop_count_ = board_->stop_count();
  on_ = true;  // assume on until the board acknowledges off
  board_->command(on ? on_command_ : off_command_, deadline);
  on_ = on;
}

}  // namespace frangia
