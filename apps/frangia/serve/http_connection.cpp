#include "http_connection.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "client_stream.h"
#include "live_connection.h"

namespace frangia {
namespace {

using Parser = http::request_parser<http::string_body>;

/// What is read at once: a header, or pieces of a body.
constexpr std::size_t kBufferBytes = 64UL * 1024;
constexpr std::size_t kDroppedAtOnce = 16UL * 1024;
/// Each time that so much of an answer was taken, the time for it begins again.
constexpr std::size_t kTakenBytes = 1024UL * 1024;

std::string text_of(beast::string_view view) {
  return {view.data(), view.size()};
}

HttpRequest request_of(const Parser& parser, std::string peer) {
  const auto& message = parser.get();
  HttpRequest request;
  request.method = text_of(message.method_string());
  request.target = text_of(message.target());
  request.host = text_of(message[http::field::host]);
  request.origin = text_of(message[http::field::origin]);
  request.fetch_site = text_of(message["Sec-Fetch-Site"]);
  request.content_type = text_of(message[http::field::content_type]);
  request.authorization = text_of(message[http::field::authorization]);
  request.forwarded_for = text_of(message["X-Forwarded-For"]);
  request.peer = std::move(peer);
  request.body_bytes = parser.content_length().value_or(0);
  return request;
}

/// Whether a header that decides who asks, or what is sent, occurs twice. A proxy in front may read
/// the other one.
bool is_ambiguous(const http::request<http::string_body>& message) {
  return message.count(http::field::host) > 1 || message.count(http::field::origin) > 1 ||
         message.count("Sec-Fetch-Site") > 1 || message.count("X-Forwarded-For") > 1 ||
         message.count(http::field::content_type) > 1 ||
         message.count(http::field::authorization) > 1;
}

/// The header of an answer; its body follows.
template <class Body>
void set_header(const HttpResponse& response,
                const Shared& shared,
                bool keep_alive,
                http::response<Body>& answer) {
  answer.result(static_cast<http::status>(response.status));
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
  if (response.download.is_open()) answer.set(http::field::content_disposition, "attachment");
  answer.keep_alive(keep_alive);
}

/// An answer on its way.
template <class Body>
struct Sending {
  http::response<Body> message;
  std::optional<http::response_serializer<Body>> serializer;  ///< of the complete message
  Claim memory;
};

/// Reads requests from one connection and answers them in turn.
class HttpConnection : public Connection, public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(tcp::socket socket, SharedPtr shared)
      : stream_(std::move(socket), shared->tls.get()),
        shared_(std::move(shared)),
        counted_(shared_, &Shared::connections, 1) {
    ErrorCode error;
    const tcp::endpoint peer = line().socket().remote_endpoint(error);
    if (!error) peer_ = peer.address().to_string();
  }
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;
  HttpConnection(HttpConnection&&) = delete;
  HttpConnection& operator=(HttpConnection&&) = delete;
  ~HttpConnection() override = default;

  void close() override {
    ErrorCode ignored;
    line().socket().close(ignored);
  }
  [[nodiscard]] std::size_t answer_bytes() const override { return answer_bytes_; }

  void begin() {
    if (!stream_.is_encrypted()) return read();
    place_.enter(shared_->idle, this);
    line().expires_after(shared_->limits.request_time);
    stream_.async_handshake([self = shared_from_this()](ErrorCode error) {
      self->place_.leave();
      if (!error) self->read();
    });
  }

 private:
  beast::tcp_stream& line() { return stream_.next_layer(); }

  void read() {
    parser_.emplace();
    parser_->header_limit(static_cast<std::uint32_t>(shared_->limits.header_bytes));
    parser_->body_limit(shared_->limits.body_bytes);
    place_.enter(shared_->idle, this);
    line().expires_after(shared_->limits.request_time);  // for all of the request
    http::async_read_header(
        stream_, buffer_, *parser_, [self = shared_from_this()](ErrorCode error, std::size_t) {
          self->place_.leave();
          if (self->is_read(error)) self->on_header();
        });
  }

  /// Whether a part of the request was read; answers it otherwise, or closes the connection.
  bool is_read(ErrorCode error) {
    if (!error) return true;
    const bool is_http =
        error.category() == http::make_error_code(http::error::bad_method).category();
    if (error == http::error::body_limit) {
      refuse(http::status::payload_too_large);
    } else if (error == http::error::header_limit || error == http::error::buffer_overflow) {
      refuse(http::status::request_header_fields_too_large);
    } else if (is_http && error != http::error::end_of_stream &&
               error != http::error::partial_message) {
      refuse(http::status::bad_request);
    } else {
      close();
    }
    return false;
  }

  /// All that decides about a request stands in its header: its body is read for those only who may
  /// send one.
  void on_header() {
    const auto& message = parser_->get();
    if (is_ambiguous(message)) return refuse(http::status::bad_request);
    // The page and scripts know how long their bodies are. Chunks have extensions and trailers,
    // which no limit of Beast counts.
    if (message.count(http::field::transfer_encoding) > 0)
      return refuse(http::status::length_required);
    request_ = request_of(*parser_, peer_);
    if (auto refusal = shared_->app.refusal(request_))
      return answer(std::move(*refusal), message.keep_alive() && request_.body_bytes == 0);
    if (websocket::is_upgrade(message)) {
      if (!shared_->app.may_connect(request_)) return refuse(http::status::forbidden);
      serve_live(std::move(stream_), message, shared_, std::move(counted_));
      return;
    }
    if (request_.body_bytes > 0 && message.method() != http::verb::post)
      return refuse(http::status::bad_request);
    if (request_.body_bytes > kBufferBytes &&
        shared_->body_bytes + request_.body_bytes > shared_->limits.all_bodies_bytes)
      return refuse(http::status::service_unavailable);
    const auto claim = std::make_shared<Claim>(
        shared_, &Shared::body_bytes, static_cast<std::size_t>(request_.body_bytes));
    place_.enter(shared_->idle, this);
    http::async_read(stream_,
                     buffer_,
                     *parser_,
                     [self = shared_from_this(), claim](ErrorCode error, std::size_t) {
                       self->place_.leave();
                       if (self->is_read(error)) self->on_request();
                     });
  }

