#include "app_routes.h"

#include <algorithm>
#include <charconv>
#include <exception>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/core/error.h"

#include "web_assets.h"

namespace frangia {
namespace {

constexpr std::string_view kBearer = "Bearer ";
constexpr std::string_view kLivePath = "/api/live";
constexpr std::string_view kJsonType = "application/json";
constexpr std::string_view kBytesType = "application/octet-stream";
constexpr std::uint64_t kMostSessionBytes = 4096;  // what is read without a key
constexpr unsigned kOk = 200;
constexpr unsigned kBadRequest = 400;
constexpr unsigned kUnauthorized = 401;
constexpr unsigned kForbidden = 403;
constexpr unsigned kNotFound = 404;
constexpr unsigned kWrongMethod = 405;
constexpr unsigned kConflict = 409;
constexpr unsigned kTooLarge = 413;
constexpr unsigned kWrongType = 415;
constexpr unsigned kTooManyTries = 429;
constexpr unsigned kFailed = 500;

HttpResponse failure(unsigned status, const std::string& sentence) {
  const nlohmann::json json{{"error", sentence}};
  return {.status = status,
          .body = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)};
}

HttpResponse binary(std::string bytes) {
  return {.type = "application/octet-stream", .body = std::move(bytes)};
}

/// What follows `prefix` in a path; empty when it does not begin with it.
std::optional<std::string> rest_of(const std::string& path, std::string_view prefix) {
  if (!path.starts_with(prefix)) return std::nullopt;
  return path.substr(prefix.size());
}

/// Decodes %41; empty for a malformed text.
std::optional<std::string> percent_decoded(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += text[i];
      continue;
    }
    unsigned value = 0;
    const char* begin = text.data() + i + 1;
    if (text.size() - i < 3) return std::nullopt;
    const auto [end, error] = std::from_chars(begin, begin + 2, value, 16);
    if (error != std::errc() || end != begin + 2) return std::nullopt;
    out += static_cast<char>(value);
    i += 2;
  }
  return out;
}

/// The whole number that follows `prefix` in a path; empty when something else does.
std::optional<std::size_t> number_after(const std::string& path, std::string_view prefix) {
  const auto text = rest_of(path, prefix);
  if (!text) return std::nullopt;
  std::size_t number = 0;
  const char* end = text->data() + text->size();
  const auto [last, error] = std::from_chars(text->data(), end, number);
  return error == std::errc() && last == end ? std::optional(number) : std::nullopt;
}

/// Arrays, or that there are none.
HttpResponse found(std::string bytes, const char* otherwise) {
  return bytes.empty() ? failure(kNotFound, otherwise) : binary(std::move(bytes));
}

std::string path_of(const HttpRequest& request) {
  return request.target.substr(0, request.target.find('?'));
}

constexpr const char* kOtherOperates =
    "another browser operates the scanner; take over to act here";
constexpr const char* kOnlyHere = "only a browser on the machine itself lets others in";

/// The key that a request shows; empty without one.
std::string key_of(const HttpRequest& request) {
  return rest_of(request.authorization, kBearer).value_or("");
}

/// The key in the first message of a WebSocket; empty without one.
std::string key_of_hello(std::string_view message) {
  const auto json = nlohmann::json::parse(message, nullptr, false);
  if (!json.is_object() || json.value("type", nlohmann::json()) != "hello") return {};
  const auto key = json.find("key");
  return key != json.end() && key->is_string() ? key->get<std::string>() : std::string();
}

/// Whether Content-Type states JSON, in UTF-8 where it says so, or bytes.
bool is_of_type(const std::string& content_type, bool bytes) {
  std::string text;  // types and names of character sets are case-insensitive
  for (const char c : content_type)
    if (c != ' ' && c != '\t' && c != '"') text += c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  if (bytes) return text == kBytesType;
  return text == kJsonType || text == fmt::format("{};charset=utf-8", kJsonType);
}

HttpResponse asset_at(const std::string& path) {
  const std::string wanted = path == "/" ? "/index.html" : path;
  for (const WebAsset& asset : web_assets()) {
    if (asset.path != wanted) continue;
    return {.type = std::string(asset.type),
            .body = std::string(asset.gzip),
            .gzip = true,
            // Names hold a hash of the content, except for the page itself.
            .cache = wanted == "/index.html" ? "no-cache" : "public, max-age=31536000, immutable"};
  }
  return failure(kNotFound, "there is no such page");
}

}  // namespace

AppRoutes::AppRoutes(Service& service,
                     SessionKeys& keys,
                     PasswordGuard& password,
                     AppAddress address,
                     std::function<void()> on_operator)
    : service_(service),
      keys_(keys),
      password_(password),
      address_(std::move(address)),
      on_operator_(std::move(on_operator)) {}

