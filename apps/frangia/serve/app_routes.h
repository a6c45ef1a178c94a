#pragma once

#include <functional>
#include <optional>
#include <string>

#include "frangia/service/access_guard.h"
#include "frangia/service/service.h"
#include "frangia/service/session_keys.h"

#include "app_address.h"
#include "http_server.h"

namespace frangia {

/// The requests of the operator's app: who may send them, and what each one does. It knows the
/// service and no sockets.
class AppRoutes {
 public:
  /// The references must outlive this object.
  AppRoutes(Service& service,
            SessionKeys& keys,
            PasswordGuard& password,
            AppAddress address,
            std::function<void()> on_operator);

  /// What the server needs.
  [[nodiscard]] HttpApp app() const;
  /// A link that opens the app in one browser, once.
  [[nodiscard]] std::string new_link() const;

 private:
  [[nodiscard]] bool is_from_here(const HttpRequest& request) const;
  [[nodiscard]] std::optional<HttpResponse> refusal(const HttpRequest& request) const;
  [[nodiscard]] std::optional<HttpResponse> refusal_of_api(const HttpRequest& request,
                                                           const std::string& path) const;
  [[nodiscard]] HttpResponse answer(const HttpRequest& request) const;
  [[nodiscard]] HttpResponse answer_api(const HttpRequest& request, const std::string& path) const;
  [[nodiscard]] HttpResponse get(const std::string& path) const;
  [[nodiscard]] HttpResponse post(const std::string& path,
                                  const std::string& body,
                                  const std::string& key) const;
  [[nodiscard]] HttpResponse begin_session(const HttpRequest& request) const;

  Service& service_;
  SessionKeys& keys_;
  PasswordGuard& password_;
  AppAddress address_;
  std::function<void()> on_operator_;  ///< another session operates
};

}  // namespace frangia
