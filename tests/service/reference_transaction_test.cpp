#include <cerrno>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "service/transaction_fixture.h"

namespace frangia {
namespace {

class ReferenceTransaction : public TransactionTest {};

TEST_F(ReferenceTransaction, ReplacesTheReferenceOrKeepsIt) {
  begin(2);
  const auto send_reference = [&](const std::string& name) {
    const std::string bytes(100 + name.size(), name.front());
    service_->add_to_reference(0, bytes);
    return nlohmann::json{{"name", name}, {"format", "stl"}, {"bytes", bytes.size()}};
  };
  static_cast<void>(command("set-reference", send_reference("a")));
  std::string present = "a";
  std::size_t refused = 0;
  for (std::size_t at = 0; at < 14; ++at) {
    const std::string next(1, static_cast<char>('b' + at));
    const nlohmann::json arguments = send_reference(next);
    bool failed = false;
    {
      const testing::FileFault fault(project().string(), at, false, [] { return ENOSPC; });
      failed = !refusal("set-reference", arguments.dump()).empty();
    }
    refused += failed ? 1 : 0;
    const std::string shown = state().at("project").at("reference").at("name");
    EXPECT_TRUE(shown == next || (failed && shown == present)) << at;
    restart();
    static_cast<void>(command("open-project", {{"name", "box"}}));
    static_cast<void>(finish());
    EXPECT_EQ(state().at("project").at("reference").at("name"), shown) << at;
    const nlohmann::json named =
        nlohmann::json::parse(testing::bytes_of(project() / "reference.json"));
    const std::string file = fmt::format("reference-{}.stl", named.at("number").get<int>());
    EXPECT_EQ(testing::bytes_of(project() / file), std::string(101, shown.front())) << at;
    present = shown;
  }
  EXPECT_GT(refused, 5U);
}

}  // namespace
}  // namespace frangia
