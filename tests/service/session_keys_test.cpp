#include "frangia/service/session_keys.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/temporary_folder.h"

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

/// Sessions in a file.
class SessionsOnDisk : public ::testing::Test {
 protected:
  [[nodiscard]] SessionKeys open(const std::string& password = "a hash") {
    return SessionKeys(file_, password, [this](const std::string& words) { said_ += words; });
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "frangia" / "sessions.json";
  std::string said_;
};

TEST_F(SessionsOnDisk, SurviveTheServerWithTheOneThatOperates) {
  SessionKey first;
  SessionKey second;
  std::string script;
  {
    SessionKeys before = open();
    first = before.admit();
    second = before.redeem(before.issue_token()).value();
    script = before.issue_key();
    before.take_over(second.key);
  }
  const SessionKeys after = open();
  EXPECT_TRUE(after.is_valid(first.key));
  EXPECT_FALSE(after.may_act(first.key));
  EXPECT_TRUE(after.may_act(second.key));
  EXPECT_EQ(after.operator_id(), second.id);
  EXPECT_FALSE(after.is_valid(script)) << "scripts read the file of the running server";
  EXPECT_EQ(said_, "");
}

TEST_F(SessionsOnDisk, HoldNoKeyAndAreReadableByTheirUserAlone) {
  SessionKeys keys = open();
  const SessionKey session = keys.admit();
  std::ifstream stream(file_);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(text.find(session.key), std::string::npos);
  EXPECT_NE(text.find(session.id), std::string::npos);
  struct ::stat state {};
  ASSERT_EQ(::stat(file_.c_str(), &state), 0);
  EXPECT_EQ(state.st_mode & 0777U, 0600U);
  for (const auto& entry : std::filesystem::directory_iterator(file_.parent_path()))
    EXPECT_EQ(entry.path(), file_);
}

TEST_F(SessionsOnDisk, EndWithThePasswordAndWithAFileThatOthersCanReadOrThatIsDamaged) {
  const std::string key = open().admit().key;
  EXPECT_FALSE(open("another hash").is_valid(key));
  std::filesystem::permissions(file_, std::filesystem::perms(0644));
  EXPECT_FALSE(open().is_valid(key));
  EXPECT_NE(said_.find("delete it"), std::string::npos) << said_;
  std::filesystem::permissions(file_, std::filesystem::perms(0600));
  EXPECT_TRUE(open().is_valid(key));
  std::filesystem::rename(file_, folder_.path() / "elsewhere");
  std::filesystem::create_symlink(folder_.path() / "elsewhere", file_);
  EXPECT_FALSE(open().is_valid(key)) << "a link";
  std::filesystem::remove(file_);
  for (const std::string& text : {std::string(), std::string(100'000, '['), std::string("{}")}) {
    std::ofstream(file_) << text;
    std::filesystem::permissions(file_, std::filesystem::perms(0600));
    EXPECT_FALSE(open().is_valid(key)) << text.substr(0, 10);
  }
}

TEST_F(SessionsOnDisk, HoldWhereTheFileCannotBeWrittenAndSayItOnce) {
  std::ofstream(folder_.path() / "frangia") << "a file in the way";
  SessionKeys keys = open();
  const SessionKey session = keys.admit();
  EXPECT_TRUE(keys.is_valid(session.key));
  const std::string said = said_;
  EXPECT_NE(said.find("new links"), std::string::npos);
  static_cast<void>(keys.admit());
  EXPECT_EQ(said_, said);
}

TEST(SessionKeys, EndTheRoleWithTheLastPageOfItsSession) {
  SessionKeys keys;
  const SessionKey first = keys.admit();
  const SessionKey second = keys.admit();
  EXPECT_EQ(keys.arrive(first.key), first.id);
  EXPECT_EQ(keys.arrive(first.key), first.id);
  EXPECT_EQ(keys.arrive(second.key), second.id);
  EXPECT_EQ(keys.arrive("no key"), "");
  EXPECT_FALSE(keys.leave(second.id)) << "it watched";
  EXPECT_FALSE(keys.leave(first.id)) << "another page of it is there";
  EXPECT_FALSE(keys.may_act(second.key));
  EXPECT_TRUE(keys.leave(first.id));
  EXPECT_EQ(keys.operator_id(), "");
  EXPECT_TRUE(keys.may_act(second.key));
  EXPECT_FALSE(keys.may_act("no key"));
  keys.take_over(second.key);
  EXPECT_FALSE(keys.may_act(first.key));
}

}  // namespace
}  // namespace frangia
