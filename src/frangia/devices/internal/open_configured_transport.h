#pragma once

#include <memory>

#include "frangia/devices/device_settings.h"
#include "frangia/devices/internal/transport.h"

namespace frangia {

/// The line that a device's settings name: `port` with `baud`, `parity`, `stop_bits`, or `host`
/// with `tcp_port`; `gpib_address` when it hangs on a Prologix adapter there.
///
/// errors   Error(Input) that names file and key; Error(Device) when it cannot be opened
[[nodiscard]] std::unique_ptr<Transport> open_configured_transport(DeviceSettings& settings,
                                                                   const Deadline& deadline,
                                                                   int default_baud = 115200);

/// The same line whoever asks: "/dev/ttyUSB0", "10.0.0.7:1234".
[[nodiscard]] std::string configured_transport_name(DeviceSettings& settings);

}  // namespace frangia
