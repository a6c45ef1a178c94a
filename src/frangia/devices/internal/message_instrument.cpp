#include "frangia/devices/internal/message_instrument.h"

#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

/// For the error query after a query without an answer.
constexpr double kErrorQuery_s = 0.5;
/// SCPI instruments keep some tens of errors.
constexpr int kMostErrors = 64;

}  // namespace

MessageInstrument::MessageInstrument(std::unique_ptr<Transport> transport, Language language)
    : transport_(std::move(transport)), language_(std::move(language)) {}

void MessageInstrument::send(const std::string& command, const Deadline& deadline) {
  write(command, deadline);
  const std::string reported = query_error(deadline);
  if (!reported.empty()) fail_with(reported, command);
}

std::string MessageInstrument::ask(const std::string& question, const Deadline& deadline) {
  try {
    write(question, deadline);
    return read_line(*transport_, deadline);
  } catch (const Error& error) {
    // An instrument does not answer a query that it refuses; its error queue names the cause.
    if (error.kind() != ErrorKind::Device || question == language_.error_query) throw;
    std::string reported;
    try {
      reported = query_error(Deadline::in(kErrorQuery_s, deadline.stop));
    } catch (const Error& silent) {
      if (silent.kind() != ErrorKind::Device) throw;
    }
    if (reported.empty()) throw;
    fail_with(reported, question);
  }
}

std::string MessageInstrument::identify(const Deadline& deadline) {
  if (language_.identify.empty()) return "open; it cannot identify itself";
  return printable(ask(language_.identify, deadline));
}

void MessageInstrument::clear_errors(const Deadline& deadline) {
  transport_->discard_input();
  for (int i = 0; i < kMostErrors && !query_error(deadline).empty(); ++i) {
  }
}

void MessageInstrument::send_unchecked(const std::vector<std::string>& commands) noexcept {
  try {
    const Deadline deadline = Deadline::in(1.0);
    if (unfinished_) transport_->write(transport_->end_of_command(language_.terminator), deadline);
    for (const std::string& command : commands)
      write(command, deadline);
  } catch (const Error&) {  // NOLINT(bugprone-empty-catch) the line is broken
  }
}

SafeOff MessageInstrument::safe_off(const std::vector<std::string>& commands) const {
  // Instruments discard the rest of a line with an error within this time.
  constexpr double kPause_s = 0.05;
  SafeOff how{.line = name(),
              .file = transport_->file(),
              .end_command = transport_->end_of_command(language_.terminator),
              .pause_s = kPause_s};
  for (const std::string& command : commands)
    how.off += transport_->framed(command + language_.terminator);
  return how;
}

void MessageInstrument::write(const std::string& line, const Deadline& deadline) {
  unfinished_ = true;
  transport_->write(line + language_.terminator, deadline);
  unfinished_ = false;
}

std::string MessageInstrument::query_error(const Deadline& deadline) {
  if (language_.error_query.empty()) return {};
  std::string answer = ask(language_.error_query, deadline);
  const std::size_t sign = answer.rfind('+', 0) == 0 ? 1 : 0;  // some answer +0,"No error"
  const bool none = answer.compare(sign, language_.no_error.size(), language_.no_error) == 0;
  if (none) return {};
  return answer.empty() ? "an empty line" : answer;
}

void MessageInstrument::fail_with(const std::string& reported, const std::string& after) const {
  fail_device(name(),
              fmt::format("reports {} after '{}'; check the command", printable(reported), after));
}

ActuatorProtocol scpi_protocol() {
  return {.language = {"SYST:ERR?", "0", "\n", "*IDN?"},
          .start = {"*CLS", "OUTP ON"},
          .set = "VOLT:OFFS {value:.6f}",
          .settled_query = "*OPC?",
          .settled_answer = "1",
          .stop = {"OUTP OFF"}};
}

ActuatorProtocol gcs2_protocol(const std::string& axis) {
  return {.language = {"ERR?", "0", "\n", "*IDN?"},
          .start = {"SVO " + axis + " 1"},
          .set = "MOV " + axis + " {value:.5f}",
          .settled_query = "ONT? " + axis,
          .settled_answer = axis + "=1",
          .stop = {"STP " + axis}};
}

std::string fill_command(const std::string& set, double value) {
  if (set.find("{value") == std::string::npos) {
    throw Error(ErrorKind::Input, fmt::format("the command '{}' has no {{value}} in it", set));
  }
  try {
    return fmt::format(fmt::runtime(set), fmt::arg("value", value));
  } catch (const fmt::format_error& error) {
    throw Error(ErrorKind::Input,
                fmt::format("the command '{}' cannot be filled: {}", set, error.what()));
  }
}

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
