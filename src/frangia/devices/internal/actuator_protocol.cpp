#include "frangia/devices/internal/actuator_protocol.h"

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {

ActuatorProtocol scpi_protocol() {
  return {.language = {"SYST:ERR?", "0", "\n", "*IDN?"},
          .start = {"*CLS", "OUTP ON"},
          .set = "VOLT:OFFS {value:.6f}",
          .settled_query = "*OPC?",
          .settled_answer = "1",
          .stop = {"OUTP OFF"}};
}

ActuatorProtocol gcs2_protocol(const std::string& axis) {
  return {.language = {"ERR?", "0", "\n", "*IDN?"},
          .start = {"SVO " + axis + " 1"},
          .set = "MOV " + axis + " {value:.5f}",
          .settled_query = "ONT? " + axis,
          .settled_answer = axis + "=1",
          .stop = {"STP " + axis}};
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
