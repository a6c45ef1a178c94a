#include "app_routes.h"

#include <algorithm>
#include <charconv>
#include <exception>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/error.h"
#include "frangia/core/read_regular_file.h"

#include "web_assets.h"

namespace frangia {
namespace {

constexpr std::string_view kBearer = "Bearer ";
constexpr unsigned kOk = 200;
constexpr unsigned kBadRequest = 400;
constexpr unsigned kUnauthorized = 401;
constexpr unsigned kForbidden = 403;
constexpr unsigned kNotFound = 404;
constexpr unsigned kWrongMethod = 405;
constexpr unsigned kWrongType = 415;
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

AppRoutes::AppRoutes(Service& service, SessionKeys& keys, std::uint16_t port)
    : service_(service),
      keys_(keys),
      address_(fmt::format("127.0.0.1:{}", port)),
      localhost_(fmt::format("localhost:{}", port)) {}

HttpApp AppRoutes::app() const {
  HttpApp app;
  app.answer = [this](const HttpRequest& request) { return answer(request); };
  app.may_connect = [this](const HttpRequest& request) {
    return is_from_here(request) && request.target == "/api/live";
  };
  app.authorizes = [this](std::string_view message) {
    const auto json = nlohmann::json::parse(message, nullptr, false);
    if (!json.is_object() || json.value("type", nlohmann::json()) != "hello") return false;
    const auto key = json.find("key");
    return key != json.end() && key->is_string() && keys_.is_valid(key->get<std::string>());
  };
  app.live_message = [this] { return R"({"type":"state","state":)" + service_.state() + "}"; };
  app.content_security_policy = fmt::format(
      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
      "font-src 'self'; connect-src 'self' ws://{} ws://{}; base-uri 'none'; form-action 'none'; "
      "frame-ancestors 'none'",
      address_,
      localhost_);
  return app;
}

std::string AppRoutes::new_link() const {
  return fmt::format("http://{}/#token={}", address_, keys_.issue_token());
}

/// Refuses other names of this machine (DNS rebinding) and pages of other origins.
bool AppRoutes::is_from_here(const HttpRequest& request) const {
  if (request.host != address_ && request.host != localhost_) return false;
  if (request.fetch_site == "cross-site" || request.fetch_site == "same-site") return false;
  return request.origin.empty() || request.origin == "http://" + address_ ||
         request.origin == "http://" + localhost_;
}

HttpResponse AppRoutes::answer(const HttpRequest& request) const {
  try {
    const std::string path = request.target.substr(0, request.target.find('?'));
    // A link of another page may open the app: the page itself holds nothing.
    const bool page = request.method == "GET" && !path.starts_with("/api/");
    HttpRequest checked = request;
    if (page) checked.fetch_site.clear();
    if (!is_from_here(checked))
      return failure(kForbidden, "this server answers only its own page on this machine");
    if (path.starts_with("/api/")) return answer_api(request, path);
    if (request.method != "GET") return failure(kWrongMethod, "a page is read with GET");
    return asset_at(path);
  } catch (const Error& error) {
    return failure(kBadRequest, error.what());
  } catch (const std::exception& error) {
    return failure(kFailed, error.what());
  }
}

HttpResponse AppRoutes::answer_api(const HttpRequest& request, const std::string& path) const {
  if (request.method != "GET" && request.method != "POST")
    return failure(kWrongMethod, "the methods are GET and POST");
  if (request.method == "POST" && request.content_type != "application/json")
    return failure(kWrongType, "the body is JSON; send Content-Type: application/json");
  if (path == "/api/session") {
    if (request.method != "POST") return failure(kWrongMethod, "a token is exchanged with POST");
    return exchange_token(request.body);
  }
  const std::string& given = request.authorization;
  if (!given.starts_with(kBearer) || !keys_.is_valid(given.substr(kBearer.size())))
    return failure(kUnauthorized,
                   "no valid key was sent; open the app with a new link from `frangia serve "
                   "--new-link`");
  return request.method == "GET" ? get(path) : post(path, request.body);
}

HttpResponse AppRoutes::get(const std::string& path) const {
  if (path == "/api/state") return {.body = service_.state()};
  if (path == "/api/mesh" || path == "/api/selection") {
    const auto bytes = path == "/api/mesh" ? service_.mesh() : service_.selection();
    return bytes ? binary(*bytes) : failure(kNotFound, "there is no surface");
  }
  if (const auto text = rest_of(path, "/api/clouds/")) {
    std::size_t station = 0;
    const char* end = text->data() + text->size();
    const auto [last, error] = std::from_chars(text->data(), end, station);
    std::string bytes;
    if (error == std::errc() && last == end) bytes = service_.cloud(station);
    return bytes.empty() ? failure(kNotFound, "this station has no points") : binary(bytes);
  }
  if (const auto text = rest_of(path, "/api/exports/")) {
    const auto name = percent_decoded(*text);
    if (!name) return failure(kBadRequest, "the name is not percent-encoded");
    const ExportedFile file = service_.exported(*name);
    const auto bytes = read_regular_file(file.path);
    HttpResponse response = binary({bytes.begin(), bytes.end()});
    response.download = file.name;
    return response;
  }
  return failure(kNotFound, "there is no such resource");
}

HttpResponse AppRoutes::post(const std::string& path, const std::string& body) const {
  if (path == "/api/links") {
    const nlohmann::json json{{"url", new_link()}};
    return {.body = json.dump()};
  }
  const auto command = rest_of(path, "/api/commands/");
  if (!command) return failure(kNotFound, "there is no such resource");
  return {.status = kOk, .body = service_.command(*command, body)};
}

HttpResponse AppRoutes::exchange_token(const std::string& body) const {
  const auto json = nlohmann::json::parse(body, nullptr, false);
  const bool has_token = json.is_object() && json.contains("token") && json["token"].is_string();
  const auto key =
      has_token ? keys_.redeem(json["token"].get<std::string>()) : std::optional<std::string>();
  if (!key) {
    return failure(kForbidden,
                   "this link was used already, or is too old; get a new one with `frangia serve "
                   "--new-link`");
  }
  const nlohmann::json answer{{"key", *key}};
  return {.body = answer.dump()};
}

}  // namespace frangia
