#include "frangia/devices/internal/transport.h"

#include <fmt/format.h>

namespace frangia {

std::string read_until(Transport& transport, char end, const Deadline& deadline) {
  std::optional<std::string> text = transport.try_read(end, deadline);
  if (!text) {
    fail_device(
        transport.name(),
        fmt::format("no answer within {:.3g} s; check that the device is on and this is its port",
                    deadline.timeout_s));
  }
  return std::move(*text);
}

std::string read_line(Transport& transport, const Deadline& deadline) {
  std::string line = read_until(transport, '\n', deadline);
  while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) {
    line.pop_back();
  }
  const std::size_t first = line.find_first_not_of('\r');
  return first == std::string::npos ? std::string() : line.substr(first);
}

std::string printable(std::string_view bytes) {
  constexpr std::size_t kMost = 40;
  std::string text;
  for (const char c : bytes.substr(0, kMost)) {
    if (c >= ' ' && c <= '~') {
      text += c;
    } else {
      text += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    }
  }
  return bytes.size() > kMost ? text + "..." : text;
}

void fail_device(const std::string& name, const std::string& what) {
  throw Error(ErrorKind::Device, fmt::format("{}: {}", name, what));
}

}  // namespace frangia
