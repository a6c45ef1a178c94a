#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

namespace frangia {

/// Hashes a password by Argon2id with the parameters of libsodium for interactive use, as one line
/// of text that holds salt and parameters.
///
/// @errors   Error(Input) for a password of fewer than 10 bytes; Error(Device) without memory
[[nodiscard]] std::string hash_password(std::string_view password);

/// Checks passwords against a hash; after kFreeTries wrong ones it refuses all for a minute. Safe
/// to call from several threads.
class PasswordGuard {
 public:
  using Clock = std::chrono::steady_clock;           ///< measures the pause
  static constexpr int kFreeTries = 5;               ///< wrong ones before it pauses
  static constexpr std::chrono::seconds kPause{60};  ///< after them
  static constexpr std::size_t kLeastBytes = 10;     ///< of a password
  static constexpr std::size_t kMostBytes = 1024;    ///< of a password; longer ones are wrong

  /// `hash` as hash_password returns it; empty: no password opens.
  explicit PasswordGuard(std::string hash) : hash_(std::move(hash)) {}

  /// Whether a password was set.
  [[nodiscard]] bool has_password() const { return !hash_.empty(); }
  /// Whether the password is right.
  ///
  /// @errors   Error(Input) that says how long to wait, while it pauses
  [[nodiscard]] bool admits(std::string_view password, Clock::time_point now = Clock::now());

 private:
  std::mutex mutex_;
  std::string hash_;
  int wrong_ = 0;
  Clock::time_point paused_until_;
};

}  // namespace frangia
