#include "frangia/devices/internal/open_configured_transport.h"

#include <utility>

#include <fmt/format.h>

#include "frangia/devices/internal/open_transport.h"
#include "frangia/devices/internal/prologix_transport.h"

namespace frangia {
namespace {

constexpr int kPrologixPort = 1234;
constexpr int kScpiPort = 5025;
/// A guardian process ends sooner.
constexpr double kPortInUse_s = 4.0;

int tcp_port_of(DeviceSettings& settings) {
  const int usual = settings.has("gpib_address") ? kPrologixPort : kScpiPort;
  return settings.integer_or("tcp_port", usual, 1, 65535);
}

std::unique_ptr<Transport> open_serial_or_tcp(DeviceSettings& settings,
                                              const Deadline& deadline,
                                              int default_baud) {
  if (settings.has("host")) {
    return open_tcp(settings.text("host"), tcp_port_of(settings), deadline);
  }
  SerialSettings serial;
  serial.port = settings.text("port");
  serial.baud = settings.integer_or("baud", default_baud, 50, 4'000'000);
  serial.stop_bits = settings.integer_or("stop_bits", 1, 1, 2);
  const std::string parity = settings.choice("parity", {"none", "even", "odd"});
  serial.parity = parity == "even" ? Parity::Even : parity == "odd" ? Parity::Odd : Parity::None;
  return open_serial(serial, deadline.at_most(kPortInUse_s));
}

}  // namespace

std::unique_ptr<Transport> open_configured_transport(DeviceSettings& settings,
                                                     const Deadline& deadline,
                                                     int default_baud) {
  auto wire = open_serial_or_tcp(settings, deadline, default_baud);
  if (!settings.has("gpib_address")) return wire;
  const int address = settings.integer_or("gpib_address", 0, 0, 30);
  return open_prologix(std::move(wire), address, deadline);
}

std::string configured_transport_name(DeviceSettings& settings) {
  if (!settings.has("host")) return settings.text("port");
  return fmt::format("{}:{}", settings.text("host"), tcp_port_of(settings));
}

}  // namespace frangia
