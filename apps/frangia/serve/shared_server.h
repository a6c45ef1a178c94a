#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <utility>  // before Asio, which misses it

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
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
};

/// What connections share. One thread uses it, except for `changed`.
struct Shared {
  HttpApp app;
  HttpLimits limits;
  std::list<Connection*> idle;  ///< that wait for a request, the longest first
  std::size_t connections = 0;
  /// Tell a WebSocket that the state, or else a picture, has changed.
  std::list<std::function<void(bool state)>> live;
};
using SharedPtr = std::shared_ptr<Shared>;

}  // namespace frangia
