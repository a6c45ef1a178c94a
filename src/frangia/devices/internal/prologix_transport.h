#pragma once

#include <memory>

#include "frangia/devices/internal/transport.h"

namespace frangia {

/// A GPIB instrument behind a Prologix GPIB-Ethernet or GPIB-USB adapter, as a line of its own. A
/// read asks the adapter to address the instrument to talk until EOI.
///
/// @errors   those of the line; Error(Input) when the address is not 0 to 30
/// @source   Prologix GPIB-ETHERNET Controller User Manual, 1.6
[[nodiscard]] std::unique_ptr<Transport> open_prologix(std::unique_ptr<Transport> adapter,
                                                       int gpib_address,
                                                       const Deadline& deadline);

}  // namespace frangia
