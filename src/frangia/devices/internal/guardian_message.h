#pragma once

#include <cstddef>
#include <cstdint>

namespace frangia {

enum class GuardianMessageKind : std::uint8_t {
  Watch,    ///< the header, the bytes of `end_command` and of `off`; with the file of the line
  Release,  ///< the line is closed
  Farewell  ///< the devices are safe
};

/// Beginning of a message to the guardian process. Each message is one packet.
struct GuardianMessage {
  GuardianMessageKind kind = GuardianMessageKind::Farewell;
  int key = -1;  ///< of the line: its file descriptor in the program
  double pause_s = 0.0;
  std::uint32_t end_size = 0;
  std::uint32_t off_size = 0;
};

/// Limit of a message; the off commands of a device take tens of bytes.
inline constexpr std::size_t kMaxGuardianMessage = 8192;

}  // namespace frangia
