#include "frangia/devices/line_switch.h"

#include <utility>

namespace frangia {

LineSwitch::LineSwitch(LineInstrument line,
                       std::vector<std::string> on,
                       std::vector<std::string> off,
                       const Deadline& deadline)
    : line_(std::move(line)), on_(std::move(on)), off_(std::move(off)) {
  set(false, deadline);
}

LineSwitch::~LineSwitch() {
  make_safe();
}

std::string LineSwitch::test(const Deadline& deadline) {
  return line_.identify(deadline);
}

void LineSwitch::make_safe() noexcept {
  line_.send_at_the_end(off_);
  is_on_ = false;
}

void LineSwitch::set(bool on, const Deadline& deadline) {
  is_on_ = true;  // for all that is known, until off was taken
  for (const std::string& command : on ? on_ : off_)
    line_.send(command, deadline);
  is_on_ = on;
}

}  // namespace frangia
