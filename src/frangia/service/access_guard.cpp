#include "frangia/service/access_guard.h"

#include <array>

#include <fmt/format.h>
#include <sodium.h>

#include "frangia/core/error.h"

namespace frangia {

std::string hash_password(std::string_view password) {
  require(
      password.size() >= PasswordGuard::kLeastBytes && password.size() <= PasswordGuard::kMostBytes,
      fmt::format("a password has {} to {} bytes; choose another one",
                  PasswordGuard::kLeastBytes,
                  PasswordGuard::kMostBytes)
          .c_str());
  std::array<char, crypto_pwhash_STRBYTES> text{};
  if (sodium_init() < 0 || crypto_pwhash_str(text.data(),
                                             password.data(),
                                             password.size(),
                                             crypto_pwhash_OPSLIMIT_INTERACTIVE,
                                             crypto_pwhash_MEMLIMIT_INTERACTIVE) != 0)
    throw Error(ErrorKind::Device, "the password cannot be hashed: memory is short");
  return text.data();
}

bool PasswordGuard::admits(std::string_view password, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  if (now < paused_until_) {
    const auto left = std::chrono::ceil<std::chrono::seconds>(paused_until_ - now);
    throw Error(ErrorKind::Input,
                fmt::format("too many wrong passwords; try again in {} s", left.count()));
  }
  const bool right = !hash_.empty() && password.size() <= kMostBytes && sodium_init() >= 0 &&
                     crypto_pwhash_str_verify(hash_.c_str(), password.data(), password.size()) == 0;
  if (right) {
    wrong_ = 0;
  } else if (++wrong_ >= kFreeTries) {
    wrong_ = 0;
    paused_until_ = now + kPause;
  }
  return right;
}

}  // namespace frangia
