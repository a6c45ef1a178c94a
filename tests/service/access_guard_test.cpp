#include "frangia/service/access_guard.h"

#include <gtest/gtest.h>

#include "support/error_of.h"

namespace frangia {
namespace {

using testing::error_of;

const std::string kHere = "127.0.0.1";

TEST(AccessGuard, AdmitsTheRightPasswordOnly) {
  const std::string hash = hash_password("correct horse");
  EXPECT_TRUE(hash.starts_with("$argon2id$"));
  EXPECT_NE(hash, hash_password("correct horse")) << "each hash has a salt of its own";
  PasswordGuard guard(hash);
  EXPECT_TRUE(guard.admits("correct horse", kHere));
  EXPECT_FALSE(guard.admits("correct horse ", kHere));
  EXPECT_FALSE(guard.admits("", kHere));
  PasswordGuard none("");
  EXPECT_FALSE(none.has_password());
  EXPECT_FALSE(none.admits("", kHere));
}

TEST(AccessGuard, DelaysAnAddressAfterWrongPasswordsTwiceAsLongEachTime) {
  PasswordGuard guard(hash_password("correct horse"));
  auto now = PasswordGuard::Clock::now();
  for (int i = 0; i < PasswordGuard::kFreeTries; ++i)
    EXPECT_FALSE(guard.admits("guess", kHere, now));
  for (const int pause_s : {1, 2}) {
    const auto soon = now + std::chrono::milliseconds(1000 * pause_s - 1);
    EXPECT_THROW(static_cast<void>(guard.admits("correct horse", kHere, now)), TooManyTries);
    EXPECT_NE(error_of([&] {
                static_cast<void>(guard.admits("correct horse", kHere, soon));
              }).find("from 127.0.0.1; try again in 1 s"),
              std::string::npos);
    now += std::chrono::seconds(pause_s);
    EXPECT_FALSE(guard.admits("guess", kHere, now));
  }
  EXPECT_TRUE(guard.admits("correct horse", kHere, now + std::chrono::seconds(4)));
  EXPECT_FALSE(guard.admits("guess", kHere, now + std::chrono::seconds(4))) << "starts over";
  EXPECT_TRUE(guard.admits("correct horse", kHere, now + std::chrono::seconds(4)));
}

TEST(AccessGuard, DelaysNoOtherAddress) {
  PasswordGuard guard(hash_password("correct horse"));
  const auto now = PasswordGuard::Clock::now();
  for (int i = 0; i < PasswordGuard::kFreeTries; ++i)
    EXPECT_FALSE(guard.admits("guess", "192.168.1.66", now));
  EXPECT_THROW(static_cast<void>(guard.admits("correct horse", "192.168.1.66", now)), TooManyTries);
  EXPECT_TRUE(guard.admits("correct horse", "192.168.1.5", now));
}

TEST(AccessGuard, CountsTheNetworkOfAnIpv6AddressAndTheClientOfAProxyOnThisMachine) {
  EXPECT_EQ(client_address("192.168.1.5", "10.0.0.1", false), "192.168.1.5");
  EXPECT_EQ(client_address("127.0.0.1", "", true), "127.0.0.1");
  EXPECT_EQ(client_address("127.0.0.1", "10.0.0.1", false), "127.0.0.1") << "anybody may write it";
  EXPECT_EQ(client_address("127.0.0.1", "1.2.3.4, 10.0.0.1", true), "10.0.0.1")
      << "the client may have written the first one";
  EXPECT_EQ(client_address("192.168.1.5", "10.0.0.1", true), "192.168.1.5")
      << "it did not come through the proxy";
  EXPECT_EQ(client_address("2001:db8:1:2:3:4:5:6", "", false), "2001:db8:1:2::/64");
  EXPECT_EQ(client_address("2001:db8:1:2::9", "", false), "2001:db8:1:2::/64");
  EXPECT_EQ(client_address("::ffff:192.168.1.5", "", false), "192.168.1.5");
}

TEST(AccessGuard, TakesAllAddressesOfTheMachineItselfForOneClient) {
  for (const char* peer : {"127.0.0.1", "127.9.8.7", "127.255.255.254", "::ffff:127.0.0.2", "::1"})
    EXPECT_EQ(client_address(peer, "", false), "127.0.0.1") << peer;
  EXPECT_EQ(client_address("::ffff:127.0.0.1", "10.0.0.1", true), "10.0.0.1");
}

TEST(AccessGuard, DropsThePortThatAProxyWritesBehindAnAddress) {
  EXPECT_EQ(client_address("127.0.0.1", "1.2.3.4:5678", true), "1.2.3.4");
  EXPECT_EQ(client_address("127.0.0.1", "9.9.9.9, [2001:db8:1:2::9]:443", true),
            "2001:db8:1:2::/64");
  EXPECT_EQ(client_address("127.0.0.1", "2001:db8:1:2::9", true), "2001:db8:1:2::/64");
  EXPECT_EQ(client_address("127.0.0.1", "[", true), "");
}

TEST(AccessGuard, RefusesShortAndHugePasswords) {
  EXPECT_NE(error_of([] { static_cast<void>(hash_password("short")); }), "");
  EXPECT_NE(error_of([] { static_cast<void>(hash_password(std::string(2000, 'x'))); }), "");
  PasswordGuard guard(hash_password("correct horse"));
  EXPECT_FALSE(guard.admits(std::string(1'000'000, 'x'), kHere));
}

}  // namespace
}  // namespace frangia
