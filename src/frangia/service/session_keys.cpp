#include "frangia/service/session_keys.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>

#include <sys/random.h>

#include "frangia/core/error.h"

namespace frangia {

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
  return add_key(false).session;
}

SessionKey SessionKeys::admit() {
  const std::lock_guard lock(mutex_);
  return add_key(false).session;
}

std::string SessionKeys::issue_key() {
  const std::lock_guard lock(mutex_);
  return add_key(true).session.key;
}

bool SessionKeys::is_valid(std::string_view key) const {
  const std::lock_guard lock(mutex_);
  return find(key) != nullptr;
}

bool SessionKeys::may_act(std::string_view key) const {
  const std::lock_guard lock(mutex_);
  const Key* known = find(key);
  return known != nullptr && (known->script || known->session.id == operator_id_);
}

void SessionKeys::take_over(std::string_view key) {
  const std::lock_guard lock(mutex_);
  if (const Key* known = find(key)) operator_id_ = known->session.id;
}

std::string SessionKeys::operator_id() const {
  const std::lock_guard lock(mutex_);
  return operator_id_;
}

const SessionKeys::Key* SessionKeys::find(std::string_view key) const {
  const Key* found = nullptr;  // all are compared, so that the time tells nothing
  for (const Key& one : keys_)
    if (equal_secrets(one.session.key, key)) found = &one;
  return found;
}

const SessionKeys::Key& SessionKeys::add_key(bool script) {
  if (keys_.size() >= kMostKeys) {
    const auto oldest =
        std::find_if(keys_.begin(), keys_.end(), [](const Key& one) { return !one.script; });
    keys_.erase(oldest != keys_.end() ? oldest : keys_.begin());
  }
  constexpr std::size_t kIdLength = 8;
  keys_.push_back({{random_key(), random_key().substr(0, kIdLength)}, script});
  if (!script && operator_id_.empty()) operator_id_ = keys_.back().session.id;
  return keys_.back();
}

}  // namespace frangia
