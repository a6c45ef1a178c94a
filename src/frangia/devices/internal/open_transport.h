#pragma once

#include <memory>
#include <string>

#include "frangia/devices/device_settings.h"
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

/// Opens the line in the settings of a device: `port` with `baud`, `parity`, `stop_bits`, or `host`
/// with `tcp_port`; with `gpib_address` through a Prologix adapter on that line.
///
/// @errors   Error(Input) that names the file and the key; Error(Device) when it cannot be opened
[[nodiscard]] std::unique_ptr<Transport> open_configured_transport(DeviceSettings& settings,
                                                                   const Deadline& deadline,
                                                                   int default_baud = 115200);

/// A unique name of the line: "/dev/ttyUSB0", "10.0.0.7:1234".
[[nodiscard]] std::string configured_transport_name(DeviceSettings& settings);

/// A GPIB instrument behind a Prologix GPIB-Ethernet or GPIB-USB adapter, as a line of its own. A
/// read asks the adapter to address the instrument to talk until EOI.
///
/// @errors   those of the line; Error(Input) when the address is not 0 to 30
/// @source   Prologix GPIB-ETHERNET Controller User Manual, 1.6
[[nodiscard]] std::unique_ptr<Transport> open_prologix(std::unique_ptr<Transport> adapter,
                                                       int gpib_address,
                                                       const Deadline& deadline);

}  // namespace frangia
