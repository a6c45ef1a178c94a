#pragma once

#include <string>

namespace frangia {

/// The bytes that switch a device off over its open line. A `Guardian` sends them when the program
/// that opened the device dies.
struct SafeOff {
  std::string line;         ///< name of the line for messages: "/dev/ttyUSB0", "10.0.0.7:5025"
  int file = -1;            ///< open file descriptor of the line; devices on one line share it
  std::string end_command;  ///< ends a command of which only a part was sent
  double pause_s = 0.0;     ///< from `end_command` until the device accepts `off`
  std::string off;          ///< switches light off and stops motion
};

}  // namespace frangia
