#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "frangia/core/error.h"

namespace frangia {

/// Hashes a password by Argon2id with the parameters of libsodium for interactive use, as one line
/// of text that holds salt and parameters.
///
/// @errors   Error(Input) for a password of fewer than 10 bytes; Error(Device) without memory
[[nodiscard]] std::string hash_password(std::string_view password);

/// After too many wrong passwords from an address.
class TooManyTries : public Error {
 public:
  using Error::Error;
};

/// Checks passwords against a hash. After kFreeTries wrong ones from an address, that address waits
/// before each further try, twice as long each time; others do not. Safe to call from several
/// threads.
class PasswordGuard {
 public:
  using Clock = std::chrono::steady_clock;                  ///< measures the pauses
  static constexpr int kFreeTries = 5;                      ///< wrong ones before the first pause
  static constexpr std::chrono::seconds kFirstPause{1};     ///< after them
  static constexpr std::chrono::seconds kLongestPause{60};  ///< after many more
  /// After which a wrong password of an address is forgotten.
  static constexpr std::chrono::hours kMemory{1};
  static constexpr std::size_t kMostAddresses = 1000;  ///< known; the one longest quiet is dropped
  static constexpr std::size_t kLeastBytes = 10;       ///< of a password
  static constexpr std::size_t kMostBytes = 1024;      ///< of a password; longer ones are wrong

  /// `hash` as hash_password returns it; empty: no password opens.
  explicit PasswordGuard(std::string hash) : hash_(std::move(hash)) {}

  /// Whether a password was set.
  [[nodiscard]] bool has_password() const { return !hash_.empty(); }
  /// Whether the password is right.
  ///
  /// `address`: of the client, as client_address returns it
  /// @errors   TooManyTries(Input) that says how long to wait, while the address waits
  [[nodiscard]] bool admits(std::string_view password,
                            const std::string& address,
                            Clock::time_point now = Clock::now());

 private:
  std::mutex mutex_;
  struct Tries {
    int wrong = 0;
    Clock::time_point last;
    Clock::time_point paused_until;
  };

  std::string hash_;
  std::map<std::string, Tries> tries_;  ///< by address
};

/// What counts as one client: an IPv4 address, or the network of an IPv6 address, of which one
/// machine may have any number (its first 64 bits). All addresses of the machine itself
/// (127.0.0.0/8,
/// ::1) are 127.0.0.1. Behind a proxy of this machine it is the last address of X-Forwarded-For,
/// which the proxy wrote, without a port.
[[nodiscard]] std::string client_address(const std::string& peer,
                                         const std::string& forwarded_for,
                                         bool behind_proxy);

}  // namespace frangia
