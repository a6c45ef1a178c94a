#include "frangia/service/session_keys.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include "frangia/core/checksums.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/open_below.h"
#include "frangia/service/internal/project_names.h"

namespace frangia {
namespace {

constexpr std::size_t kDigestLength = 64;  // of SHA-256 in hexadecimal digits

}  // namespace

std::string random_key() {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  constexpr std::size_t kBytes = 32;
  std::array<std::uint8_t, kBytes> bytes{};
  ssize_t count = 0;
  do {
    count = ::getrandom(bytes.data(), bytes.size(), 0);
  } while (count < 0 && errno == EINTR);
  if (count != static_cast<ssize_t>(bytes.size()))
    throw Error(ErrorKind::Device, "the operating system gives no random numbers for a key");
  std::string text;
  std::uint32_t bits = 0;
  int available = 0;
  for (const std::uint8_t byte : bytes) {
    bits = bits << 8U | byte;
    for (available += 8; available >= 6; available -= 6)
      text += kLetters[bits >> static_cast<unsigned>(available - 6) & 63U];
  }
  text += kLetters[bits << static_cast<unsigned>(6 - available) & 63U];
  return text;
}

bool equal_secrets(std::string_view expected, std::string_view given) {
  unsigned difference = expected.size() == given.size() && !expected.empty() ? 0U : 1U;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const char other = expected.empty() ? '\0' : expected[i % expected.size()];
    difference |= static_cast<unsigned>(static_cast<unsigned char>(given[i] ^ other));
  }
  return difference == 0U;
}

SessionKeys::SessionKeys(std::filesystem::path file,
                         std::string_view password_hash,
                         std::function<void(const std::string&)> warn)
    : file_(std::move(file)), password_(sha256(password_hash)), warn_(std::move(warn)) {
  load();
}

std::string SessionKeys::issue_token(Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  if (tokens_.size() >= kMostTokens) tokens_.pop_front();
  tokens_.push_back({random_key(), now});
  return tokens_.back().text;
}

std::optional<SessionKey> SessionKeys::redeem(std::string_view token, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  std::erase_if(tokens_, [&](const Token& one) { return now - one.issued > kTokenLife; });
  const auto found = std::find_if(tokens_.begin(), tokens_.end(), [&](const Token& one) {
    return equal_secrets(one.text, token);
  });
  if (found == tokens_.end()) return std::nullopt;
  tokens_.erase(found);
  return add_key(false);
}

SessionKey SessionKeys::admit() {
  const std::lock_guard lock(mutex_);
  return add_key(false);
}

std::string SessionKeys::issue_key() {
  const std::lock_guard lock(mutex_);
  return add_key(true).key;
}

bool SessionKeys::is_valid(std::string_view key) const {
  const std::lock_guard lock(mutex_);
  return find(key) != nullptr;
}

bool SessionKeys::may_act(std::string_view key) const {
  const std::lock_guard lock(mutex_);
  const Key* known = find(key);
  return known != nullptr && (known->script || operator_id_.empty() || known->id == operator_id_);
}

std::string SessionKeys::arrive(std::string_view key) {
  const std::lock_guard lock(mutex_);
  const Key* known = find(key);
  if (known == nullptr) return {};
  ++pages_[known->id];
  return known->id;
}

bool SessionKeys::leave(std::string_view id) {
  const std::lock_guard lock(mutex_);
  const auto found = pages_.find(id);
  if (found == pages_.end() || --found->second > 0) return false;
  pages_.erase(found);
  if (operator_id_ != id) return false;
  operator_id_.clear();  // the file keeps it: after a restart the page may come back
  return true;
}

void SessionKeys::take_over(std::string_view key) {
  const std::lock_guard lock(mutex_);
  const Key* known = find(key);
  if (known != nullptr && !known->script) operator_id_ = known->id;
  save();
}

std::string SessionKeys::operator_id() const {
  const std::lock_guard lock(mutex_);
  return operator_id_;
}

const SessionKeys::Key* SessionKeys::find(std::string_view key) const {
  const std::string digest = sha256(key);
  const Key* found = nullptr;  // all are compared, so that the time tells nothing
  for (const Key& one : keys_)
    if (equal_secrets(one.digest, digest)) found = &one;
  return found;
}

SessionKey SessionKeys::add_key(bool script) {
  if (keys_.size() >= kMostKeys) {
    const auto oldest =
        std::find_if(keys_.begin(), keys_.end(), [](const Key& one) { return !one.script; });
    keys_.erase(oldest != keys_.end() ? oldest : keys_.begin());
  }
  constexpr std::size_t kIdLength = 8;
  SessionKey session{random_key(), random_key().substr(0, kIdLength)};
  keys_.push_back({sha256(session.key), session.id, script, seconds_since_1970()});
  if (!script && operator_id_.empty()) operator_id_ = session.id;
  if (!script) save();
  return session;
}

void SessionKeys::load() {
  struct ::stat state {};
  if (::lstat(file_.c_str(), &state) != 0) return;
  if (!S_ISREG(state.st_mode) || state.st_uid != ::geteuid() || (state.st_mode & 077U) != 0) {
    warn_(
        fmt::format("{}: is not readable by you alone, and its sessions are not accepted; delete "
                    "it",
                    file_.string()));
    return;
  }
  try {
    const auto json = nlohmann::json::parse(read_json_below(file_.parent_path(), file_.filename()));
    if (json.at("password").get<std::string>() != password_) return;
    for (const nlohmann::json& one : json.at("sessions")) {
      Key key{.digest = one.at("sha256").get<std::string>(),
              .id = one.at("id").get<std::string>(),
              .issued_s = one.at("issued_s").get<std::int64_t>()};
      const std::chrono::seconds age(seconds_since_1970() - key.issued_s);
      if (key.digest.size() == kDigestLength && age <= kKeyLife && keys_.size() < kMostKeys)
        keys_.push_back(std::move(key));
    }
    operator_id_ = json.at("operator").get<std::string>();
  } catch (
      const std::exception&) {  // damaged, as a power cut may leave it: browsers take new links
    keys_.clear();
  }
  const auto operates = [&](const Key& key) { return key.id == operator_id_; };
  if (std::none_of(keys_.begin(), keys_.end(), operates)) operator_id_.clear();
}

void SessionKeys::save() noexcept {
  if (file_.empty()) return;
  try {
    nlohmann::ordered_json json{{"password", password_}, {"operator", operator_id_}};
    json["sessions"] = nlohmann::ordered_json::array();
    for (const Key& key : keys_) {
      if (key.script) continue;
      json["sessions"].push_back(
          {{"sha256", key.digest}, {"id", key.id}, {"issued_s", key.issued_s}});
    }
    make_folder(file_.parent_path());
    write_private_file(file_, json.dump(1) + '\n');
  } catch (const std::exception& error) {
    if (std::exchange(said_, true)) return;
    warn_(
        fmt::format("browsers will need new links when the server starts again: {}", error.what()));
  }
}

}  // namespace frangia
