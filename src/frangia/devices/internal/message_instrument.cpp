#include "frangia/devices/internal/message_instrument.h"

#include <utility>

#include <fmt/format.h>

namespace frangia {

MessageInstrument::MessageInstrument(std::unique_ptr<Transport> transport, Language language)
    : transport_(std::move(transport)), language_(std::move(language)) {}

void MessageInstrument::send(const std::string& command, const Deadline& deadline) {
  transport_->write(command + language_.terminator, deadline);
  if (language_.error_query.empty()) return;
  const std::string answer = ask(language_.error_query, deadline);
  const std::size_t sign = answer.rfind('+', 0) == 0 ? 1 : 0;  // some answer +0,"No error"
  if (answer.compare(sign, language_.no_error.size(), language_.no_error) != 0) {
    fail_device(
        name(),
        fmt::format("reports {} after '{}'; check the command", printable(answer), command));
  }
}

std::string MessageInstrument::ask(const std::string& question, const Deadline& deadline) {
  transport_->write(question + language_.terminator, deadline);
  return read_line(*transport_, deadline);
}

std::string MessageInstrument::identify(const Deadline& deadline) {
  if (language_.identify.empty()) return "open; it cannot identify itself";
  return printable(ask(language_.identify, deadline));
}

void MessageInstrument::send_unchecked(const std::vector<std::string>& commands) noexcept {
  try {
    for (const std::string& command : commands)
      transport_->write(command + language_.terminator, Deadline::in(1.0));
  } catch (const Error&) {  // NOLINT(bugprone-empty-catch) the line is broken
  }
}

}  // namespace frangia
