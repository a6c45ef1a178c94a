#include "app_address.h"

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

bool is_loopback(const std::string& address) {
  return address.empty() || address == "::1" || address.starts_with("127.");
}

void admit(const std::string& host, bool encrypted, AppAddress& address) {
  address.hosts.push_back(host);
  address.origins.push_back((encrypted ? "https://" : "http://") + host);
  address.sockets.push_back((encrypted ? "wss://" : "ws://") + host);
}

}  // namespace

void NetworkAccess::check(bool has_password) const {
  require(!behind_proxy || !plain_lan,
          "--behind-proxy and --plain-lan exclude each other; give one of them");
  require(!behind_proxy || !allowed_hosts.empty(),
          "--behind-proxy needs --allowed-host NAME, the name by which browsers reach the proxy");
  require(!plain_lan || !listen.empty(), "--plain-lan needs --listen ADDRESS, one of this machine");
  require((listen != "0.0.0.0" && listen != "::") || !allowed_hosts.empty(),
          "--listen on all addresses needs --allowed-host NAME:PORT, as browsers write it");
  require(
      (!behind_proxy && !plain_lan && !encrypts()) || has_password,
      "access from other machines needs a password; set one with `frangia serve --set-password`");
}

bool NetworkAccess::encrypts() const {
  return encrypted_lan || (!is_loopback(listen) && !behind_proxy && !plain_lan);
}

AppAddress app_address(const NetworkAccess& access, std::uint16_t port) {
  AppAddress address;
  address.behind_proxy = access.behind_proxy;
  for (const std::string& host : access.allowed_hosts)
    admit(host, access.behind_proxy || access.encrypts(), address);
  const bool in_lan = access.plain_lan || access.encrypts();
  if (in_lan && access.listen != "0.0.0.0" && access.listen != "::")
    admit(fmt::format("{}:{}", access.listen, port), access.encrypts(), address);
  if (!address.origins.empty()) address.link_base = address.origins.front();
  admit(fmt::format("127.0.0.1:{}", port), access.encrypts(), address);
  admit(fmt::format("localhost:{}", port), access.encrypts(), address);
  if (address.link_base.empty()) address.link_base = address.origins.front();
  return address;
}

}  // namespace frangia
