// The only source that includes Boost.Beast, which takes long to compile. Longer than other sources
// for that reason.
#include "http_server.h"

#include <deque>
#include <list>
#include <optional>
#include <utility>  // before Asio, which misses it

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using ErrorCode = boost::system::error_code;
using Parser = http::request_parser<http::string_body>;
using Answer = http::response<http::string_body>;

/// A connection that can be closed to make room.
class Connection {
 public:
  Connection() = default;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  Connection(Connection&&) = delete;
  Connection& operator=(Connection&&) = delete;
  virtual ~Connection() = default;
  virtual void close() = 0;
};

/// What connections share. One thread uses it, except for `changed`.
struct Shared {
  HttpApp app;
  HttpLimits limits;
  std::list<Connection*> idle;  ///< that wait for a request, the longest first
  std::size_t connections = 0;
  std::list<std::function<void()>> live;  ///< send the live message to a WebSocket
};
using SharedPtr = std::shared_ptr<Shared>;

std::string text_of(beast::string_view view) {
  return {view.data(), view.size()};
}

HttpRequest request_of(const http::request<http::string_body>& message) {
  HttpRequest request;
  request.method = text_of(message.method_string());
  request.target = text_of(message.target());
  request.host = text_of(message[http::field::host]);
  request.origin = text_of(message[http::field::origin]);
  request.fetch_site = text_of(message["Sec-Fetch-Site"]);
  request.content_type = text_of(message[http::field::content_type]);
  request.authorization = text_of(message[http::field::authorization]);
  request.body = message.body();
  return request;
}

Answer answer_of(HttpResponse response, const Shared& shared, unsigned version, bool keep_alive) {
  Answer answer(static_cast<http::status>(response.status), version);
  answer.set(http::field::content_type, response.type);
  answer.set(http::field::cache_control, response.cache);
  answer.set("Content-Security-Policy", shared.app.content_security_policy);
  answer.set("X-Content-Type-Options", "nosniff");
  answer.set("X-Frame-Options", "DENY");
  answer.set("Referrer-Policy", "no-referrer");
  answer.set("Cross-Origin-Opener-Policy", "same-origin");
  answer.set("Cross-Origin-Resource-Policy", "same-origin");
  answer.set("Cross-Origin-Embedder-Policy", "require-corp");
  if (response.gzip) answer.set(http::field::content_encoding, "gzip");
  if (!response.download.empty()) answer.set(http::field::content_disposition, "attachment");
  answer.body() = std::move(response.body);
  answer.keep_alive(keep_alive);
  answer.prepare_payload();
  return answer;
}

/// A WebSocket: hears one message that authorizes it, then sends live messages.
class LiveConnection : public std::enable_shared_from_this<LiveConnection> {
 public:
  LiveConnection(beast::tcp_stream stream, SharedPtr shared)
      : socket_(std::move(stream)), shared_(std::move(shared)) {}
  LiveConnection(const LiveConnection&) = delete;
  LiveConnection& operator=(const LiveConnection&) = delete;
  LiveConnection(LiveConnection&&) = delete;
  LiveConnection& operator=(LiveConnection&&) = delete;
  ~LiveConnection() {
    if (registered_) shared_->live.erase(place_);
    --shared_->connections;
  }

  void accept(const http::request<http::string_body>& request) {
    beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.read_message_max(shared_->limits.live_message_bytes);
    socket_.async_accept(request, [self = shared_from_this()](ErrorCode error) {
      if (!error) self->expect_key();
    });
  }

 private:
  void expect_key() {
    timer_.emplace(socket_.get_executor(), shared_->limits.request_time);
    timer_->async_wait([weak = weak_from_this()](ErrorCode error) {
      const auto self = weak.lock();
      if (!error && self) beast::get_lowest_layer(self->socket_).close();
    });
    socket_.async_read(buffer_, [self = shared_from_this()](ErrorCode error, std::size_t) {
      self->timer_.reset();
      if (error) return;
      const std::string message = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.clear();
      if (!self->socket_.got_text() || !self->shared_->app.authorizes(message)) {
        self->refuse();
        return;
      }
      self->begin();
    });
  }

  void refuse() {
    socket_.async_close({websocket::close_code::policy_error, "no valid key"},
                        [self = shared_from_this()](ErrorCode) {});
  }

  void begin() {
    socket_.text(true);
    place_ = shared_->live.insert(shared_->live.end(), [weak = weak_from_this()] {
      if (const auto self = weak.lock()) self->send();
    });
    registered_ = true;
    send();
    listen();
  }

  /// Clients send nothing more; reading answers pings and notices the end.
  void listen() {
    socket_.async_read(buffer_, [self = shared_from_this()](ErrorCode error, std::size_t) {
      if (error) return;
      self->buffer_.clear();
      self->listen();
    });
  }

  void send() {
    if (sending_) {
      again_ = true;  // a slow client misses messages in between, which hold nothing else
      return;
    }
    sending_ = true;
    message_ = shared_->app.live_message();
    socket_.async_write(asio::buffer(message_),
                        [self = shared_from_this()](ErrorCode error, std::size_t) {
                          self->sending_ = false;
                          if (error) return;
                          if (std::exchange(self->again_, false)) self->send();
                        });
  }

  websocket::stream<beast::tcp_stream> socket_;
  SharedPtr shared_;
  beast::flat_buffer buffer_;
  std::optional<asio::steady_timer> timer_;
  std::list<std::function<void()>>::iterator place_;
  std::string message_;
  bool registered_ = false;
  bool sending_ = false;
  bool again_ = false;
};

