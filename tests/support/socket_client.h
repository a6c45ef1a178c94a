#pragma once

#include <cerrno>
#include <cstdint>
#include <string>
#include <string_view>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "support/wait_until.h"

namespace frangia::testing {

/// A client of a server on the loopback that sends what it likes.
class SocketClient {
 public:
  /// `receive_bytes`: size of the system's buffer for what arrives; 0: the usual one.
  explicit SocketClient(std::uint16_t port, int receive_bytes = 0) {
    line_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (receive_bytes > 0)
      ::setsockopt(line_, SOL_SOCKET, SO_RCVBUF, &receive_bytes, sizeof(receive_bytes));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    EXPECT_EQ(::connect(line_, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
    const timeval patience{static_cast<time_t>(kPatience_s), 0};
    ::setsockopt(line_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  }
  ~SocketClient() { ::close(line_); }
  SocketClient(const SocketClient&) = delete;
  SocketClient& operator=(const SocketClient&) = delete;
  SocketClient(SocketClient&&) = delete;
  SocketClient& operator=(SocketClient&&) = delete;

  /// Whether all bytes were taken; the server may have closed the line.
  [[nodiscard]] bool send(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t count = ::send(line_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (count <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
  }
  /// Reads so many bytes; fewer when the server closes the line.
  [[nodiscard]] std::string read(std::size_t count) const {
    std::string bytes(count, '\0');
    std::size_t got = 0;
    while (got < count) {
      const ssize_t more = ::recv(line_, bytes.data() + got, count - got, 0);
      EXPECT_TRUE(more >= 0 || errno == ECONNRESET) << "the server neither sends nor closes";
      if (more <= 0) break;
      got += static_cast<std::size_t>(more);
    }
    bytes.resize(got);
    return bytes;
  }
  /// Reads the header of an answer, with the empty line after it.
  [[nodiscard]] std::string read_header() const {
    std::string header;
    while (!header.ends_with("\r\n\r\n")) {
      const std::string more = read(1);
      if (more.empty()) break;
      header += more;
    }
    return header;
  }
  /// Reads until the server closes the line.
  [[nodiscard]] std::string read_all() const {
    std::string all;
    for (std::string more = read(4096); !more.empty(); more = read(4096))
      all += more;
    return all;
  }

 private:
  int line_ = -1;
};

}  // namespace frangia::testing
