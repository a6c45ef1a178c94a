#include "frangia/devices/internal/instrument_shifter.h"

#include <utility>

#include <fmt/format.h>

namespace frangia {

InstrumentShifter::InstrumentShifter(std::unique_ptr<Transport> transport,
                                     ActuatorProtocol protocol,
                                     ShifterInfo info,
                                     double settle_s,
                                     const Deadline& deadline)
    : instrument_(std::move(transport), protocol.language),
      protocol_(std::move(protocol)),
      info_(std::move(info)),
      settle_s_(settle_s) {
  static_cast<void>(fill_command(protocol_.set, info_.min_command));
  instrument_.clear_errors(deadline);
}

InstrumentShifter::~InstrumentShifter() {
  make_safe();
}

std::string InstrumentShifter::test(const Deadline& deadline) {
  return instrument_.identify(deadline);
}

void InstrumentShifter::make_safe() noexcept {
  started_ = false;
  instrument_.send_unchecked(protocol_.stop);
}

void InstrumentShifter::drive(double command, const Deadline& deadline) {
  check_command(command);
  if (!started_) start(deadline);
  instrument_.send(fill_command(protocol_.set, command), deadline);
  if (!protocol_.settled_query.empty()) wait_until_settled(deadline);
  deadline.sleep(settle_s_);
}

void InstrumentShifter::start(const Deadline& deadline) {
  instrument_.clear_errors(deadline);  // a stop may be reported as an error
  for (const std::string& command : protocol_.start)
    instrument_.send(command, deadline);
  started_ = true;
}

void InstrumentShifter::wait_until_settled(const Deadline& deadline) {
  bool answered = false;
  try {
    while (instrument_.ask(protocol_.settled_query, deadline) != protocol_.settled_answer) {
      answered = true;
      deadline.sleep(0.005);
    }
  } catch (const Error& error) {
    // A query that the deadline interrupts is not the cause.
    if (!answered || error.kind() != ErrorKind::Device || !deadline.passed()) throw;
    fail_device(*this, fmt::format("has not settled within {:.3g} s", deadline.timeout_s));
  }
}

}  // namespace frangia
