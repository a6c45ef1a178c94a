#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
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

/// A key and the public name of its session.
struct SessionKey {
  std::string key;  ///< secret
  std::string id;   ///< shown to other sessions
};

/// The launch tokens and session keys of the operator's app. A token stands in a link and is
/// exchanged once for a key; a key authorizes every request. One session operates, the others watch
/// until they take over; the role ends with the last page of its session, and who acts next has it.
/// Scripts of the same user may always act. Safe to call from several
/// threads.
class SessionKeys {
 public:
  /// Keys that end with this object.
  SessionKeys() = default;
  /// Keys of browsers that outlive this object: `file` holds their SHA-256, from which nobody gets
  /// 256 random bits back, with mode 0600. Those of an earlier object hold, unless they are older
  /// than kKeyLife, another password was set since, or the file is not this user's alone. Where it
  /// cannot be written, `warn` gets a sentence and the keys end with this object.
  ///
  /// `password_hash`: as hash_password returns it; empty without one
  SessionKeys(std::filesystem::path file,
              std::string_view password_hash,
              std::function<void(const std::string&)> warn);

  using Clock = std::chrono::steady_clock;            ///< measures the life of tokens
  static constexpr std::chrono::hours kTokenLife{1};  ///< from `issue_token` on
  static constexpr std::size_t kMostTokens = 32;      ///< that wait; the oldest is dropped
  static constexpr std::size_t kMostKeys = 64;        ///< browsers; the oldest is dropped
  static constexpr std::chrono::days kKeyLife{30};    ///< of a key in the file

  /// Makes a token for one browser.
  [[nodiscard]] std::string issue_token(Clock::time_point now = Clock::now());
  /// Exchanges a token for a new key. Empty for a token that is unknown, used or too old.
  [[nodiscard]] std::optional<SessionKey> redeem(std::string_view token,
                                                 Clock::time_point now = Clock::now());
  /// Makes a key without a token, for a browser that gave the password.
  [[nodiscard]] SessionKey admit();
  /// Makes a key for scripts of the same user.
  [[nodiscard]] std::string issue_key();
  /// Whether a valid key may change something: that of the operator or of a script, and any where
  /// nobody operates.
  [[nodiscard]] bool may_act(std::string_view key) const;
  /// A page of a session is connected from now on. Returns the public name of the session; empty
  /// for a key that is not valid.
  [[nodiscard]] std::string arrive(std::string_view key);
  /// A page of a session is gone. Returns whether nobody operates since.
  bool leave(std::string_view id);
  /// Makes the session of a valid key the operator.
  void take_over(std::string_view key);
  /// Public name of the session that operates; empty before the first one.
  [[nodiscard]] std::string operator_id() const;
  /// Whether a key was issued and not dropped.
  [[nodiscard]] bool is_valid(std::string_view key) const;

 private:
  struct Token {
    std::string text;
    Clock::time_point issued;
  };
  struct Key {
    std::string digest;  ///< SHA-256 of the key
    std::string id;
    bool script = false;
    std::int64_t issued_s = 0;  ///< seconds since 1970
  };
  SessionKey add_key(bool script);
  [[nodiscard]] const Key* find(std::string_view key) const;
  void load();
  void save() noexcept;

  mutable std::mutex mutex_;
  std::deque<Token> tokens_;
  std::deque<Key> keys_;
  std::string operator_id_;
  std::map<std::string, int, std::less<>> pages_;  ///< that are connected, by session
  std::filesystem::path file_;                     ///< empty: none
  std::string password_;                           ///< SHA-256 of the password's hash
  std::function<void(const std::string&)> warn_;
  bool said_ = false;  ///< that the file cannot be written
};

}  // namespace frangia
