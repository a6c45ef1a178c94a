#pragma once

#include <cstdint>
#include <string>

#include "frangia/service/service.h"
#include "frangia/service/session_keys.h"

#include "http_server.h"

namespace frangia {

/// The requests of the operator's app: who may send them, and what each one does. It knows the
/// service and no sockets.
class AppRoutes {
 public:
  /// The references must outlive this object. `port` is the server's.
  AppRoutes(Service& service, SessionKeys& keys, std::uint16_t port);

  /// What the server needs.
  [[nodiscard]] HttpApp app() const;
  /// A link that opens the app in one browser, once.
  [[nodiscard]] std::string new_link() const;

 private:
  [[nodiscard]] bool is_from_here(const HttpRequest& request) const;
  [[nodiscard]] HttpResponse answer(const HttpRequest& request) const;
  [[nodiscard]] HttpResponse answer_api(const HttpRequest& request, const std::string& path) const;
  [[nodiscard]] HttpResponse get(const std::string& path) const;
  [[nodiscard]] HttpResponse post(const std::string& path, const std::string& body) const;
  [[nodiscard]] HttpResponse exchange_token(const std::string& body) const;

  Service& service_;
  SessionKeys& keys_;
  std::string address_;    ///< "127.0.0.1:PORT"
  std::string localhost_;  ///< "localhost:PORT"
};

}  // namespace frangia
