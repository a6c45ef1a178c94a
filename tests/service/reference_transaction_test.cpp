#include <atomic>
#include <cerrno>
#include <filesystem>
#include <string>
#include <thread>

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
  EXPECT_EQ(finish().at("state"), "done");
  std::string present = "a";
  std::size_t refused = 0;
  for (std::size_t at = 0; at < 14; ++at) {
    const std::string next(1, static_cast<char>('b' + at));
    const nlohmann::json arguments = send_reference(next);
    bool failed = false;
    {
      const testing::FileFault fault(project().string(), at, false, [] { return ENOSPC; });
      failed =
          !refusal("set-reference", arguments.dump()).empty() || finish().at("state") != "done";
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

/// The thread that answers every client must not wait for a disk.
TEST_F(ReferenceTransaction, WaitsForTheDiskOnTheThreadOfTheJobs) {
  begin(2);
  service_->add_to_reference(0, "solid");
  const auto here = std::this_thread::get_id();
  std::atomic<int> by_command = 0;
  std::atomic<int> by_job = 0;
  {
    const testing::FileFault watch(project().string(), 0, true, [&] {
      ++(std::this_thread::get_id() == here ? by_command : by_job);
      return 0;
    });
    const nlohmann::json arguments = {{"name", "a"}, {"format", "stl"}, {"bytes", 5}};
    EXPECT_TRUE(command("set-reference", arguments).contains("job"));
    EXPECT_EQ(finish().at("state"), "done");
  }
  EXPECT_LE(by_command, 1) << "the file is renamed";
  EXPECT_GE(by_job, 4) << "the file is synced, its name written, synced and renamed";
}

TEST_F(ReferenceTransaction, IsThereForAComparisonThatFollowsAtOnce) {
  begin(2);
  const Mesh nominal = testing::box({-5, -5, -5}, {5, 5, 5});
  write_mesh(folder_.path() / "box.stl", nominal);
  const std::string bytes = testing::bytes_of(folder_.path() / "box.stl");
  service_->add_to_reference(0, bytes);
  static_cast<void>(
      command("set-reference", {{"name", "box"}, {"format", "stl"}, {"bytes", bytes.size()}}));
  static_cast<void>(command("set-plan", {{"plan", {{"align", "none"}}}}));
  static_cast<void>(command("inspect"));
  EXPECT_EQ(finish().at("state"), "done");
  EXPECT_EQ(state().at("project").at("surface").at("comparison").at("reference"), "box");
}

}  // namespace
}  // namespace frangia
