#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "frangia/devices/deadline.h"

namespace frangia {

/// Bytes to and from a device over a line: a serial port, a network socket, a GPIB adapter.
///
/// errors   Error(Device) that names the line: closed, unplugged, no answer before the deadline, an
///          endless line without an end; Error(Cancelled) when a stop was asked for
class Transport {
 public:
  Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;
  Transport(Transport&&) = delete;
  Transport& operator=(Transport&&) = delete;
  virtual ~Transport() = default;

  /// As a sentence begins: "/dev/ttyUSB0", "10.0.0.7:1234".
  [[nodiscard]] virtual const std::string& name() const = 0;
  virtual void write(std::string_view bytes, const Deadline& deadline) = 0;
  /// What comes before the next `end`, which is taken off; nothing when the deadline is first.
  [[nodiscard]] virtual std::optional<std::string> try_read(char end, const Deadline& deadline) = 0;
  /// Throws away what has come and was not read: answers to questions given up.
  virtual void discard_input() = 0;
};

/// As try_read, but silence is an error that says for how long it lasted.
[[nodiscard]] std::string read_until(Transport& transport, char end, const Deadline& deadline);

/// One line of text, without the carriage return that many devices send.
[[nodiscard]] std::string read_line(Transport& transport, const Deadline& deadline);

/// A text as it may stand in a sentence: short, what is not printable as \xNN.
[[nodiscard]] std::string printable(std::string_view bytes);

[[noreturn]] void fail_device(const std::string& name, const std::string& what);

}  // namespace frangia
