#include "frangia/devices/internal/open_transport.h"

#include <array>
#include <chrono>
#include <functional>
#include <optional>
#include <utility>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/serial_port.hpp>
#include <boost/asio/write.hpp>
#include <fmt/format.h>
#include <sys/file.h>

namespace frangia {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

/// Limit of a line; a device that exceeds it uses another protocol or baud rate. The longest real
/// answers, lists of settings, have lines below 100 bytes.
constexpr std::size_t kLongestLine = 4096;
/// Limit of the input that is discarded at once. A device that sends more does not stop sending.
constexpr std::size_t kMostDiscarded = 65536;
constexpr double kRetryLock_s = 0.02;

/// Runs the context until `done`. On a stop request or at the deadline it calls `cancel` and lets
/// the handlers finish. Returns whether the operation completed in time.
bool run_until(asio::io_context& context,
               const bool& done,
               const Deadline& deadline,
               const std::function<void()>& cancel) {
  context.restart();
  while (!done) {
    if (deadline.stop.stop_requested() || deadline.passed()) {
      cancel();
      context.run();
      deadline.check();
      return false;
    }
    const auto left = deadline.time - Deadline::Clock::now();
    context.run_for(std::min<Deadline::Clock::duration>(left, std::chrono::milliseconds(20)));
  }
  return true;
}

template <typename Stream>
class AsioTransport final : public Transport {
 public:
  explicit AsioTransport(std::string name) : name_(std::move(name)), stream_(context_) {}

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] Stream& stream() { return stream_; }
  [[nodiscard]] asio::io_context& context() { return context_; }
  // Asio declares the function without const.
  [[nodiscard]] int file() const override { return const_cast<Stream&>(stream_).native_handle(); }

  void write(std::string_view bytes, const Deadline& deadline) override {
    bool done = false;
    error_code failure;
    asio::async_write(stream_,
                      asio::buffer(bytes.data(), bytes.size()),
                      [&](const error_code& code, std::size_t /*count*/) {
                        failure = code;
                        done = true;
                      });
    if (!run_until(context_, done, deadline, [this] { cancel(); })) {
      fail_device(name_,
                  fmt::format("accepts no data for {:.3g} s; check the cable", deadline.timeout_s));
    }
    if (failure) fail_closed(failure);
  }

  [[nodiscard]] std::optional<std::string> try_read(char end, const Deadline& deadline) override {
    for (;;) {
      const std::size_t found = received_.find(end);
      if (found != std::string::npos) {
        std::string text = received_.substr(0, found);
        received_.erase(0, found + 1);
        return text;
      }
      if (received_.size() > kLongestLine) {
        fail_device(name_,
                    fmt::format("sends a line without end ('{}'); check the baud rate",
                                printable(received_)));
      }
      if (!receive(deadline)) return std::nullopt;
    }
  }

  void discard_input() override {
    for (std::size_t discarded = 0; discarded < kMostDiscarded;) {
      received_.clear();
      late_read_.reset();
      if (!receive(Deadline::in(0.0))) break;
      discarded += received_.size();
    }
    received_.clear();
  }

 private:
  bool receive(const Deadline& deadline) {
    deadline.check();
    // Bytes that arrived in time count when they are read late. One read is enough for them, and a
    // device that sends without pause does not extend the deadline.
    if (deadline.passed() && std::exchange(late_read_, deadline.time) == deadline.time)
      return false;
    bool done = false;
    error_code failure;
    std::size_t received = 0;
    stream_.async_read_some(asio::buffer(chunk_), [&](const error_code& code, std::size_t count) {
      failure = code;
      received = count;
      done = true;
    });
    context_.restart();
    context_.poll();
    const bool in_time = done || run_until(context_, done, deadline, [this] { cancel(); });
    received_.append(chunk_.data(), received);
    if (failure && failure != asio::error::operation_aborted) fail_closed(failure);
    return in_time || received > 0;
  }
  void cancel() {
    error_code ignored;
    stream_.cancel(ignored);
  }
  [[noreturn]] void fail_closed(const error_code& code) const {
    fail_device(
        name_,
        fmt::format("the connection broke ({}); check that it is plugged in", code.message()));
  }

  std::string name_;
  asio::io_context context_;
  Stream stream_;
  std::array<char, 1024> chunk_{};
  std::optional<Deadline::Clock::time_point> late_read_;  ///< deadline after which a read was made
  std::string received_;
};

void configure_port(asio::serial_port& port, const SerialSettings& settings) {
  using Port = asio::serial_port_base;
  const auto parity = settings.parity == Parity::Even  ? Port::parity::even
                      : settings.parity == Parity::Odd ? Port::parity::odd
                                                       : Port::parity::none;
  port.set_option(Port::baud_rate(static_cast<unsigned>(settings.baud)));
  port.set_option(Port::character_size(8U));
  port.set_option(Port::parity(parity));
  port.set_option(
      Port::stop_bits(settings.stop_bits == 2 ? Port::stop_bits::two : Port::stop_bits::one));
  port.set_option(Port::flow_control(Port::flow_control::none));
}

}  // namespace

