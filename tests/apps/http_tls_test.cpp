// The server of the app with encryption: what it answers is what it answers without, and to none
// but those who encrypt.
#include <chrono>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <utility>  // before Asio, which misses it

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/asio/write.hpp>
#include <gtest/gtest.h>

#include "http_server.h"
#include "own_certificate.h"
#include "support/socket_client.h"
#include "support/wait_until.h"

namespace frangia {
namespace {

namespace asio = boost::asio;
using tcp = asio::ip::tcp;

/// A server with a certificate of its own, whose limits of time are short.
class HttpTlsTest : public ::testing::Test {
 protected:
  HttpTlsTest() {
    HttpApp app;
    app.refusal = [](const HttpRequest& /*request*/) { return std::nullopt; };
    app.answer = [](const HttpRequest& request) {
      return HttpResponse{.body = request.peer + std::string(3'000'000, 'x') + request.body};
    };
    app.may_connect = [](const HttpRequest& /*request*/) { return true; };
    app.authorizes = [](std::string_view /*message*/) { return true; };
    app.live_message = [] { return std::string("{}"); };
    app.channel_of = [](std::string_view /*message*/) { return 0; };
    app.picture = [](int /*channel*/, std::uint64_t /*after*/) { return HttpPicture{}; };
    thread_ = std::jthread([this, app](const std::stop_token& stop) { server_.serve(app, stop); });
  }

  /// A client that trusts the server's certificate alone, connected.
  struct Client {
    explicit Client(std::uint16_t port, const std::string& trusted) : line(context, tls) {
      tls.add_certificate_authority(asio::buffer(trusted));
      line.set_verify_mode(asio::ssl::verify_peer);
      line.next_layer().connect({asio::ip::address_v4::loopback(), port});
    }
    asio::io_context context;
    asio::ssl::context tls{asio::ssl::context::tls_client};
    asio::ssl::stream<tcp::socket> line;
    std::string read;  ///< of what was read, the part that was not used

    std::string header() {
      const auto end = asio::read_until(line, asio::dynamic_buffer(read), "\r\n\r\n");
      std::string head = read.substr(0, end);
      read.erase(0, end);
      return head;
    }
    std::string next(std::size_t count) {
      if (read.size() < count)
        asio::read(line, asio::dynamic_buffer(read), asio::transfer_exactly(count - read.size()));
      std::string bytes = read.substr(0, count);
      read.erase(0, count);
      return bytes;
    }
  };

  static HttpLimits limits() {
    HttpLimits limits;
    limits.request_time = std::chrono::seconds(1);
    return limits;
  }

  OwnCertificate certificate_ = own_certificate({}, {"127.0.0.1"});
  HttpServer server_{"127.0.0.1", 0, limits(), certificate_.pem};
  std::jthread thread_;
};

TEST_F(HttpTlsTest, AnswersOneRequestAfterTheOther) {
  Client client(server_.port(), certificate_.pem);
  client.line.handshake(asio::ssl::stream_base::client);
  for (const std::string body : {"one", "two"}) {
    asio::write(client.line,
                asio::buffer("POST / HTTP/1.1\r\nHost: a\r\nContent-Length: 3\r\n\r\n" + body));
    const std::string head = client.header();
    EXPECT_EQ(head.find("HTTP/1.1 200"), 0U) << head;
    EXPECT_NE(head.find("Content-Length: 3000012"), std::string::npos) << head;
    const std::string answer = client.next(3'000'012);
    EXPECT_EQ(answer.substr(0, 9), "127.0.0.1");
    EXPECT_EQ(answer.substr(answer.size() - 4), "x" + body);
  }
}

TEST_F(HttpTlsTest, OpensWebSockets) {
  Client client(server_.port(), certificate_.pem);
  client.line.handshake(asio::ssl::stream_base::client);
  asio::write(
      client.line,
      asio::buffer(std::string("GET /api/live HTTP/1.1\r\nHost: a\r\nConnection: Upgrade\r\n"
                               "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n")));
  EXPECT_EQ(client.header().find("HTTP/1.1 101"), 0U);
  asio::write(client.line, asio::buffer(std::string("\x81\x82\0\0\0\0{}", 8)));  // masked by zeros
  EXPECT_EQ(client.next(4), "\x81\x02{}");
  asio::write(client.line, asio::buffer(std::string("\x88\x80\0\0\0\0", 6)));  // closes
  EXPECT_EQ(client.next(4), "\x88\x02\x03\xe8");                               // normal, 1000
  boost::system::error_code error;
  asio::read(client.line, asio::dynamic_buffer(client.read), error);
  EXPECT_TRUE(error) << "the line is still open";
}

TEST_F(HttpTlsTest, ClosesTheLineOfWhoDoesNotEncrypt) {
  const testing::SocketClient plain(server_.port());
  EXPECT_TRUE(plain.send("GET / HTTP/1.1\r\nHost: a\r\n\r\n"));
  std::string all;
  for (std::string bytes = "begin"; !bytes.empty();)
    all += bytes = plain.read(64);
  EXPECT_EQ(all.find("HTTP"), std::string::npos) << all;
}

TEST_F(HttpTlsTest, ClosesTheLineOfWhoIsSilent) {
  const testing::SocketClient silent(server_.port());
  EXPECT_EQ(silent.read(1), "");  // which ends when the server closes it
}

}  // namespace
}  // namespace frangia
