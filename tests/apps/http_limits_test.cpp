// A client that is silent or slow: what the server of the app asks of it, and when it is cut off.
#include <cerrno>
#include <chrono>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "http_server.h"
#include "support/wait_until.h"

namespace frangia {
namespace {

/// A server whose limits of time are short, and a client of it.
class HttpLimitsTest : public ::testing::Test {
 protected:
  HttpLimitsTest() {
    HttpApp app;
    app.answer = [](const HttpRequest& /*request*/) { return HttpResponse{.body = "{}"}; };
    app.may_connect = [](const HttpRequest& /*request*/) { return true; };
    app.authorizes = [](std::string_view /*message*/) { return true; };
    app.live_message = [] { return std::string("{}"); };
    app.channel_of = [](std::string_view /*message*/) { return 0; };
    app.picture = [](int /*channel*/, std::uint64_t /*after*/) { return HttpPicture{}; };
    thread_ = std::jthread([this, app](const std::stop_token& stop) { server_.serve(app, stop); });
    client_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(server_.port());
    EXPECT_EQ(::connect(client_, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
    const timeval patience{static_cast<time_t>(testing::kPatience_s), 0};
    ::setsockopt(client_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  }
  ~HttpLimitsTest() override { ::close(client_); }
  HttpLimitsTest(const HttpLimitsTest&) = delete;
  HttpLimitsTest& operator=(const HttpLimitsTest&) = delete;
  HttpLimitsTest(HttpLimitsTest&&) = delete;
  HttpLimitsTest& operator=(HttpLimitsTest&&) = delete;

  [[nodiscard]] bool send(const std::string& bytes) const {
    return ::send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(bytes.size());
  }
  /// Reads so many bytes; fewer when the server closes the line.
  [[nodiscard]] std::string read(std::size_t count) const {
    std::string bytes(count, '\0');
    std::size_t got = 0;
    while (got < count) {
      const ssize_t more = ::recv(client_, bytes.data() + got, count - got, 0);
      EXPECT_TRUE(more >= 0 || errno == ECONNRESET) << "the server neither sends nor closes";
      if (more <= 0) break;
      got += static_cast<std::size_t>(more);
    }
    bytes.resize(got);
    return bytes;
  }
  /// Opens a WebSocket by a first message and reads what the server says to it.
  void open_live() const {
    EXPECT_TRUE(
        send("GET /api/live HTTP/1.1\r\nHost: a\r\nConnection: Upgrade\r\n"
             "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
             "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"));
    std::string head;
    while (head.find("\r\n\r\n") == std::string::npos) {
      const std::string more = read(1);
      ASSERT_FALSE(more.empty()) << head;
      head += more;
    }
    ASSERT_EQ(head.find("HTTP/1.1 101"), 0U) << head;
    // A text of two bytes, masked by zeros; and the state as a text of two bytes.
    EXPECT_TRUE(send(std::string("\x81\x82\0\0\0\0{}", 8)));
    EXPECT_EQ(read(4), "\x81\x02{}");
  }

 private:
  static HttpLimits limits() {
    HttpLimits limits;
    limits.request_time = std::chrono::seconds(1);
    limits.live_silence = std::chrono::seconds(2);
    return limits;
  }

  HttpServer server_{"127.0.0.1", 0, limits()};
  std::jthread thread_;
  int client_ = -1;
};

TEST_F(HttpLimitsTest, CutOffASenderWhoSendsAByteNowAndThen) {
  EXPECT_TRUE(testing::wait_until([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return !send("G");  // refused once the server has closed the line
  }));
}

TEST_F(HttpLimitsTest, AskASilentWebSocketForASignOfLifeAndCloseItWithoutOne) {
  open_live();
  EXPECT_EQ(read(1), "\x89");  // a ping
  for (std::string bytes = "ping"; !bytes.empty();)
    bytes = read(64);  // until the server closes the line
}

TEST(HttpLimits, AskBeforeProxiesCloseASilentWebSocketAfterAMinute) {
  EXPECT_LE(HttpLimits{}.live_silence, std::chrono::seconds(60));
}

}  // namespace
}  // namespace frangia
