#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "frangia/devices/deadline.h"

namespace frangia {

/// A byte stream to and from a device: a serial port, a network socket, a GPIB adapter.
///
/// @errors   Error(Device) that names the line: closed, unplugged, no answer before the deadline, a
///          line without end; Error(Cancelled) when a stop was requested
class Transport {
 public:
  Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;
  Transport(Transport&&) = delete;
  Transport& operator=(Transport&&) = delete;
  virtual ~Transport() = default;

  /// Name for messages: "/dev/ttyUSB0", "10.0.0.7:1234".
  [[nodiscard]] virtual const std::string& name() const = 0;
  virtual void write(std::string_view bytes, const Deadline& deadline) = 0;
  /// The bytes before the next `end`, which is removed; empty when the deadline passes first.
  [[nodiscard]] virtual std::optional<std::string> try_read(char end, const Deadline& deadline) = 0;
  /// Discards bytes that have arrived, such as answers to abandoned queries. Bounded in time even
  /// when the device sends without pause.
  virtual void discard_input() = 0;

  /// The open file of the line; -1 if it has none.
  [[nodiscard]] virtual int file() const { return -1; }
  /// The bytes that `write` sends on the line for `bytes`.
  [[nodiscard]] virtual std::string framed(std::string_view bytes) const {
    return std::string(bytes);
  }
  /// The bytes that end a command of which only a part was sent on the line.
  [[nodiscard]] virtual std::string end_of_command(std::string_view terminator) const {
    return std::string(terminator);
  }
};

/// As try_read, but throws Error(Device) with the elapsed time when the deadline passes.
[[nodiscard]] std::string read_until(Transport& transport, char end, const Deadline& deadline);

/// Reads one line of text, without the carriage return that many devices send.
[[nodiscard]] std::string read_line(Transport& transport, const Deadline& deadline);

/// A text for a message: shortened, with unprintable bytes as \xNN.
[[nodiscard]] std::string printable(std::string_view bytes);

[[noreturn]] void fail_device(const std::string& name, const std::string& what);

}  // namespace frangia
