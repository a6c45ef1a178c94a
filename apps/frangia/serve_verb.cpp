#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/read_file.h"
#include "frangia/service/access_guard.h"
#include "frangia/service/service.h"
#include "frangia/service/session_keys.h"

#include "ask.h"
#include "drivers.h"
#include "interrupt.h"
#include "option_values.h"
#include "print_page.h"
#include "print_text.h"
#include "serve/app_address.h"
#include "serve/app_routes.h"
#include "serve/command_lines.h"
#include "serve/http_server.h"
#include "serve/lan_door.h"
#include "serve/own_certificate.h"
#include "serve/runtime_file.h"
#include "show_file.h"
#include "verbs.h"

namespace frangia {
namespace {

/// Used when it is free and no other port was asked for; the wavelength of a He-Ne laser, 632.8 nm.
constexpr std::uint16_t kUsualPort = 6328;

struct ServeArguments {
  std::filesystem::path project;
  std::filesystem::path projects;
  std::optional<std::uint16_t> port;
  bool open = false;
  bool new_link = false;
  bool set_password = false;
  NetworkAccess access;
};

/// A folder of the XDG base directories, such as $XDG_DATA_HOME, by default in the home folder.
std::filesystem::path user_folder(const char* variable, const char* in_home) {
  const auto value_of = [](const char* name) -> std::filesystem::path {
    const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): before any thread
    return value != nullptr && *value == '/' ? value : "";
  };
  if (auto folder = value_of(variable); !folder.empty()) return folder / "frangia";
  const auto home = value_of("HOME");
  return home.empty() ? home : home / in_home / "frangia";
}

/// $XDG_DATA_HOME/frangia/projects, by default in ~/.local/share.
std::filesystem::path usual_projects() {
  const auto data = user_folder("XDG_DATA_HOME", ".local/share");
  return data.empty() ? std::filesystem::absolute("frangia-projects") : data / "projects";
}

/// The hash of the password for other machines: $XDG_CONFIG_HOME/frangia/serve-password.
std::filesystem::path password_file() {
  return user_folder("XDG_CONFIG_HOME", ".config") / "serve-password";
}

/// The certificate of this machine for tablets: $XDG_CONFIG_HOME/frangia/serve-certificate.pem.
/// Empty without a home folder.
std::filesystem::path certificate_file() {
  const auto folder = user_folder("XDG_CONFIG_HOME", ".config");
  return folder.empty() ? folder : folder / "serve-certificate.pem";
}

/// The sessions of a port, which pages name in their address:
/// $XDG_STATE_HOME/frangia/serve-sessions-6328.json. Empty for a port that the system chose, to
/// which no page returns.
std::filesystem::path sessions_file(const ServeArguments& arguments, std::uint16_t port) {
  const auto folder = user_folder("XDG_STATE_HOME", ".local/state");
  if (folder.empty() || port != arguments.port.value_or(kUsualPort)) return {};
  return folder / fmt::format("serve-sessions-{}.json", port);
}

std::string read_password_hash() {
  std::error_code ignored;
  const auto file = password_file();
  if (!std::filesystem::exists(file, ignored)) return {};
  std::string text = read_text_file(file);
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  return text;
}

/// Reads the password from standard input, so that no history of commands holds it.
void set_password(Terminal& terminal) {
  const Run run = terminal.run();
  const auto password = read_answer("password, 10 bytes or more:", run);
  require(password.has_value(), "no password was given on standard input");
  const auto file = password_file();
  make_folder(file.parent_path());
  write_private_file(file, hash_password(*password) + '\n', Durability::Synced);
  print_text("wrote {}\n", file.string());
}

/// `tls_pem`: a certificate with its key; empty without encryption
std::unique_ptr<HttpServer> listen(const ServeArguments& arguments, const std::string& tls_pem) {
  const std::string address =
      arguments.access.listen.empty() ? "127.0.0.1" : arguments.access.listen;
  const auto at = [&](std::uint16_t port) {
    return std::make_unique<HttpServer>(address, port, HttpLimits{}, tls_pem);
  };
  if (arguments.port) return at(*arguments.port);
  try {
    return at(kUsualPort);
  } catch (const Error& error) {  // in use; any other one serves as well
    if (error.kind() != ErrorKind::Device) throw;
    return at(0);
  }
}

/// The certificate by which browsers on other machines are answered; empty without encryption.
OwnCertificate certificate_for(const NetworkAccess& access) {
  if (!access.encrypts()) return {};
  std::vector<std::string> addresses = network_addresses();
  const bool all = access.listen == "0.0.0.0" || access.listen == "::";
  if (!all && std::find(addresses.begin(), addresses.end(), access.listen) == addresses.end())
    addresses.push_back(access.listen);
  return own_certificate(certificate_file(), addresses);
}

/// `fingerprint`: of the certificate; empty without one
void print_link(const std::string& link,
                const std::string& fingerprint,
                const std::filesystem::path& projects,
                Terminal& terminal) {
  if (terminal.json) {
    nlohmann::ordered_json json{{"url", link}, {"projects", projects.string()}};
    if (!fingerprint.empty()) json["fingerprint"] = fingerprint;
    print_json(json);
  } else {
    print_text("the app is at {}\n", link);
    if (!fingerprint.empty()) {
      print_text(
          "No browser knows the certificate of this machine; compare its SHA-256 fingerprint:\n"
          "{}\n",
          fingerprint);
    }
    if (!terminal.quiet) {
      print_text("The link opens one browser. Projects are in {}. Stop with Ctrl-C.\n",
                 projects.string());
    }
  }
  flush_output();
}

void serve(ServeArguments& arguments, Terminal& terminal) {
  if (arguments.new_link) {
    print_text("{}\n", ask_for_link());
    return;
  }
  if (arguments.set_password) return set_password(terminal);
  const std::string password_hash = read_password_hash();
  PasswordGuard password(password_hash);
  arguments.access.check(password.has_password());
  if (arguments.projects.empty()) arguments.projects = usual_projects();
  arguments.projects = std::filesystem::absolute(arguments.projects).lexically_normal();
  const Run run = terminal.run();
  const OwnCertificate certificate = certificate_for(arguments.access);
  const std::unique_ptr<HttpServer> server = listen(arguments, certificate.pem);
  LanDoor door(certificate_file());
  const auto announce = [&server, &door] {
    server->announce_change();
    door.announce_change();
  };
  ServiceOptions options;
  options.projects = arguments.projects;
  options.version = FRANGIA_VERSION;
  options.command_lines = command_lines;
  options.print_page = print_page;
  options.on_picture = [&server, &door] {
    server->announce_picture();
    door.announce_picture();
  };
  options.capture = {
      .drivers = [] { return all_drivers(); },
      .board_drivers = [](const SimulatedBoard& board) { return all_drivers(board); },
      .guardian = guardian_program(),
      .hold_devices = [] { return std::make_shared<DeviceScope>(); }};
  Service service(std::move(options), announce);
  if (!arguments.project.empty()) service.open_folder(arguments.project);
  SessionKeys keys(sessions_file(arguments, server->port()),
                   password_hash,
                   [&run](const std::string& sentence) { run.warn(sentence); });
  AppRoutes routes(
      service, keys, password, app_address(arguments.access, server->port()), announce);
  const auto say_closed = [&run](const std::string& words) {
    run.warn(fmt::format("a connection was closed: {}", words));
  };
  // From the network itself nobody widens the access to it.
  if (arguments.access.listen.empty() && !arguments.access.behind_proxy)
    routes.offer(door.access(service, keys, announce, say_closed));
  const std::shared_ptr<void> closing(nullptr, [&door](void*) { door.close(); });
  const RuntimeFile file(server->port(), keys.issue_key());
  const std::string link = routes.new_link();
  print_link(link, certificate.fingerprint, arguments.projects, terminal);
  std::optional<LinkPage> page;
  std::jthread opener;  // xdg-open may last as long as the browser, which the server must answer
  if (arguments.open) {
    page.emplace(link);
    opener = std::jthread([&run, &page](const std::stop_token& stop) {
      if (!show_file(page->path(), stop))
        run.warn("xdg-open cannot show the link; open it yourself");
    });
  }
  HttpApp app = routes.app();
  app.on_exception = say_closed;
  server->serve(std::move(app), run.stop);
}

}  // namespace