HttpApp AppRoutes::app() const {
  HttpApp app;
  app.refusal = [this](const HttpRequest& request) { return refusal(request); };
  app.answer = [this](const HttpRequest& request) { return answer(request); };
  app.may_connect = [](const HttpRequest& request) { return request.target == kLivePath; };
  app.authorizes = [this](std::string_view message) {
    return keys_.is_valid(key_of_hello(message));
  };
  app.attend = [this](std::string_view message) -> std::shared_ptr<void> {
    const std::string id = keys_.arrive(key_of_hello(message));
    const auto gone = [this, id, alive = std::weak_ptr<int>(alive_)](int* held) {
      delete held;  // NOLINT(cppcoreguidelines-owning-memory)
      if (!alive.expired() && keys_.leave(id)) on_operator_();
    };
    return {new int(0), gone};  // NOLINT(cppcoreguidelines-owning-memory)
  };
  app.live_message = [this] {
    return fmt::format(
        R"({{"type":"state","operator":"{}","state":{}}})", keys_.operator_id(), service_.state());
  };
  app.channel_of = [](std::string_view message) -> std::optional<int> {
    const auto json = nlohmann::json::parse(message, nullptr, false);
    if (!json.is_object() || json.value("type", nlohmann::json()) != "show") return std::nullopt;
    const auto layer = json.find("layer");
    if (layer == json.end() || !layer->is_string()) return std::nullopt;
    const auto known = find_named<LiveLayer>(layer->get<std::string>());
    return known ? std::optional<int>(static_cast<int>(*known)) : std::nullopt;
  };
  app.picture = [this](int channel, std::uint64_t after) -> HttpPicture {
    try {
      LivePicture picture = service_.live_picture(static_cast<LiveLayer>(channel), after);
      return {picture.revision, std::move(picture.bytes)};
    } catch (const std::exception&) {
      return {};  // the next one may have its memory
    }
  };
  app.content_security_policy = fmt::format(
      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
      "font-src 'self'; connect-src 'self' {}; base-uri 'none'; form-action 'none'; "
      "frame-ancestors 'none'",
      fmt::join(address_.sockets, " "));
  return app;
}

std::string AppRoutes::new_link() const {
  return fmt::format("{}/#token={}", address_.link_base, keys_.issue_token());
}

/// Refuses other names of this machine (DNS rebinding) and pages of other origins.
bool AppRoutes::is_from_here(const HttpRequest& request) const {
  const auto is_in = [](const std::vector<std::string>& list, const std::string& value) {
    return std::find(list.begin(), list.end(), value) != list.end();
  };
  if (!is_in(address_.hosts, request.host)) return false;
  if (request.fetch_site == "cross-site" || request.fetch_site == "same-site") return false;
  return request.origin.empty() || is_in(address_.origins, request.origin);
}

std::optional<HttpResponse> AppRoutes::refusal(const HttpRequest& request) const {
  const std::string path = path_of(request);
  // A link of another page may open the app: the page itself holds nothing.
  const bool page = request.method == "GET" && !path.starts_with("/api/");
  HttpRequest checked = request;
  if (page) checked.fetch_site.clear();
  if (!is_from_here(checked))
    return failure(kForbidden, "this server answers only its own page on this machine");
  if (request.method == "GET" && path == kLivePath)
    return std::nullopt;  // its first message holds the key
  if (path.starts_with("/api/")) return refusal_of_api(request, path);
  if (request.method != "GET") return failure(kWrongMethod, "a page is read with GET");
  return std::nullopt;
}

std::optional<HttpResponse> AppRoutes::refusal_of_api(const HttpRequest& request,
                                                      const std::string& path) const {
  if (request.method != "GET" && request.method != "POST")
    return failure(kWrongMethod, "the methods are GET and POST");
  const bool is_file = path.starts_with("/api/reference/");
  if (request.method == "POST" && !is_of_type(request.content_type, is_file)) {
    return failure(kWrongType,
                   fmt::format("the wrong kind of body; send Content-Type: {}",
                               is_file ? kBytesType : kJsonType));
  }
  if (path == "/api/session") {
    if (request.method != "POST") return failure(kWrongMethod, "a token is exchanged with POST");
    if (request.body_bytes > kMostSessionBytes)
      return failure(kTooLarge, "a token or a password is shorter than this");
    return std::nullopt;
  }
  if (!keys_.is_valid(key_of(request))) {
    return failure(kUnauthorized,
                   "no valid key was sent; open the app with a new link from `frangia serve "
                   "--new-link`");
  }
  return std::nullopt;
}

HttpResponse AppRoutes::answer(const HttpRequest& request) const {
  try {
    const std::string path = path_of(request);
    return path.starts_with("/api/") ? answer_api(request, path) : asset_at(path);
  } catch (const Error& error) {
    return failure(kBadRequest, error.what());
  } catch (const std::exception& error) {
    return failure(kFailed, error.what());
  } catch (...) {
    return failure(kFailed, "the request failed for a reason that has no words");
  }
}

HttpResponse AppRoutes::answer_api(const HttpRequest& request, const std::string& path) const {
  if (path == "/api/session") return begin_session(request);
  if (path == "/api/lan" && request.method == "GET") {
    if (!lan_.state) return failure(kForbidden, kOnlyHere);
    return keys_.may_act(key_of(request)) ? HttpResponse{.body = lan_.state()}
                                          : failure(kConflict, kOtherOperates);
  }
  return request.method == "GET" ? get(path) : post(path, request.body, key_of(request));
}

