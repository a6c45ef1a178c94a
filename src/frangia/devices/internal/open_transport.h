#pragma once

#include <memory>
#include <string>

#include "frangia/devices/internal/transport.h"

namespace frangia {

enum class Parity { None, Even, Odd };

struct SerialSettings {
  std::string port;  ///< "/dev/ttyUSB0"
  int baud = 115200;
  Parity parity = Parity::None;
  int stop_bits = 1;  ///< 1 or 2
};

/// errors   Error(Device) when there is no such port, it may not be opened, another program has it,
///          or it cannot do the baud rate
[[nodiscard]] std::unique_ptr<Transport> open_serial(const SerialSettings& settings);

/// errors   Error(Device) when nobody answers at host:port before the deadline
[[nodiscard]] std::unique_ptr<Transport> open_tcp(const std::string& host,
                                                  int port,
                                                  const Deadline& deadline);

}  // namespace frangia