std::unique_ptr<Transport> open_serial(const SerialSettings& settings, const Deadline& deadline) {
  auto transport = std::make_unique<AsioTransport<asio::serial_port>>(settings.port);
  asio::serial_port& port = transport->stream();
  error_code failure;
  port.open(settings.port, failure);
  if (failure) {
    const bool forbidden = failure == asio::error::access_denied;
    fail_device(settings.port,
                fmt::format("cannot be opened ({}); {}",
                            failure.message(),
                            forbidden ? "join the group dialout and log in again"
                                      : "run 'frangia devices' to list the ports"));
  }
  // Two programs on one port would mix their commands. The guardian of a program that was killed
  // holds the port for a moment.
  while (::flock(port.native_handle(), LOCK_EX | LOCK_NB) != 0) {
    if (deadline.passed())
      fail_device(settings.port, "is in use by another program; close that first");
    deadline.sleep(kRetryLock_s);
  }
  try {
    configure_port(port, settings);
  } catch (const boost::system::system_error& error) {
    fail_device(
        settings.port,
        fmt::format("does not support {} baud ({})", settings.baud, error.code().message()));
  }
  return transport;
}

std::unique_ptr<Transport> open_tcp(const std::string& host, int port, const Deadline& deadline) {
  using asio::ip::tcp;
  auto transport = std::make_unique<AsioTransport<tcp::socket>>(fmt::format("{}:{}", host, port));
  tcp::resolver resolver(transport->context());
  bool done = false;
  error_code failure;
  resolver.async_resolve(
      host, std::to_string(port), [&](const error_code& code, const auto& endpoints) {
        failure = code;
        done = static_cast<bool>(code);
        if (done) return;
        asio::async_connect(
            transport->stream(), endpoints, [&](const error_code& connected, const auto& /*at*/) {
              failure = connected;
              done = true;
            });
      });
  const auto cancel = [&] {
    resolver.cancel();
    error_code ignored;
    transport->stream().close(ignored);
  };
  if (!run_until(transport->context(), done, deadline, cancel)) {
    fail_device(
        transport->name(),
        fmt::format(
            "no connection within {:.3g} s; check that the device is on and on this network",
            deadline.timeout_s));
  }
  if (failure) {
    fail_device(transport->name(),
                fmt::format("no connection ({}); check host and port", failure.message()));
  }
  transport->stream().set_option(tcp::no_delay(true));
  return transport;
}

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

namespace {

class PrologixTransport final : public Transport {
 public:
  PrologixTransport(std::unique_ptr<Transport> adapter, int gpib_address)
      : adapter_(std::move(adapter)),
        name_(fmt::format("{} GPIB {}", adapter_->name(), gpib_address)) {}

  [[nodiscard]] const std::string& name() const override { return name_; }

  /// Each line is one message; the adapter adds the terminator and EOI.
  void write(std::string_view bytes, const Deadline& deadline) override {
    adapter_->write(framed(bytes), deadline);
    asked_ = false;
  }

  [[nodiscard]] int file() const override { return adapter_->file(); }
  [[nodiscard]] std::string framed(std::string_view bytes) const override {
    while (!bytes.empty() && (bytes.back() == '\n' || bytes.back() == '\r')) {
      bytes.remove_suffix(1);
    }
    std::string message;
    for (const char c : bytes) {
      // The adapter itself would interpret these.
      if (c == '\n' || c == '\r' || c == '+' || c == '\x1b') message += '\x1b';
      message += c;
    }
    return message + "\n";
  }
  /// After an escape byte, the first line feed is data and the second ends the command.
  [[nodiscard]] std::string end_of_command(std::string_view /*terminator*/) const override {
    return "\n\n";
  }

  [[nodiscard]] std::optional<std::string> try_read(char end, const Deadline& deadline) override {
    if (!std::exchange(asked_, true)) adapter_->write("++read eoi\n", deadline);
    std::optional<std::string> text = adapter_->try_read(end, deadline);
    if (text) asked_ = false;
    return text;
  }

  void discard_input() override {
    adapter_->discard_input();
    asked_ = false;
  }

 private:
  std::unique_ptr<Transport> adapter_;
  std::string name_;
  bool asked_ = false;  ///< the instrument is addressed to talk
};

}  // namespace

std::unique_ptr<Transport> open_prologix(std::unique_ptr<Transport> adapter,
                                         int gpib_address,
                                         const Deadline& deadline) {
  if (gpib_address < 0 || gpib_address > 30) {
    throw Error(ErrorKind::Input,
                fmt::format("gpib_address is {}; it must lie between 0 and 30", gpib_address));
  }
  adapter->write("++ver\n", deadline);
  const std::string version = read_line(*adapter, deadline);
  if (version.find("Prologix") == std::string::npos && version.find("GPIB") == std::string::npos) {
    fail_device(adapter->name(),
                fmt::format("is not a Prologix adapter: it answered '{}'", printable(version)));
  }
  // Do not save to EEPROM; no automatic read after write; EOI ends messages; append CR LF.
  for (const char* command : {"++savecfg 0", "++mode 1", "++auto 0", "++eoi 1", "++eos 0"}) {
    adapter->write(fmt::format("{}\n", command), deadline);
  }
  adapter->write(fmt::format("++addr {}\n", gpib_address), deadline);
  return std::make_unique<PrologixTransport>(std::move(adapter), gpib_address);
}

}  // namespace frangia
