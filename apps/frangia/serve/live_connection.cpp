#include "live_connection.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace frangia {
namespace {

/// A WebSocket: hears one message that authorizes it, then sends the state and, when the client
/// asks for them, pictures.
class LiveConnection : public Connection, public std::enable_shared_from_this<LiveConnection> {
 public:
  LiveConnection(ClientStream stream, SharedPtr shared, Claim counted)
      : socket_(std::move(stream)), shared_(std::move(shared)), counted_(std::move(counted)) {}
  LiveConnection(const LiveConnection&) = delete;
  LiveConnection& operator=(const LiveConnection&) = delete;
  LiveConnection(LiveConnection&&) = delete;
  LiveConnection& operator=(LiveConnection&&) = delete;
  ~LiveConnection() override {
    if (registered_) shared_->live.erase(place_);
  }

  void close() override { beast::get_lowest_layer(socket_).close(); }

  void accept(const http::request<http::string_body>& request) {
    beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(websocket::stream_base::timeout{
        shared_->limits.request_time, shared_->limits.live_silence, true});
    socket_.read_message_max(shared_->limits.live_message_bytes);
    waiting_.enter(shared_->idle, this);
    socket_.async_accept(request, [self = shared_from_this()](ErrorCode error) {
      if (!error) self->expect_key();
    });
  }

 private:
  void expect_key() {
    timer_.emplace(socket_.get_executor(), shared_->limits.request_time);
    timer_->async_wait([weak = weak_from_this()](ErrorCode error) {
      const auto self = weak.lock();
      if (!error && self) self->close();
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
      if (self->shared_->app.attend) self->presence_ = self->shared_->app.attend(message);
      self->begin();
    });
  }

  void refuse() {
    socket_.async_close({websocket::close_code::policy_error, "no valid key"},
                        [self = shared_from_this()](ErrorCode) {});
  }

  void begin() {
    waiting_.leave();
    place_ = shared_->live.insert(shared_->live.end(), [weak = weak_from_this()](bool state) {
      if (const auto self = weak.lock()) self->changed(state);
    });
    registered_ = true;
    changed(true);
    listen();
  }

  /// Later messages choose what the client looks at; reading also answers pings and notices the
  /// end.
  void listen() {
    socket_.async_read(buffer_, [self = shared_from_this()](ErrorCode error, std::size_t) {
      if (error) return;
      const std::string message = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.clear();
      const auto channel =
          self->socket_.got_text() ? self->shared_->app.channel_of(message) : std::optional<int>();
      if (!channel) return self->refuse();
      self->channel_ = *channel;
      self->seen_ = 0;
      self->changed(false);
      self->listen();
    });
  }

  void changed(bool state) {
    (state ? state_due_ : picture_due_) = true;
    if (!sending_) send();
  }

  /// A slow client misses what lies between two messages, each of which holds all of its kind.
  void send() {
    if (std::exchange(state_due_, false)) {
      message_ = std::make_shared<const std::string>(shared_->app.live_message());
      socket_.text(true);
    } else if (std::exchange(picture_due_, false) && channel_ != 0) {
      auto [revision, bytes] = shared_->app.picture(channel_, seen_);
      if (!bytes) return;
      seen_ = revision;
      message_ = std::move(bytes);
      socket_.binary(true);
    } else {
      return;
    }
    sending_ = true;
    socket_.async_write(asio::buffer(*message_),
                        [self = shared_from_this()](ErrorCode error, std::size_t) {
                          self->sending_ = false;
                          if (!error) self->send();
                        });
  }

  websocket::stream<ClientStream> socket_;
  SharedPtr shared_;
  Claim counted_;
  beast::flat_buffer buffer_;
  std::optional<asio::steady_timer> timer_;
  std::list<std::function<void(bool)>>::iterator place_;
  std::shared_ptr<const std::string> message_;
  bool registered_ = false;
  bool sending_ = false;
  bool state_due_ = false;
  bool picture_due_ = false;
  int channel_ = 0;
  std::uint64_t seen_ = 0;          ///< revision of the picture that was sent last
  std::shared_ptr<void> presence_;  ///< of the client, while it is connected
  ConnectionPlace waiting_;         ///< until a key has come; last: leaves a list of `shared_`
};

}  // namespace

void serve_live(ClientStream stream,
                const http::request<http::string_body>& request,
                const SharedPtr& shared,
                Claim place) {
  const auto connection =
      std::make_shared<LiveConnection>(std::move(stream), shared, std::move(place));
  connection->accept(request);
}

}  // namespace frangia
