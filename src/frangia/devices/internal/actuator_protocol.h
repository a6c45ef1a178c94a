#pragma once

#include <string>
#include <vector>

#include "frangia/devices/internal/message_instrument.h"

namespace frangia {

/// Commands of an instrument that sets a voltage or a piezo position. All are text from its manual,
/// so an instrument without a driver of its own needs no program. In `set`, {value} stands for the
/// number, with an optional format: "VOLT {value:.3f}".
struct ActuatorProtocol {
  MessageInstrument::Language language;
  std::vector<std::string> start;  ///< sent before the first value, and again after a stop
  std::string set;                 ///< sets the value
  std::string settled_query;  ///< repeated until the answer is `settled_answer`; empty: not used
  std::string settled_answer;
  std::vector<std::string> stop;  ///< sent at the end and after a fault
};

/// A function generator or power supply with SCPI; `set` sets its offset or another quantity.
///
/// @source   IEEE 488.2 (*OPC?), SCPI-99 (SYSTem:ERRor?, OUTPut)
[[nodiscard]] ActuatorProtocol scpi_protocol();

/// A controller of Physik Instrumente in closed loop.
///
/// @source   PI GCS 2.0 Commands Manual: SVO, MOV, ONT?, ERR?
[[nodiscard]] ActuatorProtocol gcs2_protocol(const std::string& axis = "1");

/// The command for a value.
///
/// @errors   Error(Input) when `set` has no {value} or an invalid format
[[nodiscard]] std::string fill_command(const std::string& set, double value);

}  // namespace frangia
