// A client that is silent or slow: what the server of the app asks of it, and when it is cut off.
#include <chrono>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include <gtest/gtest.h>

#include "http_server.h"
#include "support/socket_client.h"
#include "support/wait_until.h"

namespace frangia {
namespace {

/// A server whose limits of time are short, and a client of it.
class HttpLimitsTest : public ::testing::Test {
 protected:
  HttpLimitsTest() {
    HttpApp app;
    app.refusal = [](const HttpRequest& /*request*/) { return std::nullopt; };
    app.answer = [](const HttpRequest& /*request*/) { return HttpResponse{.body = "{}"}; };
    app.may_connect = [](const HttpRequest& /*request*/) { return true; };
    app.authorizes = [](std::string_view /*message*/) { return true; };
    app.live_message = [] { return std::string("{}"); };
    app.channel_of = [](std::string_view /*message*/) { return 0; };
    app.picture = [](int /*channel*/, std::uint64_t /*after*/) { return HttpPicture{}; };
    thread_ = std::jthread([this, app](const std::stop_token& stop) { server_.serve(app, stop); });
  }

  /// Opens a WebSocket by a first message and reads what the server says to it.
  void open_live() const {
    EXPECT_TRUE(
        client_.send("GET /api/live HTTP/1.1\r\nHost: a\r\nConnection: Upgrade\r\n"
                     "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                     "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"));
    const std::string head = client_.read_header();
    ASSERT_EQ(head.find("HTTP/1.1 101"), 0U) << head;
    // A text of two bytes, masked by zeros; and the state as a text of two bytes.
    EXPECT_TRUE(client_.send(std::string("\x81\x82\0\0\0\0{}", 8)));
    EXPECT_EQ(client_.read(4), "\x81\x02{}");
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

 protected:
  testing::SocketClient client_{server_.port()};
};

TEST_F(HttpLimitsTest, CutOffASenderWhoSendsAByteNowAndThen) {
  EXPECT_TRUE(testing::wait_until([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return !client_.send("G");  // refused once the server has closed the line
  }));
}

TEST_F(HttpLimitsTest, AskASilentWebSocketForASignOfLifeAndCloseItWithoutOne) {
  open_live();
  EXPECT_EQ(client_.read(1), "\x89");  // a ping
  for (std::string bytes = "ping"; !bytes.empty();)
    bytes = client_.read(64);  // until the server closes the line
}

TEST(HttpLimits, AskBeforeProxiesCloseASilentWebSocketAfterAMinute) {
  EXPECT_LE(HttpLimits{}.live_silence, std::chrono::seconds(60));
}

}  // namespace
}  // namespace frangia
