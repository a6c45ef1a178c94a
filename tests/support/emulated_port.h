#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

namespace frangia::testing {

/// How many bytes wait to be read from a terminal or a socket; 0 where it is closed.
[[nodiscard]] inline std::size_t unread_bytes(int file) {
  int count = 0;
  return ::ioctl(file, FIONREAD, &count) == 0 ? static_cast<std::size_t>(count)
                                              : 0U;  // NOLINT(*-vararg)
}

/// The other end of a line: a device's protocol, with its faults.
class EmulatedDevice {
 public:
  EmulatedDevice() = default;
  EmulatedDevice(const EmulatedDevice&) = delete;
  EmulatedDevice& operator=(const EmulatedDevice&) = delete;
  EmulatedDevice(EmulatedDevice&&) = delete;
  EmulatedDevice& operator=(EmulatedDevice&&) = delete;
  virtual ~EmulatedDevice() = default;

  /// What it says when somebody connects.
  virtual std::string greet() { return {}; }
  virtual std::string receive(std::string_view bytes) = 0;
  /// Called every millisecond: unrequested output, such as the end of a move.
  virtual std::string tick() { return {}; }
};

/// An emulated device whose lines end with LF; carriage returns are dropped.
class EmulatedLineDevice : public EmulatedDevice {
 public:
  std::string receive(std::string_view bytes) override {
    std::string answers;
    for (const char c : bytes) {
      if (c == '\n') {
        answers += answer(std::exchange(line_, {}));
      } else if (c != '\r') {
        line_ += c;
      }
    }
    return answers;
  }
  virtual std::string answer(const std::string& line) = 0;

 private:
  std::string line_;
};

/// Serves a device on a thread of its own: over a pseudo-terminal or a TCP port of 127.0.0.1.
class EmulatedPort {
 public:
  enum class Kind { Terminal, Tcp };

  explicit EmulatedPort(std::unique_ptr<EmulatedDevice> device, Kind kind = Kind::Terminal)
      : device_(std::move(device)), kind_(kind) {
    if (kind == Kind::Terminal) {
      open_terminal();
    } else {
      open_socket();
    }
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }
  EmulatedPort(const EmulatedPort&) = delete;
  EmulatedPort& operator=(const EmulatedPort&) = delete;
  EmulatedPort(EmulatedPort&&) = delete;
  EmulatedPort& operator=(EmulatedPort&&) = delete;
  ~EmulatedPort() {
    unplug();
    if (other_end_ >= 0) ::close(other_end_);
  }

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] int tcp_port() const { return tcp_port_; }
  /// The lines of rig.toml that open this port.
  [[nodiscard]] std::string settings() const {
    if (kind_ == Kind::Terminal) return "port = \"" + path_ + "\"\n";
    return "host = \"127.0.0.1\"\ntcp_port = " + std::to_string(tcp_port_) + "\n";
  }
  /// Looks at the device, or gives it a fault, while it is not at work.
  template <typename Device, typename Do>
  auto with(const Do& action) {
    const std::scoped_lock lock(mutex_);
    return action(dynamic_cast<Device&>(*device_));
  }
  /// Whether the device has received all that was sent to it.
  [[nodiscard]] bool has_received_all() {
    const std::scoped_lock lock(mutex_);
    return fd_ < 0 || unread_bytes(fd_) == 0;
  }
  void unplug() {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
    for (int* fd : {&fd_, &listener_}) {
      if (*fd >= 0) ::close(std::exchange(*fd, -1));
    }
    if (other_end_ >= 0) ::close(std::exchange(other_end_, -1));
  }

 private:
  void open_terminal() {
    std::array<char, 256> name{};
    if (::openpty(&fd_, &other_end_, name.data(), nullptr, nullptr) != 0) {
      throw std::runtime_error("no pseudo-terminal to be had");
    }
    termios raw{};
    ::tcgetattr(other_end_, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(other_end_, TCSANOW, &raw);
    path_ = name.data();
    transmit(device_->greet());
  }
  void open_socket() {
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    auto* any = reinterpret_cast<sockaddr*>(&address);
    if (::bind(listener_, any, size) != 0 || ::listen(listener_, 1) != 0) {
      throw std::runtime_error("no port to listen at");
    }
    ::getsockname(listener_, any, &size);
    tcp_port_ = ntohs(address.sin_port);
  }
  void serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      pollfd waiting{fd_ >= 0 ? fd_ : listener_, POLLIN, 0};
      const bool ready = ::poll(&waiting, 1, 1) > 0 && (waiting.revents & POLLIN) != 0;
      const std::scoped_lock lock(mutex_);
      if (ready && fd_ < 0) {
        fd_ = ::accept(listener_, nullptr, nullptr);
        transmit(device_->greet());
      } else if (ready) {
        std::array<char, 256> bytes{};
        const ssize_t count = ::read(fd_, bytes.data(), bytes.size());
        if (count <= 0) {  // the program has closed the line
          if (kind_ == Kind::Terminal) return;
          ::close(std::exchange(fd_, -1));  // another one may connect
          continue;
        }
        transmit(device_->receive({bytes.data(), static_cast<std::size_t>(count)}));
      }
      transmit(device_->tick());
    }
  }
  /// Drops what does not fit into the line, as a serial port without flow control does.
  void transmit(const std::string& text) const {
    if (fd_ < 0 || text.empty()) return;
    ::fcntl(fd_, F_SETFL, ::fcntl(fd_, F_GETFL) | O_NONBLOCK);  // NOLINT(*-vararg)
    if (kind_ == Kind::Tcp) {
      if (::send(fd_, text.data(), text.size(), MSG_NOSIGNAL) < 0) return;
    } else if (::write(fd_, text.data(), text.size()) < 0) {
      return;
    }
  }

  std::unique_ptr<EmulatedDevice> device_;
  Kind kind_;
  std::mutex mutex_;
  int fd_ = -1;
  int other_end_ = -1;  ///< kept open, so that the terminal outlives the program that opens it
  int listener_ = -1;
  int tcp_port_ = 0;
  std::string path_;
  std::jthread thread_;
};

}  // namespace frangia::testing
