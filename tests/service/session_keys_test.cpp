#include "frangia/service/session_keys.h"

#include <set>

#include <gtest/gtest.h>

namespace frangia {
namespace {

TEST(RandomKey, Has256BitsThatDiffer) {
  std::set<std::string> keys;
  for (int i = 0; i < 100; ++i) {
    keys.insert(random_key());
    EXPECT_EQ(keys.rbegin()->size(), 43U);
  }
  EXPECT_EQ(keys.size(), 100U);
}

TEST(EqualSecrets, ComparesTheWholeText) {
  EXPECT_TRUE(equal_secrets("abc", "abc"));
  EXPECT_FALSE(equal_secrets("abc", "abd"));
  EXPECT_FALSE(equal_secrets("abc", "ab"));
  EXPECT_FALSE(equal_secrets("abc", "abcabc"));
  EXPECT_FALSE(equal_secrets("", ""));  // an unset secret opens nothing
}

TEST(SessionKeys, ExchangesATokenOnce) {
  SessionKeys keys;
  const std::string token = keys.issue_token();
  EXPECT_FALSE(keys.redeem("another"));
  const auto key = keys.redeem(token);
  ASSERT_TRUE(key);
  EXPECT_TRUE(keys.is_valid(key->key));
  EXPECT_FALSE(keys.is_valid(token));
  EXPECT_FALSE(keys.is_valid(""));
  EXPECT_FALSE(keys.redeem(token));
}

TEST(SessionKeys, ForgetsATokenAfterItsLife) {
  SessionKeys keys;
  const auto now = SessionKeys::Clock::now();
  const std::string early = keys.issue_token(now);
  const std::string late = keys.issue_token(now + std::chrono::minutes(30));
  EXPECT_FALSE(keys.redeem(early, now + SessionKeys::kTokenLife + std::chrono::seconds(1)));
  EXPECT_TRUE(keys.redeem(late, now + SessionKeys::kTokenLife + std::chrono::seconds(1)));
}

TEST(SessionKeys, KeepsABoundedNumberOfKeys) {
  SessionKeys keys;
  const std::string first = keys.issue_key();
  for (std::size_t i = 1; i < SessionKeys::kMostKeys; ++i)
    EXPECT_TRUE(keys.is_valid(keys.issue_key()));
  EXPECT_TRUE(keys.is_valid(first));
  static_cast<void>(keys.issue_key());
  EXPECT_FALSE(keys.is_valid(first));
}

TEST(SessionKeys, LetOneSessionActUntilAnotherTakesOver) {
  SessionKeys keys;
  const std::string script = keys.issue_key();
  const SessionKey first = keys.admit();
  const SessionKey second = keys.admit();
  EXPECT_EQ(keys.operator_id(), first.id);
  EXPECT_TRUE(keys.may_act(first.key));
  EXPECT_FALSE(keys.may_act(second.key));
  EXPECT_TRUE(keys.may_act(script)) << "scripts of the same user always act";
  keys.take_over("no key");
  EXPECT_TRUE(keys.may_act(first.key));
  keys.take_over(second.key);
  EXPECT_FALSE(keys.may_act(first.key));
  EXPECT_TRUE(keys.may_act(second.key));
  EXPECT_EQ(keys.operator_id(), second.id);
  EXPECT_FALSE(keys.may_act(second.id)) << "the public name is no key";
}

TEST(SessionKeys, KnowsNoKeyOfAnotherServer) {
  SessionKeys here;
  SessionKeys there;
  EXPECT_FALSE(here.is_valid(there.issue_key()));
}

}  // namespace
}  // namespace frangia