HttpResponse AppRoutes::get(const std::string& path) const {
  if (path == "/api/state") return {.body = service_.state()};
  if (path == "/api/residuals") return {.body = service_.residuals()};
  if (path == "/api/mesh" || path == "/api/selection") {
    return found(path == "/api/mesh" ? service_.mesh() : service_.selection(),
                 "there is no surface");
  }
  if (path == "/api/reference")
    return found(service_.reference_picture(), "the reference is not shown; show it first");
  if (const auto level = number_after(path, "/api/levels/"))
    return found(service_.level(*level), "the surface has no such level");
  if (const auto level = number_after(path, "/api/selection/"))
    return found(service_.selection(*level), "the surface has no such level");
  if (const auto level = number_after(path, "/api/deviations/"))
    return found(service_.deviations(*level), "there is no comparison of such a level");
  if (path == "/api/preview") return found(service_.preview(), "no edit is previewed");
  if (const auto station = number_after(path, "/api/clouds/"))
    return found(service_.cloud(*station), "this station has no points");
  if (path == "/api/grown-surface")
    return found(service_.grown_surface(), "no scan has made a surface yet");
  if (const auto joined = number_after(path, "/api/setups/"))
    return found(service_.setup_cloud(*joined), "there is no such setup");
  if (const auto text = rest_of(path, "/api/thumbnails/")) {
    const auto name = percent_decoded(*text);
    if (!name) return failure(kBadRequest, "the name is not percent-encoded");
    return found(service_.thumbnail(*name), "this project has no picture");
  }
  if (const auto text = rest_of(path, "/api/exports/")) {
    const auto name = percent_decoded(*text);
    if (!name) return failure(kBadRequest, "the name is not percent-encoded");
    HttpResponse response = binary({});
    response.download = service_.exported(*name).file;
    return response;
  }
  return failure(kNotFound, "there is no such resource");
}

HttpResponse AppRoutes::post(const std::string& path,
                             const std::string& body,
                             const std::string& key) const {
  if (path == "/api/pick") return {.body = service_.pick(body)};
  if (path == "/api/section") return {.body = service_.section(body)};
  if (path == "/api/operator") {
    keys_.take_over(key);
    on_operator_();
    return {.body = "{}"};
  }
  const auto command = rest_of(path, "/api/commands/");
  const auto offset = number_after(path, "/api/reference/");
  if (!command && !offset && path != "/api/links" && path != "/api/lan")
    return failure(kNotFound, "there is no such resource");
  if (!keys_.may_act(key)) return failure(kConflict, kOtherOperates);
  if (keys_.operator_id().empty()) {  // who acts where nobody operates has the role
    keys_.take_over(key);
    on_operator_();
  }
  if (path == "/api/links") {
    const nlohmann::json json{{"url", new_link()}};
    return {.body = json.dump()};
  }
  if (path == "/api/lan") return post_lan(body);
  if (offset) {
    service_.add_to_reference(*offset, body);
    return {.body = "{}"};
  }
  return {.status = kOk, .body = service_.command(*command, body)};
}

HttpResponse AppRoutes::post_lan(const std::string& body) const {
  if (!lan_.open) return failure(kForbidden, kOnlyHere);
  const auto json = nlohmann::json::parse(body, nullptr, false);
  const auto address = json.is_object() ? json.find("address") : json.end();
  const bool has_address = json.is_object() && address != json.end();
  if (!json.is_object() || (has_address && !address->is_string()))
    return failure(kBadRequest, "address: is an IP address of this machine, or nothing to close");
  const auto encrypted = json.value("encrypted", nlohmann::json(false));
  if (!encrypted.is_boolean()) return failure(kBadRequest, "encrypted: is true or false");
  if (has_address) {
    lan_.open(address->get<std::string>(), encrypted.get<bool>());
  } else {
    lan_.close();
  }
  return {.body = lan_.state()};
}

HttpResponse AppRoutes::begin_session(const HttpRequest& request) const {
  const auto json = nlohmann::json::parse(request.body, nullptr, false);
  const auto text = [&](const char* key) -> std::string {
    const bool has = json.is_object() && json.contains(key) && json[key].is_string();
    return has ? json[key].get<std::string>() : std::string();
  };
  std::optional<SessionKey> session;
  const std::string password = text("password");
  if (!password.empty() && password_.has_password()) {
    const std::string client =
        client_address(request.peer, request.forwarded_for, address_.behind_proxy);
    try {
      if (password_.admits(password, client)) session = keys_.admit();
    } catch (const TooManyTries& error) {
      return failure(kTooManyTries, error.what());
    }
    if (!session) return failure(kForbidden, "the password is wrong");
  } else {
    session = keys_.redeem(text("token"));
  }
  if (!session) {
    return failure(kForbidden,
                   "this link was used already, or is too old; get a new one with `frangia serve "
                   "--new-link`");
  }
  const nlohmann::json answer{{"key", session->key}, {"id", session->id}};
  return {.body = answer.dump()};
}

}  // namespace frangia
