#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/core.hpp>

namespace frangia {

/// The line to a client, with TLS or without. It is a stream of Asio and Beast, as
/// `beast::tcp_stream`.
class ClientStream {
  using Plain = boost::beast::tcp_stream;
  using Encrypted = boost::asio::ssl::stream<Plain>;
  template <class Handler>
  using ResultOf =
      typename boost::asio::async_result<std::decay_t<Handler>,
                                         void(boost::system::error_code, std::size_t)>::return_type;

 public:
  using executor_type = Plain::executor_type;  // names that Asio and Beast ask for
  using next_layer_type = Plain;

  /// `tls` outlives the stream; null: without encryption.
  ClientStream(boost::asio::ip::tcp::socket socket, boost::asio::ssl::context* tls) {
    if (tls == nullptr) {
      plain_ = std::make_unique<Plain>(std::move(socket));
      return;
    }
    // What is written by several records would wait for the client to confirm the first.
    boost::system::error_code ignored;
    socket.set_option(boost::asio::ip::tcp::no_delay(true), ignored);
    encrypted_ = std::make_unique<Encrypted>(Plain(std::move(socket)), *tls);
  }

  [[nodiscard]] bool is_encrypted() const { return encrypted_ != nullptr; }
  [[nodiscard]] Plain& next_layer() { return encrypted_ ? encrypted_->next_layer() : *plain_; }
  [[nodiscard]] const Plain& next_layer() const {
    return encrypted_ ? encrypted_->next_layer() : *plain_;
  }
  [[nodiscard]] executor_type get_executor() { return next_layer().get_executor(); }

  /// Agrees with the client on keys; of an encrypted stream alone, before anything else.
  template <class Handler>
  void async_handshake(Handler&& handler) {
    encrypted_->async_handshake(Encrypted::server, std::forward<Handler>(handler));
  }
  template <class Buffers, class Handler>
  ResultOf<Handler> async_read_some(const Buffers& buffers, Handler&& handler) {
    if (encrypted_) return encrypted_->async_read_some(buffers, std::forward<Handler>(handler));
    return plain_->async_read_some(buffers, std::forward<Handler>(handler));
  }
  template <class Buffers, class Handler>
  ResultOf<Handler> async_write_some(const Buffers& buffers, Handler&& handler) {
    if (encrypted_) return encrypted_->async_write_some(buffers, std::forward<Handler>(handler));
    return plain_->async_write_some(buffers, std::forward<Handler>(handler));
  }

 private:
  std::unique_ptr<Plain> plain_;  // one of both
  std::unique_ptr<Encrypted> encrypted_;
};

/// Ends the line of a WebSocket, which has said before that it ends.
template <class Handler>
void async_teardown(boost::beast::role_type role, ClientStream& stream, Handler&& handler) {
  async_teardown(role, stream.next_layer(), std::forward<Handler>(handler));
}

}  // namespace frangia
