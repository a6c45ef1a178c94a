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

/// Opens a serial port. Waits until `deadline` while another program uses it.
///
/// @errors   Error(Device) when the port does not exist, may not be opened, is in use, or does not
///          support the baud rate
[[nodiscard]] std::unique_ptr<Transport> open_serial(const SerialSettings& settings,
                                                     const Deadline& deadline = Deadline::in(0.0));

/// Opens a TCP connection.
///
/// @errors   Error(Device) when host:port does not answer before the deadline
[[nodiscard]] std::unique_ptr<Transport> open_tcp(const std::string& host,
                                                  int port,
                                                  const Deadline& deadline);

}  // namespace frangia
