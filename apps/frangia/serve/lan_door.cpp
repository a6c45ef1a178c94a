#include "lan_door.h"

#include <algorithm>
#include <cstdint>
#include <thread>
#include <utility>

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <nlohmann/json.hpp>

#include "frangia/core/error.h"
#include "frangia/service/access_guard.h"

#include "http_server.h"
#include "own_certificate.h"

namespace frangia {
namespace {

/// Beside that of this machine's own browser.
constexpr std::uint16_t kUsualPort = 6329;

std::unique_ptr<HttpServer> listen(const std::string& address, const std::string& tls_pem) {
  try {
    return std::make_unique<HttpServer>(address, kUsualPort, HttpLimits{}, tls_pem);
  } catch (const Error& error) {  // in use; any other one serves as well
    if (error.kind() != ErrorKind::Device) throw;
    return std::make_unique<HttpServer>(address, std::uint16_t{0}, HttpLimits{}, tls_pem);
  }
}

/// Twelve letters and digits that nobody confuses, in groups of four: 60 bits.
std::string readable_password() {
  constexpr std::string_view kLetters = "abcdefghjkmnpqrstuvwxyz23456789x";
  constexpr std::size_t kLength = 12;
  constexpr std::size_t kGroup = 4;
  const std::string random = random_key();
  std::string password;
  for (std::size_t i = 0; i < kLength; ++i) {
    if (i > 0 && i % kGroup == 0) password += '-';
    // Two of 64 characters of base64url that are each as likely as the other.
    constexpr std::string_view kBase64 =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
    password += kLetters[kBase64.find(random.at(i)) % kLetters.size()];
  }
  return password;
}

}  // namespace

std::vector<std::string> network_addresses() {
  std::vector<std::string> found;
  ::ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) return found;
  for (const ::ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    if ((one->ifa_flags & IFF_LOOPBACK) != 0 || (one->ifa_flags & IFF_UP) == 0) continue;
    std::string text(INET_ADDRSTRLEN, '\0');
    const auto* address =
        reinterpret_cast<const ::sockaddr_in*>(one->ifa_addr);  // NOLINT(*-reinterpret-cast)
    if (::inet_ntop(AF_INET, &address->sin_addr, text.data(), INET_ADDRSTRLEN) == nullptr) continue;
    text.resize(text.find('\0'));
    found.push_back(text);
  }
  ::freeifaddrs(all);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

struct LanDoor::Open {
  /// `certificate`: empty without encryption
  Open(const std::string& address,
       const OwnCertificate& certificate,
       Service& service,
       SessionKeys& keys,
       std::function<void()> on_operator,
       const std::function<void(const std::string&)>& on_exception)
      : server(listen(address, certificate.pem)),
        fingerprint(certificate.fingerprint),
        password(readable_password()),
        guard(hash_password(password)),
        routes(service,
               keys,
               guard,
               app_address({.listen = address,
                            .plain_lan = certificate.pem.empty(),
                            .encrypted_lan = !certificate.pem.empty(),
                            .allowed_hosts = {}},
                           server->port()),
               std::move(on_operator)),
        thread([this, on_exception](const std::stop_token& stop) {
          HttpApp app = routes.app();
          app.on_exception = on_exception;
          server->serve(std::move(app), stop);
        }) {}
  Open(const Open&) = delete;
  Open& operator=(const Open&) = delete;
  Open(Open&&) = delete;
  Open& operator=(Open&&) = delete;
  /// Ends the connections while the routes are there: the role of an operator ends with its page.
  ~Open() {
    thread.request_stop();
    thread.join();
    server.reset();
  }

  std::unique_ptr<HttpServer> server;
  std::string fingerprint;  ///< of the certificate; empty without encryption
  std::string password;
  PasswordGuard guard;
  AppRoutes routes;
  std::jthread thread;  ///< last: ends before what it uses
};

LanDoor::~LanDoor() {
  close();
}

LanAccess LanDoor::access(Service& service,
                          SessionKeys& keys,
                          std::function<void()> on_operator,
                          std::function<void(const std::string&)> on_exception) {
  LanAccess access;
  access.state = [this] { return state(); };
  access.open =
      [this, &service, &keys, operates = std::move(on_operator), says = std::move(on_exception)](
          const std::string& address, bool encrypted) {
        const auto known = network_addresses();
        require(std::find(known.begin(), known.end(), address) != known.end(),
                "address: this machine has no such address in a network; choose one of the list");
        const OwnCertificate certificate =
            encrypted ? own_certificate(certificate_, known) : OwnCertificate{};
        close();
        auto opened = std::make_shared<Open>(address, certificate, service, keys, operates, says);
        const std::lock_guard lock(mutex_);
        open_ = std::move(opened);
      };
  access.close = [this] { close(); };
  return access;
}

void LanDoor::close() {
  std::shared_ptr<Open> before;
  const std::lock_guard lock(mutex_);
  before.swap(open_);
}

std::string LanDoor::state() const {
  nlohmann::ordered_json json{{"addresses", network_addresses()}, {"open", nullptr}};
  const std::lock_guard lock(mutex_);
  if (open_) {
    const std::string link = open_->routes.new_link();
    json["open"] = {{"url", link.substr(0, link.find("/#"))},
                    {"link", link},
                    {"password", open_->password},
                    {"fingerprint", open_->fingerprint}};
  }
  return json.dump();
}

void LanDoor::announce_change() const {
  const std::lock_guard lock(mutex_);
  if (open_) open_->server->announce_change();
}

void LanDoor::announce_picture() const {
  const std::lock_guard lock(mutex_);
  if (open_) open_->server->announce_picture();
}

}  // namespace frangia
