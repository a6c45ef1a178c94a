#include "http_connection.h"

#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "live_connection.h"

namespace frangia {
namespace {

using Parser = http::request_parser<http::string_body>;
using Answer = http::response<http::string_body>;

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

/// Whether a header that decides who asks, or what is sent, occurs twice. A proxy in front may read
/// the other one.
bool is_ambiguous(const http::request<http::string_body>& message) {
  return message.count(http::field::host) > 1 || message.count(http::field::origin) > 1 ||
         message.count("Sec-Fetch-Site") > 1 || message.count(http::field::content_type) > 1 ||
         message.count(http::field::authorization) > 1;
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
    place_.enter(shared_->idle, this);
    stream_.expires_after(shared_->limits.request_time);  // for all of the request
    http::async_read(
        stream_, buffer_, *parser_, [self = shared_from_this()](ErrorCode error, std::size_t) {
          self->place_.leave();
          self->on_request(error);
        });
  }

 private:
  void on_request(ErrorCode error) {
    if (error == http::error::body_limit) return refuse(http::status::payload_too_large);
    if (error == http::error::header_limit)
      return refuse(http::status::request_header_fields_too_large);
    if (error && error.category() == http::make_error_code(http::error::bad_method).category() &&
        error != http::error::end_of_stream && error != http::error::partial_message)
      return refuse(http::status::bad_request);
    if (error) return close();
    const auto& message = parser_->get();
    if (is_ambiguous(message)) return refuse(http::status::bad_request);
    const HttpRequest request = request_of(message);
    if (websocket::is_upgrade(message)) {
      if (!shared_->app.may_connect(request)) return refuse(http::status::forbidden);
      upgraded_ = true;
      serve_live(std::move(stream_), message, shared_);
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
    place_.enter(shared_->sending, this);
    stream_.expires_after(shared_->limits.response_time);
    http::async_write(stream_, answer_, [self = shared_from_this()](ErrorCode error, std::size_t) {
      self->place_.leave();
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
  bool upgraded_ = false;
  ConnectionPlace place_;  ///< last: leaves a list of `shared_`
};

}  // namespace

void serve_http(tcp::socket socket, const SharedPtr& shared) {
  std::make_shared<HttpConnection>(std::move(socket), shared)->read();
}

}  // namespace frangia
