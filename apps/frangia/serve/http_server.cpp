#include "http_server.h"

#include <exception>
#include <utility>

#include <fmt/format.h>
#include <openssl/ssl.h>

#include "frangia/core/error.h"

#include "http_connection.h"
#include "shared_server.h"

namespace frangia {

struct HttpServer::Implementation {
  asio::io_context context{1};
  tcp::acceptor acceptor{context};
  SharedPtr shared = std::make_shared<Shared>();
  asio::steady_timer announcement{context};
  asio::steady_timer retry{context};
  bool accepts = false;    ///< waits for the next connection, or to do so
  bool announced = false;  ///< live messages are due
  bool state_changed = false;
  bool picture_changed = false;

  void accept() {
    acceptor.async_accept([this](ErrorCode error, tcp::socket socket) {
      accepts = false;
      if (error == asio::error::operation_aborted) return;
      if (error) return accept_later();
      if (shared->connections >= shared->limits.connections) static_cast<void>(make_room());
      if (shared->connections < shared->limits.connections + kReserve)
        serve_http(std::move(socket), shared);
      accept();
    });
    accepts = true;
  }

  /// The system is short of descriptors or memory.
  void accept_later() {
    if (make_room()) return accept();
    retry.expires_after(shared->limits.live_interval);
    retry.async_wait([this](ErrorCode) {
      accepts = false;
      accept();
    });
    accepts = true;
  }

  /// Handles events until the server is stopped. An exception ends the connection whose handler
  /// threw it: the handler held it.
  void run() {
    for (;;) {
      try {
        if (!accepts) accept();
        context.run();
        return;
      } catch (const std::exception& error) {
        report(error.what());
      } catch (...) {
        report("an exception without words");
      }
    }
  }

  void report(const char* words) const noexcept {
    try {
      if (shared->app.on_exception) shared->app.on_exception(words);
    } catch (...) {  // NOLINT(bugprone-empty-catch): nobody can be told
    }
  }

  /// Closes the connection that has waited longest, first among those that wait for a request,
  /// otherwise for its client to take an answer; its memory follows. Returns whether there is one.
  [[nodiscard]] bool make_room() const {
    for (const Connections* list : {&shared->idle, &shared->sending}) {
      if (list->empty()) continue;
      list->front()->close();
      return true;
    }
    return false;
  }

  void announce(bool state) {
    (state ? state_changed : picture_changed) = true;
    if (announced) return;
    announced = true;
    announcement.expires_after(shared->limits.live_interval);
    announcement.async_wait([this](ErrorCode error) {
      announced = false;
      if (error) return;
      const auto live = shared->live;  // sending may end connections
      const bool with_state = std::exchange(state_changed, false);
      const bool with_picture = std::exchange(picture_changed, false);
      for (const auto& changed : live) {
        try {
          if (with_state) changed(true);
          if (with_picture) changed(false);
        } catch (const std::exception& thrown) {  // the other connections still get it
          report(thrown.what());
        }
      }
    });
  }

  static constexpr std::size_t kReserve = 32;  // connections that are being closed
};

namespace {

/// TLS 1.2 or later, with a certificate and its key.
std::unique_ptr<asio::ssl::context> tls_context(const std::string& pem) {
  auto context = std::make_unique<asio::ssl::context>(asio::ssl::context::tls_server);
  const asio::const_buffer text = asio::buffer(pem);
  ErrorCode error;
  context->set_options(asio::ssl::context::default_workarounds | asio::ssl::context::no_sslv2 |
                           asio::ssl::context::no_sslv3 | asio::ssl::context::no_tlsv1 |
                           asio::ssl::context::no_tlsv1_1 | SSL_OP_NO_RENEGOTIATION,
                       error);
  if (!error) context->use_certificate_chain(text, error);
  if (!error) context->use_private_key(text, asio::ssl::context::pem, error);
  require(!error, "the certificate of the server cannot be used");
  return context;
}

}  // namespace

HttpServer::HttpServer(const std::string& address,
                       std::uint16_t port,
                       const HttpLimits& limits,
                       const std::string& tls_pem)
    : implementation_(std::make_shared<Implementation>()) {
  Implementation& server = *implementation_;
  server.shared->limits = limits;
  if (!tls_pem.empty()) server.shared->tls = tls_context(tls_pem);
  ErrorCode error;
  const tcp::endpoint endpoint(asio::ip::make_address(address, error), port);
  require(!error, fmt::format("'{}' is no IP address to listen on", address).c_str());
  server.acceptor.open(endpoint.protocol(), error);
  if (!error) server.acceptor.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) server.acceptor.bind(endpoint, error);
  if (!error) server.acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) {
    throw Error(
        ErrorKind::Device,
        fmt::format("port {} of {} cannot be used: {}; choose another one with `port`, or 0 "
                    "for any",
                    port,
                    address,
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
  const std::stop_callback on_stop(stop, [&server] { server.context.stop(); });
  server.run();
}

void HttpServer::announce(bool state) {
  asio::post(implementation_->context,
             [state, weak = std::weak_ptr<Implementation>(implementation_)] {
               if (const auto server = weak.lock()) server->announce(state);
             });
}

void HttpServer::announce_change() {
  announce(true);
}

void HttpServer::announce_picture() {
  announce(false);
}

}  // namespace frangia
