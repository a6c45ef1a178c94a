#pragma once

#include <memory>

#include "frangia/devices/device_settings.h"
#include "frangia/devices/internal/transport.h"

namespace frangia {

/// Opens the line in the settings of a device: `port` with `baud`, `parity`, `stop_bits`, or `host`
/// with `tcp_port`; with `gpib_address` through a Prologix adapter on that line.
///
/// @errors   Error(Input) that names the file and the key; Error(Device) when it cannot be opened
[[nodiscard]] std::unique_ptr<Transport> open_configured_transport(DeviceSettings& settings,
                                                                   const Deadline& deadline,
                                                                   int default_baud = 115200);

/// A unique name of the line: "/dev/ttyUSB0", "10.0.0.7:1234".
[[nodiscard]] std::string configured_transport_name(DeviceSettings& settings);

}  // namespace frangia
