#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace frangia {

/// Returns 256 random bits of the operating system as 43 characters of base64url.
///
/// @errors   Error(Device) when the system has no random numbers
[[nodiscard]] std::string random_key();

/// Compares secrets in a time that depends on the length of `given` only.
[[nodiscard]] bool equal_secrets(std::string_view expected, std::string_view given);

/// The launch tokens and session keys of the operator's app. A token stands in a link and is
/// exchanged once for a key; a key authorizes every request. Safe to call from several threads.
class SessionKeys {
 public:
  using Clock = std::chrono::steady_clock;            ///< measures the life of tokens
  static constexpr std::chrono::hours kTokenLife{1};  ///< from `issue_token` on
  static constexpr std::size_t kMostTokens = 32;      ///< that wait; the oldest is dropped
  static constexpr std::size_t kMostKeys = 64;        ///< browsers; the oldest is dropped

  /// Makes a token for one browser.
  [[nodiscard]] std::string issue_token(Clock::time_point now = Clock::now());
  /// Exchanges a token for a new key. Empty for a token that is unknown, used or too old.
  [[nodiscard]] std::optional<std::string> redeem(std::string_view token,
                                                  Clock::time_point now = Clock::now());
  /// Makes a key without a token, for scripts of the same user.
  [[nodiscard]] std::string issue_key();
  /// Whether a key was issued and not dropped.
  [[nodiscard]] bool is_valid(std::string_view key) const;

 private:
  struct Token {
    std::string text;
    Clock::time_point issued;
  };
  std::string add_key();

  mutable std::mutex mutex_;
  std::deque<Token> tokens_;
  std::deque<std::string> keys_;
};

}  // namespace frangia
