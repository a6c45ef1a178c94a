// Every change of a surface happens completely or not at all, whatever fails: what the service
// shows is what the disk holds, what it says is done is there, and what it says has failed is not.
#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "service/transaction_fixture.h"

namespace frangia {
namespace {

using Json = nlohmann::json;
using testing::bytes_of;
using testing::ProjectOnDisk;
using testing::read_project;

/// What may befall a command.
enum class Trouble {
  None,
  FailsOnce,
  DiskIsDead,
  StopAtFile,
  StopAtChange,
  Copy,
  PowerCut,
  PowerCutAllNames,
  Restart
};
constexpr std::array kTroubles = {"none",
                                  "one operation fails",
                                  "all later operations fail",
                                  "stopped at a file",
                                  "stopped at a change",
                                  "copied",
                                  "power cut",
                                  "power cut, names arrived",
                                  "the server ends"};

const std::vector<EditStep>& tried_steps() {
  static const std::vector<EditStep> kSteps = {{"select-component", "0"},
                                               {"select-ball", "0,0,5,4"},
                                               {"delete", ""},
                                               {"invert", ""},
                                               {"keep-largest", "1"},
                                               {"fill-holes-flat", "30mm"},
                                               {"offset", "0.1mm"},
                                               {"reverse-orientation", ""},
                                               {"mirror", "0,0,1,0"},
                                               {"cut", "0,0,1,1mm"}};
  return kSteps;
}

class SurfaceTransactions : public TransactionTest {
 protected:
  /// Sends a command, in some trouble; returns its job, or nothing when the server was ended.
  std::optional<Json> send(const std::string& name, Json arguments, Trouble trouble) {
    const std::size_t at = random(trouble == Trouble::StopAtChange ? 12 : 24);
    trace_ += fmt::format("\n  {} {} ({} {})",
                          name,
                          arguments.dump(),
                          kTroubles.at(static_cast<std::size_t>(trouble)),
                          at);
    last_key_ = fmt::format("command-{}-{}", seed_, drawn_);
    arguments["id"] = last_key_;
    last_command_ = {name, arguments};
    seen_.clear();
    std::size_t changes = 0;
    at_changes([this, trouble, at, &changes] {
      if (trouble == Trouble::StopAtChange && changes++ == at) stop_running();
      seen_.insert(shown_in(state()));
    });
    copy_.clear();
    std::optional<testing::FileFault> fault;
    const auto strike = [this, trouble] {
      if (trouble == Trouble::StopAtFile) stop_running();
      if (trouble == Trouble::Copy) copy_project();
      if (trouble == Trouble::PowerCut) cut_power(false);
      if (trouble == Trouble::PowerCutAllNames) cut_power(true);
      return trouble == Trouble::FailsOnce ? ENOSPC : trouble == Trouble::DiskIsDead ? EIO : 0;
    };
    if (trouble != Trouble::None && trouble != Trouble::StopAtChange && trouble != Trouble::Restart)
      fault.emplace(project().string(), at, trouble == Trouble::DiskIsDead, strike);
    std::optional<Json> job;
    try {
      const Json answer = command(name, arguments);
      if (trouble == Trouble::Restart) {
        restart_later(at);
      } else {
        job = finish();
      }
    } catch (const Error& error) {
      job = Json{{"state", "refused"}, {"error", error.what()}, {"revision", nullptr}};
    }
    at_changes({});
    fault.reset();
    if (job) trace_ += fmt::format(": {} {}", job->at("state").dump(), job->at("error").dump());
    return job;
  }

  /// Ends the server when the state has changed some times more, or is done.
  void restart_later(std::size_t changes) {
    const int until = changes_ + static_cast<int>(changes);
    while (changes_ < until) {
      bool busy = false;
      for (const Json now = state(); const Json& job : now.at("jobs"))
        busy = busy || job.at("state") == "waiting" || job.at("state") == "running";
      if (!busy) break;
      std::this_thread::yield();
    }
    at_changes({});
    restart();
    static_cast<void>(command("open-project", {{"name", "box"}}));
    static_cast<void>(finish());
  }

  /// The exported file of a format, empty without one.
  [[nodiscard]] std::string export_of(const std::string& format) const {
    return bytes_of(project() / "exports" / ("box." + format));
  }

