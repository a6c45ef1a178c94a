#include "frangia/service/access_guard.h"

#include <gtest/gtest.h>

#include "support/error_of.h"

namespace frangia {
namespace {

using testing::error_of;

TEST(AccessGuard, AdmitsTheRightPasswordOnly) {
  const std::string hash = hash_password("correct horse");
  EXPECT_TRUE(hash.starts_with("$argon2id$"));
  EXPECT_NE(hash, hash_password("correct horse")) << "each hash has a salt of its own";
  PasswordGuard guard(hash);
  EXPECT_TRUE(guard.admits("correct horse"));
  EXPECT_FALSE(guard.admits("correct horse "));
  EXPECT_FALSE(guard.admits(""));
  PasswordGuard none("");
  EXPECT_FALSE(none.has_password());
  EXPECT_FALSE(none.admits(""));
}

TEST(AccessGuard, PausesAfterWrongPasswords) {
  PasswordGuard guard(hash_password("correct horse"));
  const auto now = PasswordGuard::Clock::now();
  for (int i = 0; i < PasswordGuard::kFreeTries; ++i)
    EXPECT_FALSE(guard.admits("guess", now));
  const auto soon = now + PasswordGuard::kPause / 2;
  EXPECT_NE(error_of([&] { static_cast<void>(guard.admits("correct horse", soon)); }).find("30 s"),
            std::string::npos);
  EXPECT_TRUE(guard.admits("correct horse", now + PasswordGuard::kPause));
}

TEST(AccessGuard, RefusesShortAndHugePasswords) {
  EXPECT_NE(error_of([] { static_cast<void>(hash_password("short")); }), "");
  EXPECT_NE(error_of([] { static_cast<void>(hash_password(std::string(2000, 'x'))); }), "");
  PasswordGuard guard(hash_password("correct horse"));
  EXPECT_FALSE(guard.admits(std::string(1'000'000, 'x')));
}

}  // namespace
}  // namespace frangia
