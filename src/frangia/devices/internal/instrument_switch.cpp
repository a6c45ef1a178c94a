#include "frangia/devices/internal/instrument_switch.h"

#include <utility>

namespace frangia {

InstrumentSwitch::InstrumentSwitch(MessageInstrument line,
                                   std::vector<std::string> on,
                                   std::vector<std::string> off,
                                   const Deadline& deadline)
    : instrument_(std::move(line)), on_(std::move(on)), off_(std::move(off)) {
  instrument_.send_unchecked(off_);
  instrument_.clear_errors(deadline);
  set(false, deadline);
}

InstrumentSwitch::~InstrumentSwitch() {
  make_safe();
}

std::string InstrumentSwitch::test(const Deadline& deadline) {
  return instrument_.identify(deadline);
}

void InstrumentSwitch::make_safe() noexcept {
  instrument_.send_unchecked(off_);
  is_on_ = false;
}

void InstrumentSwitch::set(bool on, const Deadline& deadline) {
  is_on_ = true;  // assume on until off is acknowledged
  for (const std::string& command : on ? on_ : off_)
    instrument_.send(command, deadline);
  is_on_ = on;
}

}  // namespace frangia