  void judge(const ProjectOnDisk& before,
             const ProjectOnDisk& after,
             const std::optional<Json>& job,
             const std::optional<ProjectOnDisk>& expected) {
    for (const auto& [number, version] : before.versions) {
      ASSERT_TRUE(after.versions.contains(number)) << said();
      if (number == before.current && before.current == after.current) continue;
      EXPECT_TRUE(same(after.versions.at(number), version)) << said();
    }
    for (const std::string& one : seen_)
      EXPECT_TRUE(one == "unread" || one == shown_in(before) || one == shown_in(after))
          << one << " was shown; " << said();
    if (!copy_.empty()) {
      const ProjectOnDisk copied = read_copy();
      const bool doubted = trouble_ == Trouble::PowerCut && confirmed_ && same(copied, *confirmed_);
      EXPECT_TRUE(doubted || same(copied, before) || same(copied, after)) << "the copy; " << said();
    }
    const bool changed = !same(before, after);
    if (changed) {
      EXPECT_EQ(after.revision, before.revision + 1) << said();
      EXPECT_TRUE(!expected || same_but_surface(*expected, after)) << said();
    }
    if (!job) return;  // the server ended: either is right
    const bool unconfirmed =
        job->at("error").get<std::string>().find("did not confirm") != std::string::npos;
    const bool done = job->at("state") == "done";
    if (!expected) {
      EXPECT_FALSE(changed) << "a command that changes nothing; " << said();
    } else if (!done && !unconfirmed) {
      EXPECT_FALSE(changed) << "it was said to have failed; " << said();
    } else {
      EXPECT_TRUE(changed) << "it was reported as done; " << said();
      EXPECT_EQ(job->at("revision"), after.revision) << said();
      if (done) {
        for (const bool all_names : {false, true}) {
          cut_power(all_names);
          EXPECT_TRUE(same(read_copy(), after)) << "after a power cut; " << said();
        }
      }
    }
  }

  /// The same, without the bytes of a new surface, which are unknown.
  static bool same_but_surface(ProjectOnDisk expected, const ProjectOnDisk& after) {
    for (auto& [number, version] : expected.versions)
      if (version.surface.empty() && after.versions.contains(number))
        version.surface = after.versions.at(number).surface;
    return same(expected, after) && !after.shown().surface.empty();
  }

  /// What is right after a command that is carried out; nothing when it changes no surface. A new
  /// surface has any number that no other one had.
  static std::optional<ProjectOnDisk> expected_of(const std::string& name,
                                                  const Json& arguments,
                                                  ProjectOnDisk disk,
                                                  const ProjectOnDisk& after) {
    ++disk.revision;
    EditScript none;
    EditScript& script = disk.current == 0 ? none : disk.versions.at(disk.current).script;
    if (name == "edit") {
      script.steps.resize(script.done++);
      script.steps.push_back(
          {arguments.at("operation").get<std::string>(), arguments.at("value").get<std::string>()});
    } else if (name == "undo") {
      --script.done;
    } else if (name == "redo") {
      ++script.done;
    } else if (name == "reconstruct") {
      if (disk.versions.contains(after.current)) return disk;
      disk.versions[after.current] = {};
      disk.current = after.current;
    } else if (name == "open-version") {
      const int number = arguments.at("version").get<int>();
      if (disk.current == number) return std::nullopt;
      disk.current = number;
    } else if (name == "replay-edits") {
      const int number = arguments.at("version").get<int>();
      EditScript from =
          disk.versions.contains(number) ? disk.versions.at(number).script : EditScript{};
      from.steps.resize(from.done);
      script.steps.resize(script.done);
      script.steps.insert(script.steps.end(), from.steps.begin(), from.steps.end());
      script.done = script.steps.size();
    } else {
      return std::nullopt;
    }
    return disk;
  }

  std::pair<std::string, Json> random_command(const ProjectOnDisk& disk) {
    const std::uint64_t choice = random(100);
    const int other =
        disk.versions.empty() ? 1 : 1 + static_cast<int>(random(disk.versions.size()));
    if (choice < 45) {
      const EditStep& step = tried_steps()[random(tried_steps().size())];
      return {"edit", {{"operation", step.operation}, {"value", step.value}}};
    }
    if (choice < 57) return {"undo", Json::object()};
    if (choice < 67) return {"redo", Json::object()};
    if (choice < 77) return {"export", {{"format", random(2) == 0 ? "ply" : "stl"}}};
    if (choice < 82) return {"reconstruct", {{"voxel_mm", 2.0}}};
    if (choice < 90) return {"open-version", {{"version", other}}};
    if (choice < 94) return {"replay-edits", {{"version", other}}};
    if (choice < 97) return {"open-project", {{"name", "box"}}};
    return {"preview", {{"operation", "offset"}, {"value", "0.1mm"}}};
  }

