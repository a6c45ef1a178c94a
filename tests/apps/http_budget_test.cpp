// What a client of the app's server may take: memory, and the attention of the one thread.
#include <atomic>
#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "http_server.h"
#include "support/socket_client.h"
#include "support/temporary_folder.h"
#include "support/wait_until.h"

namespace frangia {
namespace {

using testing::SocketClient;

constexpr std::size_t kFileBytes = 96UL * 1024 * 1024;
constexpr std::size_t kAnswerBytes = 40UL * 1024 * 1024;

/// Memory of this process that is in use, MB.
double resident_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::stod(line.substr(6)) / 1024.0;
  return 0.0;
}

/// A server whose answers depend on the path.
class HttpBudget : public ::testing::Test {
 protected:
  HttpBudget() {
    std::ofstream(file_).close();
    std::filesystem::resize_file(file_, kFileBytes);
    HttpApp app;
    app.refusal = [](const HttpRequest& request) -> std::optional<HttpResponse> {
      if (request.authorization.empty() && request.body_bytes > 0)
        return HttpResponse{.status = 401, .body = "no key"};
      return std::nullopt;
    };
    app.answer = [this](const HttpRequest& request) { return answer(request); };
    app.may_connect = [](const HttpRequest& /*request*/) { return true; };
    app.authorizes = [](std::string_view /*message*/) { return true; };
    app.live_message = [this]() -> std::string {
      if (throws_live_) throw std::runtime_error("no state");
      return "{}";
    };
    app.channel_of = [](std::string_view /*message*/) { return 0; };
    app.picture = [](int /*channel*/, std::uint64_t /*after*/) { return HttpPicture{}; };
    app.on_exception = [this](const std::string& words) {
      if (words == "a handler failed" || words == "no state") ++exceptions_;
    };
    thread_ = std::jthread([this, app](const std::stop_token& stop) { server_.serve(app, stop); });
  }

  HttpResponse answer(const HttpRequest& request) {
    if (request.target == "/throw") throw std::runtime_error("a handler failed");
    if (request.target == "/throw-a-number") throw 7;
    if (request.target == "/large") return {.body = std::string(kAnswerBytes, 'x')};
    if (request.target == "/file") {
      HttpResponse response;
      response.download = FileDescriptor(::open(file_.c_str(), O_RDONLY | O_CLOEXEC));
      return response;
    }
    return {.body = fmt::format("{} bytes from {}", request.body.size(), request.host)};
  }

