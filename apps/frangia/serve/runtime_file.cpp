#include "runtime_file.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <nlohmann/json.hpp>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/open_below.h"
#include "frangia/core/read_file.h"
#include "frangia/core/text.h"

namespace frangia {
namespace {

/// $XDG_RUNTIME_DIR; empty without one.
std::filesystem::path runtime_folder() {
  const char* folder = std::getenv("XDG_RUNTIME_DIR");  // NOLINT(concurrency-mt-unsafe)
  return folder != nullptr && *folder == '/' ? folder : "";
}

std::filesystem::path runtime_path() {
  const auto folder = runtime_folder();
  return folder.empty() ? folder : folder / "frangia-serve.json";
}

/// Closes a file descriptor at the end of a scope.
struct Descriptor {
  int number = -1;
  explicit Descriptor(int n) : number(n) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(file, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

std::string read_to_end(int file) {
  std::string all;
  char block[4096];
  for (;;) {
    const ssize_t count = ::read(file, static_cast<char*>(block), sizeof block);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0 || all.size() > 64U * 1024U) return all;
    all.append(static_cast<const char*>(block), static_cast<std::size_t>(count));
  }
}

}  // namespace

RuntimeFile::RuntimeFile(std::uint16_t port, const std::string& key) : path_(runtime_path()) {
  if (path_.empty()) return;
  text_ = nlohmann::json{{"port", port}, {"key", key}}.dump() + "\n";
  const std::string fresh = fmt::format("{}.{}", path_.string(), ::getpid());
  constexpr unsigned kOwnerOnly = 0600;
  const Descriptor file(::open(fresh.c_str(),  // NOLINT(*-vararg)
                               O_CREAT | O_EXCL | O_WRONLY | O_NOFOLLOW | O_CLOEXEC,
                               kOwnerOnly));
  if (file.number < 0 || !write_all(file.number, text_) ||
      ::rename(fresh.c_str(), path_.c_str()) != 0) {
    const int error = errno;
    ::unlink(fresh.c_str());
    throw Error(ErrorKind::File,
                fmt::format("{}: cannot be written: {}", path_.string(), std::strerror(error)));
  }
}

RuntimeFile::~RuntimeFile() {
  if (path_.empty()) return;
  try {
    if (read_text_file(path_) == text_) ::unlink(path_.c_str());
  } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): it was removed already
  }
}

LinkPage::LinkPage(const std::string& link) {
  std::filesystem::path folder = runtime_folder();
  if (folder.empty()) {
    std::string name = (std::filesystem::temp_directory_path() / "frangia-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw Error(ErrorKind::File, fmt::format("{}: cannot be created", name));
    folder_ = folder = name;
  }
  path_ = folder / fmt::format("frangia-open-{}.html", ::getpid());
  const std::string shown = html_escaped(link);
  write_private_file(path_,
                     fmt::format("<!doctype html><meta charset=\"utf-8\"><title>Frangia</title>"
                                 "<meta http-equiv=\"refresh\" content=\"0; url={}\">"
                                 "<a href=\"{}\">Frangia</a>\n",
                                 shown,
                                 shown));
}

LinkPage::~LinkPage() {
  ::unlink(path_.c_str());
  if (!folder_.empty()) ::rmdir(folder_.c_str());
}

std::string ask_for_link() {
  const auto path = runtime_path();
  require(!path.empty(),
          "XDG_RUNTIME_DIR is not set, so that a running server cannot be found; log in to a "
          "session that sets it, or start a server");
  std::error_code ignored;
  require(std::filesystem::exists(path, ignored),
          "no server of this user runs; start one with `frangia serve`");
  const auto json =
      nlohmann::json::parse(read_json_below(path.parent_path(), path.filename()), nullptr, false);
  require(json.is_object() && json.contains("port") && json["port"].is_number_unsigned() &&
              json.contains("key") && json["key"].is_string(),
          "the file of the running server is damaged; stop the server and start it again");
  const auto port = json["port"].get<std::uint16_t>();
  const Descriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const timeval patience{5, 0};
  ::setsockopt(socket.number, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  ::setsockopt(socket.number, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const std::string request = fmt::format(
      "POST /api/links HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nAuthorization: Bearer {}\r\n"
      "Content-Type: application/json\r\nContent-Length: 2\r\nConnection: close\r\n\r\n{{}}",
      port,
      json["key"].get<std::string>());
  std::string answer;
  if (::connect(socket.number, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
      write_all(socket.number, request))
    answer = read_to_end(socket.number);
  const std::size_t body = answer.find("\r\n\r\n");
  const auto link = body == std::string::npos
                        ? nlohmann::json()
                        : nlohmann::json::parse(answer.substr(body + 4), nullptr, false);
  if (!link.is_object() || !link.contains("url") || !link["url"].is_string())
    throw Error(ErrorKind::Device, "the server does not answer; stop it and start it again");
  return link["url"].get<std::string>();
}

}  // namespace frangia
