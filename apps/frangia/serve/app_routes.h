#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "frangia/service/access_guard.h"
#include "frangia/service/service.h"
#include "frangia/service/session_keys.h"

#include "app_address.h"
#include "http_server.h"

namespace frangia {

/// How the operator lets browsers of other machines in. Empty functions: it is not offered, as to
/// those browsers themselves.
struct LanAccess {
  std::function<std::string()> state;  ///< as `GET /api/lan` answers
  /// At an address of this machine, with TLS or without.
  std::function<void(const std::string& address, bool encrypted)> open;
  std::function<void()> close;
};

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

  /// Offers to let browsers of other machines in; before `app`.
  void offer(LanAccess lan) { lan_ = std::move(lan); }
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
  [[nodiscard]] HttpResponse post_lan(const std::string& body) const;
  [[nodiscard]] HttpResponse begin_session(const HttpRequest& request) const;

  Service& service_;
  SessionKeys& keys_;
  PasswordGuard& password_;
  AppAddress address_;
  LanAccess lan_;
  std::function<void()> on_operator_;                      ///< another session operates
  std::shared_ptr<int> alive_ = std::make_shared<int>(0);  ///< ends with this object
};

}  // namespace frangia