  void check_export(const std::string& format,
                    const std::string& before,
                    const ProjectOnDisk& disk,
                    const std::optional<Json>& job) {
    const std::string after = export_of(format);
    const bool unconfirmed =
        job && job->at("error").get<std::string>().find("did not confirm") != std::string::npos;
    if (job && job->at("state") != "done" && !unconfirmed) {
      EXPECT_TRUE(after == before) << "the export; " << said();
    }
    if (after == before && (!job || job->at("state") != "done")) return;
    const auto truth = folder_.path() / ("truth." + format);
    write_mesh(truth, mesh_of(project(), disk));
    EXPECT_TRUE(after == bytes_of(truth)) << "what the export holds; " << said();
    if (!job) return;
    EXPECT_EQ(job->at("revision"), disk.revision) << said();
    bool listed = false;
    for (const Json now = state(); const Json& file : now.at("project").at("exports")) {
      if (file.at("name") != "box." + format) continue;
      listed = true;
      EXPECT_EQ(file.at("bytes"), after.size()) << said();
      EXPECT_EQ(file.at("revision"), disk.revision) << said();
      EXPECT_EQ(file.at("version"), disk.current) << said();
    }
    EXPECT_TRUE(listed) << said();
  }

  /// One random command in random trouble, judged.
  void step() {
    const ProjectOnDisk before = read_project(project());
    const auto [name, arguments] = random_command(before);
    const bool exports = name == "export";
    const std::string format = exports ? arguments.at("format").get<std::string>() : "";
    const std::string exported = exports ? export_of(format) : "";
    trouble_ = static_cast<Trouble>(random(kTroubles.size()));
    const std::optional<Json> job = send(name, arguments, trouble_);
    const ProjectOnDisk after = read_project(project());
    judge(before, after, job, expected_of(name, arguments, before, after));
    if (HasFatalFailure()) return;
    if (job && !same(before, after)) {
      if (job->at("state") == "done") {
        confirmed_.reset();
      } else if (!confirmed_) {
        confirmed_ = before;
      }
    }
    check_memory(after);
    if (exports) check_export(format, exported, after, job);
    retry(after, job);
  }

  /// The same command again, as after a lost connection.
  void retry(const ProjectOnDisk& disk, const std::optional<Json>& job) {
    if (!job || job->at("state") != "done" || random(3) != 0) return;
    if (random(3) == 0) {
      trace_ += "\n  restart";
      restart();
      static_cast<void>(command("open-project", {{"name", "box"}}));
      static_cast<void>(finish());
      if (!expected_of(last_command_.first, last_command_.second, disk, disk)) return;
    }
    trace_ += "\n  the same again";
    const Json answer = command(last_command_.first, last_command_.second);
    static_cast<void>(finish());
    EXPECT_EQ(answer.value("repeated", false), true) << said();
    EXPECT_TRUE(same(read_project(project()), disk)) << said();
    check_memory(disk);
  }

  Trouble trouble_ = Trouble::None;
  /// What a power cut may bring back, since the disk did not confirm a change, and said so.
  std::optional<ProjectOnDisk> confirmed_;
  std::string last_key_;
  std::pair<std::string, Json> last_command_;
  std::set<std::string> seen_;
};

/// FRANGIA_SEQUENCES and FRANGIA_FIRST_SEED choose how many are tried; `./run faults` tries 5000.
TEST_F(SurfaceTransactions, HappenCompletelyOrNotAtAllWhateverFails) {
  const auto number_of = [](const char* name, std::uint64_t otherwise) {
    const char* text = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
    return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
  };
  constexpr int kSteps = 8;
  const std::uint64_t first = number_of("FRANGIA_FIRST_SEED", 1);
  const std::uint64_t count = number_of("FRANGIA_SEQUENCES", 12);
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    begin(seed);
    confirmed_.reset();
    for (int i = 0; i < kSteps && !HasFailure(); ++i)
      step();
    if (HasFailure()) FAIL() << said();
  }
}

}  // namespace
}  // namespace frangia
