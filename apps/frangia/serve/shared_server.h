#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <utility>  // before Asio, which misses it

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include "http_server.h"

namespace frangia {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using ErrorCode = boost::system::error_code;

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
  /// Memory of the answer that its client takes.
  [[nodiscard]] virtual std::size_t answer_bytes() const { return 0; }
};

/// Connections in the order in which they are closed to make room.
using Connections = std::list<Connection*>;

/// The place of a connection in one of the lists, while it is in one.
class ConnectionPlace {
 public:
  ConnectionPlace() = default;
  ConnectionPlace(const ConnectionPlace&) = delete;
  ConnectionPlace& operator=(const ConnectionPlace&) = delete;
  ConnectionPlace(ConnectionPlace&&) = delete;
  ConnectionPlace& operator=(ConnectionPlace&&) = delete;
  ~ConnectionPlace() { leave(); }

  void enter(Connections& list, Connection* connection) {
    leave();
    list_ = &list;
    place_ = list.insert(list.end(), connection);
  }
  void leave() {
    if (list_ != nullptr) list_->erase(place_);
    list_ = nullptr;
  }

 private:
  Connections* list_ = nullptr;
  Connections::iterator place_;
};

/// What connections share. One thread uses it, except for `changed`.
struct Shared {
  std::unique_ptr<asio::ssl::context> tls;  ///< null: without encryption
  HttpApp app;
  HttpLimits limits;
  Connections idle;     ///< that wait for a request or for a key, the longest first
  Connections sending;  ///< whose client takes an answer, the longest first
  std::size_t connections = 0;
  std::size_t body_bytes = 0;    ///< of the requests that arrive
  std::size_t answer_bytes = 0;  ///< in memory, of the answers that are sent
  /// Tell a WebSocket that the state, or else a picture, has changed.
  std::list<std::function<void(bool state)>> live;
};
using SharedPtr = std::shared_ptr<Shared>;

/// A part of a number that connections share, until the end of its life.
class Claim {
 public:
  Claim() = default;
  Claim(SharedPtr shared, std::size_t Shared::*total, std::size_t count)
      : shared_(std::move(shared)), total_(total), count_(count) {
    (*shared_).*total_ += count_;
  }
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;
  Claim(Claim&& other) noexcept { swap(other); }
  Claim& operator=(Claim&& other) noexcept {
    Claim(std::move(other)).swap(*this);
    return *this;
  }
  ~Claim() {
    if (shared_) (*shared_).*total_ -= count_;
  }

 private:
  void swap(Claim& other) noexcept {
    std::swap(shared_, other.shared_);
    std::swap(total_, other.total_);
    std::swap(count_, other.count_);
  }

  SharedPtr shared_;
  std::size_t Shared::*total_ = nullptr;
  std::size_t count_ = 0;
};

}  // namespace frangia