void add_serve_verb(CLI::App& program, Terminal& terminal) {
  auto arguments = std::make_shared<ServeArguments>();
  CLI::App* verb = program.add_subcommand(
      "serve", "the operator's app: scan, view, edit and export in a browser");
  verb->footer(
      "example:\n  frangia serve --open\n  frangia serve out/demo/bust-scan --open\n"
      "The server answers on 127.0.0.1 only, unless --listen says otherwise, and only browsers "
      "that "
      "were given a link or the password.");
  verb->add_option("PROJECT", arguments->project, "project or scan folder to open first");
  verb->add_option("--projects",
                   arguments->projects,
                   "folder of the projects; default: $XDG_DATA_HOME/frangia/projects");
  verb->add_option("--port",
                   arguments->port,
                   "port to listen on; 0 for any; default: 6328, or any if it is in use")
      ->check(from_to(0, 65535));
  verb->add_flag("--open", arguments->open, "open the app in the desktop's browser");
  verb->add_flag("--new-link",
                 arguments->new_link,
                 "print a link for one more browser to the server that runs");
  verb->add_option("--listen",
                   arguments->access.listen,
                   "IP address of this machine for browsers on others, encrypted by a certificate "
                   "of its own; default: 127.0.0.1");
  verb->add_flag("--behind-proxy",
                 arguments->access.behind_proxy,
                 "browsers come through a reverse proxy that adds TLS");
  verb->add_flag(
      "--plain-lan",
      arguments->access.plain_lan,
      "answer other machines without encryption; anyone on the network can read the traffic");
  verb->add_option("--allowed-host",
                   arguments->access.allowed_hosts,
                   "name, and port if not the usual one, by which browsers reach the server");
  verb->add_flag("--set-password",
                 arguments->set_password,
                 "read the password for other machines from standard input");
  verb->callback([arguments, &terminal] { serve(*arguments, terminal); });
}

}  // namespace frangia
