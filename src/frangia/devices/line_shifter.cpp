#include "frangia/devices/line_shifter.h"

#include <utility>

#include <fmt/format.h>

namespace frangia {

LineShifter::LineShifter(std::unique_ptr<Transport> transport,
                         ActuatorProtocol protocol,
                         ShifterInfo info,
                         double settle_s,
                         const Deadline& deadline)
    : line_(std::move(transport), protocol.language),
      protocol_(std::move(protocol)),
      info_(std::move(info)),
      settle_s_(settle_s) {
  static_cast<void>(fill_command(protocol_.set, info_.min_command));
  line_.discard_input();
  start(deadline);
}

LineShifter::~LineShifter() {
  make_safe();
}

std::string LineShifter::test(const Deadline& deadline) {
  return line_.identify(deadline);
}

void LineShifter::make_safe() noexcept {
  started_ = false;
  line_.send_at_the_end(protocol_.stop);
}

void LineShifter::drive(double command, const Deadline& deadline) {
  check_command(command);
  if (!started_) start(deadline);
  line_.send(fill_command(protocol_.set, command), deadline);
  if (!protocol_.settled_query.empty()) wait_until_settled(deadline);
  deadline.sleep(settle_s_);
}

void LineShifter::start(const Deadline& deadline) {
  for (const std::string& command : protocol_.start)
    line_.send(command, deadline);
  started_ = true;
}

void LineShifter::wait_until_settled(const Deadline& deadline) {
  bool answered = false;
  try {
    while (line_.ask(protocol_.settled_query, deadline) != protocol_.settled_answer) {
      answered = true;
      deadline.sleep(0.005);
    }
  } catch (const Error& error) {
    // The question that the deadline cuts off is not what is wrong.
    if (!answered || error.kind() != ErrorKind::Device || !deadline.passed()) throw;
    device_fault(*this, fmt::format("has not settled within {:.3g} s", deadline.given_s));
  }
}

}  // namespace frangia
