#include "frangia/devices/actuator_protocol.h"

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {

ActuatorProtocol scpi_protocol() {
  ActuatorProtocol protocol;
  protocol.start = {"*CLS", "OUTP ON"};
  protocol.set = "VOLT:OFFS {value:.6f}";
  protocol.settled_query = "*OPC?";
  protocol.settled_answer = "1";
  protocol.language = {"SYST:ERR?", "0", "\n", "*IDN?"};
  protocol.stop = {"OUTP OFF"};
  return protocol;
}

ActuatorProtocol gcs2_protocol(const std::string& axis) {
  ActuatorProtocol protocol;
  protocol.start = {"SVO " + axis + " 1"};
  protocol.set = "MOV " + axis + " {value:.5f}";
  protocol.settled_query = "ONT? " + axis;
  protocol.settled_answer = axis + "=1";
  protocol.language = {"ERR?", "0", "\n", "*IDN?"};
  protocol.stop = {"STP " + axis};
  return protocol;
}

std::string fill_command(const std::string& set, double value) {
  if (set.find("{value") == std::string::npos) {
    throw Error(ErrorKind::Input, fmt::format("the command '{}' has no {{value}} in it", set));
  }
  try {
    return fmt::format(fmt::runtime(set), fmt::arg("value", value));
  } catch (const fmt::format_error& error) {
    throw Error(ErrorKind::Input,
                fmt::format("the command '{}' cannot be filled: {}", set, error.what()));
  }
}

}  // namespace frangia