  [[nodiscard]] SocketClient connect(int receive_bytes = 0) const {
    return SocketClient(server_.port(), receive_bytes);
  }
  /// Whether another client is served.
  [[nodiscard]] bool serves() const {
    const SocketClient other = connect();
    EXPECT_TRUE(other.send("GET / HTTP/1.1\r\nHost: other\r\nConnection: close\r\n\r\n"));
    return other.read_all().ends_with("0 bytes from other");
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "large.bin";
  std::atomic<int> exceptions_ = 0;
  std::atomic<bool> throws_live_ = false;
  HttpServer server_{"127.0.0.1", 0, limits()};
  std::jthread thread_;

 private:
  static HttpLimits limits() {
    HttpLimits limits;
    limits.all_answers_bytes = 2 * kAnswerBytes + kAnswerBytes / 2;
    limits.all_bodies_bytes = 3UL * 1024 * 1024;
    return limits;
  }
};

TEST_F(HttpBudget, RefusesChunkedBodiesWithTheirTrailersAndExtensions) {
  const std::string head = "POST / HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n";
  for (const std::string& body : {"0\r\nX: " + std::string(70'000, 'a') + "\r\n\r\n",
                                  "2;" + std::string(3'000'000, 'a'),
                                  std::string("0\r\nHost: evil\r\nAuthorization: x\r\n\r\n")}) {
    const SocketClient client = connect();
    static_cast<void>(client.send(head + body));  // the server need not take all of it
    EXPECT_EQ(client.read_header().substr(0, 12), "HTTP/1.1 411");
    EXPECT_TRUE(serves());
  }
  EXPECT_EQ(exceptions_, 0);
}

TEST_F(HttpBudget, RefusesByTheHeaderBeforeTheBodyArrives) {
  const SocketClient client = connect();
  ASSERT_TRUE(client.send("POST / HTTP/1.1\r\nHost: a\r\nContent-Length: 1000000\r\n\r\n"));
  EXPECT_EQ(client.read_header().substr(0, 12), "HTTP/1.1 401");
}

TEST_F(HttpBudget, BoundsTheBodiesOfAllConnections) {
  const std::string head =
      "POST / HTTP/1.1\r\nHost: a\r\nAuthorization: x\r\nContent-Length: 1000000\r\n\r\n";
  std::vector<std::unique_ptr<SocketClient>> clients;
  for (int i = 0; i < 3; ++i) {
    clients.push_back(std::make_unique<SocketClient>(server_.port()));
    ASSERT_TRUE(clients.back()->send(head + std::string(999'999, 'x')));
    EXPECT_TRUE(serves());
  }
  const SocketClient late = connect();
  ASSERT_TRUE(late.send(head));
  EXPECT_EQ(late.read_header().substr(0, 12), "HTTP/1.1 503");
  const SocketClient small = connect();
  ASSERT_TRUE(
      small.send("POST / HTTP/1.1\r\nHost: a\r\nAuthorization: x\r\n"
                 "Content-Length: 2\r\n\r\n{}"));
  EXPECT_EQ(small.read_header().substr(0, 12), "HTTP/1.1 200") << "a command";
  for (const auto& client : clients) {
    ASSERT_TRUE(client->send("x"));
    EXPECT_EQ(client->read_header().substr(0, 12), "HTTP/1.1 200");
  }
}

TEST_F(HttpBudget, EndsTheConnectionOfAHandlerThatThrowsAndServesOn) {
  for (const char* target : {"/throw", "/throw", "/throw-a-number"}) {
    const SocketClient client = connect();
    ASSERT_TRUE(client.send(fmt::format("GET {} HTTP/1.1\r\nHost: a\r\n\r\n", target)));
    EXPECT_EQ(client.read_all(), "");
    EXPECT_TRUE(serves());
  }
  EXPECT_EQ(exceptions_, 2);
}

TEST_F(HttpBudget, TellsTheOtherWebSocketsWhatOneCouldNotBeTold) {
  std::vector<std::unique_ptr<SocketClient>> clients;
  for (int i = 0; i < 2; ++i) {
    clients.push_back(std::make_unique<SocketClient>(server_.port()));
    ASSERT_TRUE(
        clients.back()->send("GET /api/live HTTP/1.1\r\nHost: a\r\nConnection: Upgrade\r\n"
                             "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                             "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"));
    ASSERT_EQ(clients.back()->read_header().substr(0, 12), "HTTP/1.1 101");
    ASSERT_TRUE(clients.back()->send(std::string("\x81\x82\0\0\0\0{}", 8)));
    ASSERT_EQ(clients.back()->read(4), "\x81\x02{}");
  }
  throws_live_ = true;
  server_.announce_change();
  ASSERT_TRUE(testing::wait_until([&] { return exceptions_ == 2; }));
  throws_live_ = false;
  server_.announce_change();
  for (const auto& client : clients)
    EXPECT_EQ(client->read(4), "\x81\x02{}");
}

TEST_F(HttpBudget, StreamsDownloadsAndServesOthersMeanwhile) {
  const double before = resident_mb();
  std::vector<std::unique_ptr<SocketClient>> slow;
  for (int i = 0; i < 4; ++i) {
    slow.push_back(std::make_unique<SocketClient>(server_.port(), 4096));
    ASSERT_TRUE(slow.back()->send("GET /file HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n"));
    const std::string header = slow.back()->read_header();
    EXPECT_NE(header.find(fmt::format("Content-Length: {}\r\n", kFileBytes)), std::string::npos);
    EXPECT_TRUE(serves());
  }
  const SocketClient fast = connect();
  ASSERT_TRUE(fast.send("GET /file HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n"));
  EXPECT_EQ(fast.read_header().substr(0, 12), "HTTP/1.1 200");
  std::size_t arrived = 0;
  for (std::string piece = fast.read(1 << 20); !piece.empty(); piece = fast.read(1 << 20))
    arrived += piece.size();
  EXPECT_EQ(arrived, kFileBytes);
  EXPECT_LT(resident_mb(), before + 32.0) << "the file has 96 MB";
}

TEST_F(HttpBudget, ClosesTheSlowestClientWhenAnswersTakeTooMuchMemory) {
  const double before = resident_mb();
  const SocketClient download = connect();
  ASSERT_TRUE(download.send("GET /file HTTP/1.1\r\nHost: a\r\n\r\n"));
  ASSERT_EQ(download.read_header().substr(0, 12), "HTTP/1.1 200");
  std::vector<std::unique_ptr<SocketClient>> slow;
  for (int i = 0; i < 6; ++i) {
    slow.push_back(std::make_unique<SocketClient>(server_.port(), 4096));
    ASSERT_TRUE(slow.back()->send("GET /large HTTP/1.1\r\nHost: a\r\n\r\n"));
    ASSERT_EQ(slow.back()->read_header().substr(0, 12), "HTTP/1.1 200");
    EXPECT_TRUE(serves());
  }
  EXPECT_LT(resident_mb(), before + 150.0) << "six answers have 240 MB";
  EXPECT_LT(slow.front()->read(kAnswerBytes).size(), kAnswerBytes);
  EXPECT_EQ(slow.back()->read(kAnswerBytes).size(), kAnswerBytes);
  EXPECT_EQ(download.read(kFileBytes).size(), kFileBytes) << "it takes no memory";
}

}  // namespace
}  // namespace frangia
