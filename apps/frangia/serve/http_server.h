#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "frangia/core/file_descriptor.h"

namespace frangia {

/// A request whose header was checked against the limits.
struct HttpRequest {
  std::string method;         ///< "GET", "POST", ...
  std::string target;         ///< path and query as sent, such as "/api/state"
  std::string host;           ///< header Host
  std::string origin;         ///< header Origin; empty without one
  std::string fetch_site;     ///< header Sec-Fetch-Site; empty without one
  std::string content_type;   ///< header Content-Type; empty without one
  std::string authorization;  ///< header Authorization; empty without one
  std::string forwarded_for;  ///< header X-Forwarded-For; empty without one
  std::string peer;           ///< IP address at the other end of the connection
  std::uint64_t body_bytes;   ///< header Content-Length; 0 without one
  std::string body;           ///< empty while only the header is known
};

/// The answer to a request.
struct HttpResponse {
  unsigned status = 200;
  std::string type = "application/json";  ///< header Content-Type
  std::string body = {};
  bool gzip = false;               ///< `body` is compressed
  std::string cache = "no-store";  ///< header Cache-Control
  FileDescriptor download = {};    ///< a regular file to save, sent in place of `body`
};

/// A picture that a WebSocket may receive.
struct HttpPicture {
  std::uint64_t revision = 0;
  std::shared_ptr<const std::string> bytes;  ///< null: there is no newer one
};

/// What the server asks of the app. All functions are called on the server's thread. An exception
/// of one of them ends the connection for which it was called.
struct HttpApp {
  /// Refuses a request by its header, before its body is read; empty: it goes on.
  std::function<std::optional<HttpResponse>(const HttpRequest&)> refusal;
  /// Answers a request that was not refused.
  std::function<HttpResponse(const HttpRequest&)> answer;
  /// Whether a request may open the WebSocket: its path, host and origin.
  std::function<bool(const HttpRequest&)> may_connect;
  /// Whether the first message of a WebSocket authorizes it.
  std::function<bool(std::string_view)> authorizes;
  /// Notes the client whose first message this is. What it returns is held until the client is
  /// gone. May be empty.
  std::function<std::shared_ptr<void>(std::string_view)> attend;
  /// The message that every WebSocket receives at its beginning and after each change.
  std::function<std::string()> live_message;
  /// The channel of pictures that a later message of a WebSocket chooses, 0 for none; empty for a
  /// message that is not understood, which ends the connection.
  std::function<std::optional<int>(std::string_view)> channel_of;
  /// The newest picture of a channel, unless it has the revision `after`.
  std::function<HttpPicture(int channel, std::uint64_t after)> picture;
  /// Content-Security-Policy of all answers, for the port of the server.
  std::string content_security_policy;
  /// Called with the message of an exception that ended a connection.
  std::function<void(const std::string&)> on_exception;
};

/// Limits that keep one client from hindering others.
struct HttpLimits {
  std::size_t header_bytes = 16UL * 1024;
  std::size_t body_bytes = 1024UL * 1024;
  std::size_t connections = 256;  ///< beyond it, the one that is idle longest is closed
  /// Of bodies that arrive; beyond it, those above 64 kB are refused with 503.
  std::size_t all_bodies_bytes = 64UL * 1024 * 1024;
  /// Of answers in memory beside the newest; beyond it, the connection is closed whose client takes
  /// longest.
  std::size_t all_answers_bytes = 128UL * 1024 * 1024;
  std::size_t refused_bytes =
      1024UL * 1024;                      ///< read and dropped after a refusal, so that it arrives
  std::chrono::seconds request_time{10};  ///< for a whole request to arrive
  std::chrono::seconds response_time{120};  ///< for each MB of the answer to be taken
  std::size_t live_message_bytes = 4096;    ///< of a message from a client
  /// A WebSocket is asked for a sign of life after half of this time without a message, and closed
  /// after all of it. Proxies close a connection that is silent for a minute.
  std::chrono::seconds live_silence{40};
  std::chrono::milliseconds live_interval{50};  ///< at least, between two live messages
};

/// An HTTP and WebSocket server with one thread.
class HttpServer {
 public:
  /// Listens on a port of an IP address; 0: one that the system chooses.
  ///
  /// `tls_pem`: certificate and private key; empty: without encryption
  /// @errors   Error(Input) for what is no address or no certificate; Error(Device) that names the
  ///          port when it cannot be used
  HttpServer(const std::string& address,
             std::uint16_t port,
             const HttpLimits& limits,
             const std::string& tls_pem = {});
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;
  HttpServer(HttpServer&&) = delete;
  HttpServer& operator=(HttpServer&&) = delete;
  ~HttpServer();

  [[nodiscard]] std::uint16_t port() const;  ///< the port that it listens on
  /// Serves until a stop is requested.
  void serve(HttpApp app, const std::stop_token& stop);
  /// Sends the live message to all WebSockets soon. May be called from any thread, also when
  /// `serve` has not begun or has ended.
  void announce_change();
  /// Sends a new picture to the WebSockets that look at one. As above.
  void announce_picture();

 private:
  void announce(bool state);

  struct Implementation;
  std::shared_ptr<Implementation> implementation_;
};

}  // namespace frangia
