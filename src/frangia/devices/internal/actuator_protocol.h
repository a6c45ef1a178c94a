#pragma once

#include <string>
#include <vector>

#include "frangia/devices/internal/message_instrument.h"

namespace frangia {

/// How an instrument that holds a voltage, or a piezo's position, is spoken to. All of it is text
/// from its manual, so that an instrument which is not thought of here needs no program.
/// In `set`, {value} stands for the number, with a format where one is needed: "VOLT {value:.3f}".
struct ActuatorProtocol {
  MessageInstrument::Language language;
  std::vector<std::string> start;  ///< sent once, before anything else
  std::string set;                 ///< puts the value out
  std::string settled_query;       ///< asked until it answers `settled_answer`; empty: never
  std::string settled_answer;
  std::vector<std::string> stop;  ///< sent at the end and after a fault
};

/// A function generator or supply that speaks SCPI: `set` its offset, or another quantity.
/// source   IEEE 488.2 (*OPC?), SCPI-99 (SYSTem:ERRor?, OUTPut)
[[nodiscard]] ActuatorProtocol scpi_protocol();

/// A controller of Physik Instrumente in closed loop.
/// source   PI GCS 2.0 Commands Manual: SVO, MOV, ONT?, ERR?
[[nodiscard]] ActuatorProtocol gcs2_protocol(const std::string& axis = "1");

/// The command for a value.
/// errors   Error(Input) when `set` has no {value}, or one that cannot be filled
[[nodiscard]] std::string fill_command(const std::string& set, double value);

}  // namespace frangia
