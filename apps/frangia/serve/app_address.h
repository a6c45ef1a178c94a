#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace frangia {

/// Where browsers find the server, and what their requests must name.
struct AppAddress {
  std::string link_base;             ///< "http://127.0.0.1:6328": beginning of links
  std::vector<std::string> hosts;    ///< accepted in the header Host
  std::vector<std::string> origins;  ///< accepted in the header Origin
  std::vector<std::string> sockets;  ///< WebSockets that the page may open
  bool behind_proxy = false;         ///< X-Forwarded-For names the client
};

/// How a server is reached from other machines.
struct NetworkAccess {
  std::string listen;          ///< IP address; empty: 127.0.0.1 only
  bool behind_proxy = false;   ///< a reverse proxy on this machine adds TLS
  bool plain_lan = false;      ///< without encryption, by explicit wish
  bool encrypted_lan = false;  ///< by a certificate of the machine's own, see `encrypts`
  std::vector<std::string> allowed_hosts;  ///< names of the machine, with a port where not usual

  /// @errors   Error(Input) that names the option which is missing or contradicts another one
  void check(bool has_password) const;
  /// Whether the server encrypts by a certificate of the machine's own: beyond this machine, unless
  /// a proxy does or it is not wanted.
  [[nodiscard]] bool encrypts() const;
};

/// The addresses of a server on a port.
[[nodiscard]] AppAddress app_address(const NetworkAccess& access, std::uint16_t port);

}  // namespace frangia
