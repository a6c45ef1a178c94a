#include "frangia/devices/internal/grbl_codes.h"

#include <cstdlib>

#include <fmt/format.h>

#include "frangia/devices/internal/transport.h"

namespace frangia {
namespace {

const char* meaning_of_alarm(int code) {
  switch (code) {
    case 1:
      return "a limit switch was hit";
    case 2:
      return "the target is beyond the travel of the axis, set in $130 to $133";
    case 3:
      return "it was reset while it moved";
    case 6:
    case 7:
    case 8:
    case 9:
      return "homing failed; check the home switch";
    default:
      return "see the list of alarms of GRBL";
  }
}

const char* meaning_of_error(int code) {
  switch (code) {
    case 5:
      return "homing is not enabled; set $22=1, or home = \"here\"";
    case 8:
      return "that is only possible at standstill";
    case 9:
      return "it is locked after an alarm; home the table again";
    case 15:
      return "the target is beyond its travel";
    case 20:
      return "the command is unknown";
    default:
      return "see the list of errors of GRBL";
  }
}

/// The number at the end of "ALARM:3" or "error:9".
int number_after_colon(const std::string& line) {
  return std::atoi(line.c_str() + line.find(':') + 1);  // NOLINT(cert-err34-c) 0 is not a code
}

}  // namespace

std::string explained_alarm(const std::string& line) {
  return fmt::format("{}, {}", printable(line), meaning_of_alarm(number_after_colon(line)));
}

std::string explained_error(const std::string& line) {
  return fmt::format("({}): {}", printable(line), meaning_of_error(number_after_colon(line)));
}

}  // namespace frangia