  void on_request() {
    request_.body = std::move(parser_->get().body());
    const bool keep_alive = parser_->get().keep_alive();
    HttpResponse response = shared_->app.answer(request_);
    request_ = {};
    answer(std::move(response), keep_alive);
  }

  void refuse(http::status status) {
    HttpResponse response;
    response.status = static_cast<unsigned>(status);
    response.body = fmt::format(R"({{"error": "{}"}})", text_of(http::obsolete_reason(status)));
    answer(std::move(response), false);
  }

  void answer(HttpResponse response, bool keep_alive) {
    if (response.download.is_open()) return download(std::move(response), keep_alive);
    const auto sending = std::make_shared<Sending<http::string_body>>();
    set_header(response, *shared_, keep_alive, sending->message);
    sending->message.body() = std::move(response.body);
    sending->message.prepare_payload();
    answer_bytes_ = sending->message.body().capacity();
    sending->memory = Claim(shared_, &Shared::answer_bytes, answer_bytes_);
    make_room_for_answers();
    begin_to_send(sending);
  }

  /// Beast reads the file as the client takes it, a few kB at a time.
  void download(HttpResponse response, bool keep_alive) {
    const auto sending = std::make_shared<Sending<http::file_body>>();
    set_header(response, *shared_, keep_alive, sending->message);
    beast::file_posix file;
    file.native_handle(response.download.release());
    ErrorCode error;
    sending->message.body().reset(std::move(file), error);
    if (error) return refuse(http::status::internal_server_error);
    sending->message.prepare_payload();
    begin_to_send(sending);
  }

  /// Closes the connections of slow clients, whose memory follows when they notice it. The answer
  /// of this one does not count: it may be larger than what all others may take.
  void make_room_for_answers() const {
    std::size_t over = shared_->answer_bytes - answer_bytes_;
    for (auto slowest = shared_->sending.begin();
         over > shared_->limits.all_answers_bytes && slowest != shared_->sending.end();
         ++slowest) {
      const std::size_t held = (*slowest)->answer_bytes();
      if (held == 0) continue;  // a download
      over -= std::min(over, held);
      (*slowest)->close();
    }
  }

  template <class Body>
  void begin_to_send(const std::shared_ptr<Sending<Body>>& sending) {
    sending->serializer.emplace(sending->message);
    taken_ = 0;
    place_.enter(shared_->sending, this);
    line().expires_after(shared_->limits.response_time);
    send(sending);
  }

  template <class Body>
  void send(const std::shared_ptr<Sending<Body>>& sending) {
    http::async_write_some(
        stream_,
        *sending->serializer,
        [self = shared_from_this(), sending](ErrorCode error, std::size_t count) {
          self->on_sent(sending, error, count);
        });
  }

  template <class Body>
  void on_sent(const std::shared_ptr<Sending<Body>>& sending, ErrorCode error, std::size_t count) {
    if (error) return place_.leave();  // the last use of this connection
    taken_ += count;
    if (!sending->serializer->is_done()) {
      if (taken_ >= kTakenBytes) {
        taken_ = 0;
        line().expires_after(shared_->limits.response_time);
      }
      return send(sending);
    }
    place_.leave();
    answer_bytes_ = 0;
    if (sending->message.need_eof()) return end();
    read();
  }

  /// Says that no more follows, and drops what the client still sends: closed at once, the
  /// connection would lose the answer.
  void end() {
    ErrorCode error;
    line().socket().shutdown(tcp::socket::shutdown_send, error);
    parser_.reset();
    dropped_ = 0;
    line().expires_after(shared_->limits.request_time);
    if (!error) drop();
  }

  void drop() {
    buffer_.clear();
    place_.enter(shared_->idle, this);
    stream_.async_read_some(buffer_.prepare(kDroppedAtOnce),
                            [self = shared_from_this()](ErrorCode error, std::size_t count) {
                              self->place_.leave();
                              self->dropped_ += count;
                              if (!error && self->dropped_ < self->shared_->limits.refused_bytes)
                                self->drop();
                            });
  }

  ClientStream stream_;
  SharedPtr shared_;
  Claim counted_;
  std::string peer_;
  beast::flat_buffer buffer_{kBufferBytes};
  std::optional<Parser> parser_;
  HttpRequest request_;
  std::size_t answer_bytes_ = 0;  ///< in memory
  std::size_t taken_ = 0;         ///< of the answer, since its time began
  std::size_t dropped_ = 0;       ///< after the answer
  ConnectionPlace place_;         ///< last: leaves a list of `shared_`
};

}  // namespace

void serve_http(tcp::socket socket, const SharedPtr& shared) {
  std::make_shared<HttpConnection>(std::move(socket), shared)->begin();
}

}  // namespace frangia
