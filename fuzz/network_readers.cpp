#include "network_readers.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <thread>

#include <nlohmann/json.hpp>
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp is POSIX
#include <sys/socket.h>
#include <unistd.h>

#include "frangia/core/error.h"
#include "frangia/service/access_guard.h"
#include "frangia/service/service.h"
#include "frangia/service/session_keys.h"

#include "app_routes.h"
#include "command_lines.h"
#include "http_connection.h"
#include "live_connection.h"
#include "web_assets.h"

namespace frangia {

/// The program compiles web/ into itself; a page of one line serves the parsers as well.
std::span<const WebAsset> web_assets() {
  static constexpr std::array<WebAsset, 1> kPage{{{"/index.html", "text/html", "page"}}};
  return kPage;
}

namespace {

namespace fs = std::filesystem;

fs::path make_projects_folder() {
  std::error_code error;
  const fs::path base =
      fs::is_directory("/dev/shm", error) ? fs::path("/dev/shm") : fs::temp_directory_path();
  std::string name = (base / "frangia-fuzz-server-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category());
  return name;
}

void replace_all(std::string& text, std::string_view what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at))
    text.replace(at, what.size(), by);
}

/// The app's server without a port: one connection at a time, on the caller's thread, with a
/// project of the simulated rig whose devices do not open.
class FuzzServer {
 public:
  FuzzServer()
      : folder_(make_projects_folder()),
        service_(options(), [this] { changed_ = true; }),
        password_(hash_password("a long password")),
        routes_(service_, keys_, password_, app_address({}, kPort), [] {}),
        key_(keys_.issue_key()) {
    shared_->app = routes_.app();
    make_project();
  }
  FuzzServer(const FuzzServer&) = delete;
  FuzzServer& operator=(const FuzzServer&) = delete;
  FuzzServer(FuzzServer&&) = delete;
  FuzzServer& operator=(FuzzServer&&) = delete;
  ~FuzzServer() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  [[nodiscard]] const HttpApp& app() const { return shared_->app; }
  [[nodiscard]] Service& service() { return service_; }

  /// The input with the secrets that an honest client would have.
  [[nodiscard]] std::string with_secrets(std::string_view bytes) {
    std::string text(bytes);
    replace_all(text, kFuzzKey, key_);
    if (text.find(kFuzzToken) != std::string::npos)
      replace_all(text, kFuzzToken, keys_.issue_token());
    return text;
  }

  void converse(std::string_view bytes, bool live) {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends.data()) != 0)
      throw std::system_error(errno, std::generic_category());
    {
      tcp::socket socket(context_);
      socket.assign(tcp::v4(), ends[0]);
      if (live) {
        serve_live(ClientStream(std::move(socket), nullptr),
                   upgrade(),
                   shared_,
                   Claim(shared_, &Shared::connections, 1));
      } else {
        serve_http(std::move(socket), shared_);
      }
    }
    talk(ends[1], bytes);
    ::close(ends[1]);
    settle();
  }

  /// Undoes what an input changed, so that the next one finds the same server.
  void settle() {
    wait_for_jobs();
    if (!changed_) return;
    static_cast<void>(service_.command("close-project", "{}"));
    for (const auto& entry : fs::directory_iterator(folder_))
      fs::remove_all(entry.path());
    make_project();
  }

 private:
  static constexpr std::uint16_t kPort = 6328;
  static constexpr std::chrono::seconds kPatience{5};

  [[nodiscard]] ServiceOptions options() const {
    ServiceOptions options;
    options.projects = folder_;
    options.version = "fuzz";
    options.command_lines = command_lines;
    options.capture.drivers = [] { return std::vector<Driver>(); };
    options.capture.board_drivers = [](const SimulatedBoard&) { return std::vector<Driver>(); };
    return options;
  }

  [[noreturn]] static void hang(const char* what) {
    static_cast<void>(std::fprintf(stderr, "%s\n", what));  // NOLINT(*-vararg)
    std::abort();
  }

  void make_project() {
    static_cast<void>(service_.command("create-project", R"({"name": "base", "stations": 2})"));
    wait_for_jobs();
    changed_ = false;
  }

  void wait_for_jobs() {
    const auto begin = std::chrono::steady_clock::now();
    const auto busy = [&] {
      const auto state = nlohmann::json::parse(service_.state());
      for (const auto& job : state["jobs"])
        if (job["state"] == "waiting" || job["state"] == "running") return true;
      return false;
    };
    while (changed_ && busy()) {
      if (std::chrono::steady_clock::now() - begin > kPatience) hang("a job does not end");
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  }

  static http::request<http::string_body> upgrade() {
    http::request<http::string_body> request(http::verb::get, "/api/live", 11);
    request.set(http::field::host, "127.0.0.1:6328");
    request.set(http::field::connection, "Upgrade");
    request.set(http::field::upgrade, "websocket");
    request.set(http::field::sec_websocket_version, "13");
    request.set(http::field::sec_websocket_key, "dGhlIHNhbXBsZSBub25jZQ==");
    return request;
  }

  /// Sends everything, then the end, and reads until the server has ended the connection.
  void talk(int client, std::string_view bytes) {
    const auto begin = std::chrono::steady_clock::now();
    bool sending = true;
    std::array<char, 4096> block{};
    while (shared_->connections > 0) {
      if (sending) {
        const ssize_t count = ::send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
        if (bytes.empty() || (count < 0 && errno != EAGAIN)) {
          sending = false;
          ::shutdown(client, SHUT_WR);
        }
      }
      context_.restart();
      context_.run_one_for(std::chrono::milliseconds(1));
      context_.poll();
      while (::recv(client, block.data(), block.size(), 0) > 0) {
      }
      if (std::chrono::steady_clock::now() - begin > kPatience) hang("a connection does not end");
    }
    context_.restart();
    context_.poll();  // what the connection has cancelled
  }

  fs::path folder_;
  std::atomic<bool> changed_ = false;
  Service service_;
  SessionKeys keys_;
  PasswordGuard password_;
  AppRoutes routes_;
  std::string key_;
  asio::io_context context_{1};
  SharedPtr shared_ = std::make_shared<Shared>();
};

FuzzServer& server() {
  static FuzzServer one;
  return one;
}

}  // namespace

void take_http(std::string_view bytes) {
  server().converse(server().with_secrets(bytes), false);
}

void take_live(std::string_view bytes) {
  server().converse(server().with_secrets(bytes), true);
}

void take_message(std::string_view bytes) {
  const std::string message = server().with_secrets(bytes);
  static_cast<void>(server().app().authorizes(message));
  static_cast<void>(server().app().channel_of(message));
}

void take_command(std::string_view bytes) {
  const std::size_t end = bytes.find('\n');
  const std::string name(bytes.substr(0, end));
  const std::string arguments(end == std::string_view::npos ? "" : bytes.substr(end + 1));
  struct Settle {
    ~Settle() { server().settle(); }
  };
  const Settle after;
  const std::string answer = server().service().command(name, arguments);
  const std::string state = server().service().state();
  if (!nlohmann::json::parse(answer).is_object() || !nlohmann::json::parse(state).is_object())
    std::abort();
}

}  // namespace frangia
