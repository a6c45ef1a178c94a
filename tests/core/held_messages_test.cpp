// Messages that are held back until a result is used.
#include "frangia/core/held_messages.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

struct HeldMessagesTest : ::testing::Test {
  std::vector<std::string> given;
  frangia::Run run;
  HeldMessagesTest() {
    run.on_warning = [this](const std::string& text) { given.push_back(text); };
  }
};

TEST_F(HeldMessagesTest, AreGivenWhenTheirAttemptIsUsed) {
  HeldMessages held;
  const int found = held.during(run, [](const frangia::Run& attempt) {
    attempt.warn("a view is dark");
    return 3;
  });
  EXPECT_EQ(found, 3);
  EXPECT_TRUE(given.empty());
  held.pass_on(run);
  EXPECT_EQ(given, std::vector<std::string>{"a view is dark"});
}

TEST_F(HeldMessagesTest, AreGivenOnceWhenTheirAttemptFails) {
  HeldMessages held;
  const auto fails = [](const frangia::Run& attempt) {
    attempt.warn("a view is dark");
    throw Error(ErrorKind::Numeric, "nothing was measured");
  };
  EXPECT_THROW(held.during(run, fails), Error);
  EXPECT_EQ(given, std::vector<std::string>{"a view is dark"});
}

TEST_F(HeldMessagesTest, AreForgottenWhereTheyWereSaidBefore) {
  HeldMessages held;
  held.during(run, [](const frangia::Run& attempt) {
    attempt.warn("a view is dark; expose longer");
    attempt.warn("a view is late");
  });
  held.forget("a view is dark");
  held.pass_on(run);
  EXPECT_EQ(given, std::vector<std::string>{"a view is late"});
}

}  // namespace
}  // namespace frangia