/// Reads requests from one connection and answers them in turn.
class HttpConnection : public Connection, public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(tcp::socket socket, SharedPtr shared)
      : stream_(std::move(socket)), shared_(std::move(shared)) {
    ++shared_->connections;
  }
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;
  HttpConnection(HttpConnection&&) = delete;
  HttpConnection& operator=(HttpConnection&&) = delete;
  ~HttpConnection() override {
    end_waiting();
    if (!upgraded_) --shared_->connections;
  }

  void close() override {
    ErrorCode ignored;
    stream_.socket().close(ignored);
  }

  void read() {
    parser_.emplace();
    parser_->header_limit(static_cast<std::uint32_t>(shared_->limits.header_bytes));
    parser_->body_limit(shared_->limits.body_bytes);
    place_ = shared_->idle.insert(shared_->idle.end(), this);
    stream_.expires_after(shared_->limits.request_time);  // for all of the request
    http::async_read(
        stream_, buffer_, *parser_, [self = shared_from_this()](ErrorCode error, std::size_t) {
          self->end_waiting();
          self->on_request(error);
        });
  }

 private:
  void end_waiting() {
    if (place_) shared_->idle.erase(*place_);
    place_.reset();
  }

  void on_request(ErrorCode error) {
    if (error == http::error::body_limit) return refuse(http::status::payload_too_large);
    if (error == http::error::header_limit)
      return refuse(http::status::request_header_fields_too_large);
    if (error && error.category() == http::make_error_code(http::error::bad_method).category() &&
        error != http::error::end_of_stream && error != http::error::partial_message)
      return refuse(http::status::bad_request);
    if (error) return close();
    const auto& message = parser_->get();
    const HttpRequest request = request_of(message);
    if (websocket::is_upgrade(message)) {
      if (!shared_->app.may_connect(request)) return refuse(http::status::forbidden);
      upgraded_ = true;
      std::make_shared<LiveConnection>(std::move(stream_), shared_)->accept(message);
      return;
    }
    write(
        answer_of(shared_->app.answer(request), *shared_, message.version(), message.keep_alive()));
  }

  void refuse(http::status status) {
    HttpResponse response;
    response.status = static_cast<unsigned>(status);
    response.body = fmt::format(R"({{"error": "{}"}})", text_of(http::obsolete_reason(status)));
    write(answer_of(std::move(response), *shared_, 11, false));
  }

  void write(Answer answer) {
    answer_ = std::move(answer);
    stream_.expires_after(shared_->limits.response_time);
    http::async_write(stream_, answer_, [self = shared_from_this()](ErrorCode error, std::size_t) {
      if (error) return;
      if (self->answer_.need_eof()) return self->end();
      self->answer_ = {};
      self->read();
    });
  }

  void end() {
    ErrorCode ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
  }

  beast::tcp_stream stream_;
  SharedPtr shared_;
  beast::flat_buffer buffer_;
  std::optional<Parser> parser_;
  Answer answer_;
  std::optional<std::list<Connection*>::iterator> place_;
  bool upgraded_ = false;
};

}  // namespace

struct HttpServer::Implementation {
  asio::io_context context{1};
  tcp::acceptor acceptor{context};
  SharedPtr shared = std::make_shared<Shared>();
  asio::steady_timer announcement{context};
  bool announced = false;  ///< a live message is due

  void accept() {
    acceptor.async_accept([this](ErrorCode error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error) {
        if (shared->connections >= shared->limits.connections) make_room();
        if (shared->connections < shared->limits.connections + kReserve)
          std::make_shared<HttpConnection>(std::move(socket), shared)->read();
      }
      accept();
    });
  }

  /// Closes the connection that has waited longest for a request; its memory follows.
  void make_room() const {
    if (shared->idle.empty()) return;
    shared->idle.front()->close();
  }

  void announce() {
    if (announced) return;
    announced = true;
    announcement.expires_after(shared->limits.live_interval);
    announcement.async_wait([this](ErrorCode error) {
      announced = false;
      if (error) return;
      const auto live = shared->live;  // sending may end connections
      for (const auto& send : live)
        send();
    });
  }

  static constexpr std::size_t kReserve = 32;  // connections that are being closed
};

HttpServer::HttpServer(std::uint16_t port, const HttpLimits& limits)
    : implementation_(std::make_shared<Implementation>()) {
  Implementation& server = *implementation_;
  server.shared->limits = limits;
  const tcp::endpoint endpoint(asio::ip::address_v4::loopback(), port);
  ErrorCode error;
  server.acceptor.open(endpoint.protocol(), error);
  if (!error) server.acceptor.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) server.acceptor.bind(endpoint, error);
  if (!error) server.acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) {
    throw Error(ErrorKind::Device,
                fmt::format("port {} of 127.0.0.1 cannot be used: {}; choose another one with "
                            "`port`, or 0 for any",
                            port,
                            error.message()));
  }
}

HttpServer::~HttpServer() = default;

std::uint16_t HttpServer::port() const {
  return implementation_->acceptor.local_endpoint().port();
}

void HttpServer::serve(HttpApp app, const std::stop_token& stop) {
  Implementation& server = *implementation_;
  server.shared->app = std::move(app);
  server.accept();
  const std::stop_callback on_stop(stop, [&server] { server.context.stop(); });
  server.context.run();
}

void HttpServer::announce_change() {
  asio::post(implementation_->context, [weak = std::weak_ptr<Implementation>(implementation_)] {
    if (const auto server = weak.lock()) server->announce();
  });
}

}  // namespace frangia
