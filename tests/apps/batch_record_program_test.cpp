// What a batch records of each scan: what is done is not done again, what has changed is.
#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "frangia/core/checksums.h"

#include "apps/batch_fixture.h"
#include "support/run_program.h"
#include "support/started_program.h"
#include "support/text_of.h"
#include "support/wait_until.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::run_program;
using testing::word_of;
namespace fs = std::filesystem;

/// A scan folder of its own, with one scan of the name "a".
class BatchRecord : public testing::BatchFixture {
 protected:
  void SetUp() override {
    fs::create_directories(one());
    fs::copy(scans() / "a", one() / "a", fs::copy_options::recursive);
  }
  void TearDown() override { fs::remove_all(out("record")); }
  [[nodiscard]] static fs::path one() { return out("record") / "scans"; }
  [[nodiscard]] static fs::path result(const char* name) {
    return out("record") / "meshes" / "a" / name;
  }
  [[nodiscard]] static Answer run(const char* more = "") {
    return batch(one(), out("record") / "meshes", more);
  }
  [[nodiscard]] static fs::path first_frame() {
    for (const auto& entry : fs::recursive_directory_iterator(one() / "a"))
      if (entry.path().extension() == ".png") return entry.path();
    return {};
  }
  /// Whether another run does the scan again, which writes its mark again.
  [[nodiscard]] static bool is_done_again(const char* more = "") {
    const auto mark = result("done.json");
    const fs::file_time_type before{};
    fs::last_write_time(mark, before);
    EXPECT_EQ(run(more).exit_code, 0);
    return fs::last_write_time(mark) != before;
  }
  /// Another byte in the middle of a file, which keeps its size and, where asked for, its time.
  static void damage(const fs::path& file, bool keep_time) {
    const auto time = fs::last_write_time(file);
    std::string bytes = testing::text_of(file);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    std::fstream(file, std::ios::in | std::ios::out | std::ios::binary) << bytes;
    if (keep_time) fs::last_write_time(file, time);
  }
};

TEST_F(BatchRecord, AResultThatIsDeletedEmptiedOrForeignIsDoneAgain) {
  ASSERT_EQ(run().exit_code, 0);
  EXPECT_FALSE(is_done_again());
  const std::string mesh = testing::text_of(result("mesh.ply"));
  fs::remove(result("mesh.ply"));
  EXPECT_TRUE(is_done_again());
  EXPECT_EQ(testing::text_of(result("mesh.ply")), mesh);
  fs::resize_file(result("mesh.ply"), 0);
  EXPECT_TRUE(is_done_again());
  damage(result("mesh.ply"), false);
  EXPECT_TRUE(is_done_again());
  EXPECT_EQ(testing::text_of(result("mesh.ply")), mesh);
  // The same bytes in a file of another time and inode are compared by their checksum.
  fs::copy_file(result("mesh.ply"), result("copy"));
  fs::rename(result("copy"), result("mesh.ply"));
  EXPECT_FALSE(is_done_again());
}

TEST_F(BatchRecord, AFrameThatChangesOrGoesIsSeen) {
  ASSERT_EQ(run().exit_code, 0);
  const fs::path frame = first_frame();
  fs::last_write_time(frame, fs::file_time_type{});
  EXPECT_FALSE(is_done_again()) << "its bytes are the same";
  const auto hidden = out("record") / "frame";
  fs::rename(frame, hidden);
  Answer answer = run("--table");
  EXPECT_EQ(answer.exit_code, 4);
  EXPECT_NE(answer.output.find(frame.filename().string() + " has changed or is missing"),
            std::string::npos)
      << answer.output;
  fs::rename(hidden, frame);
  EXPECT_EQ(run("--table").exit_code, 0);
}

TEST_F(BatchRecord, TheCovarianceOfTheRigIsOneOfTheInputs) {
  std::ofstream(one() / "a" / "rig.toml", std::ios::app)
      << "\n[calibration]\ncovariance = \"uncertain.csv\"\n";
  const auto write_variance = [](const char* variance) {
    std::ofstream(one() / "a" / "uncertain.csv")
        << "parameter,camera.focal_px\ncamera.focal_px," << variance << '\n';
  };
  write_variance("0.25");
  ASSERT_EQ(run().exit_code, 0);
  EXPECT_FALSE(is_done_again());
  write_variance("0.50");
  EXPECT_TRUE(is_done_again());
  fs::rename(one() / "a" / "uncertain.csv", out("record") / "uncertain.csv");
  fs::create_symlink(out("record") / "uncertain.csv", one() / "a" / "uncertain.csv");
  EXPECT_EQ(run().exit_code, 4);
  const Answer linked = run("--table");
  EXPECT_NE(linked.output.find("uncertain.csv: is a link to "), std::string::npos) << linked.output;
}

TEST_F(BatchRecord, AMissingFileThatAppearsIsSeen) {
  fs::remove(one() / "a" / "rig.toml");
  const auto mark = result("done.json");
  const auto is_tried_again = [&] {
    const fs::file_time_type before{};
    fs::last_write_time(mark, before);
    EXPECT_EQ(run().exit_code, 4);
    return fs::last_write_time(mark) != before;
  };
  EXPECT_EQ(run().exit_code, 4);
  ASSERT_TRUE(fs::exists(mark)) << "it is missing, and the scan has failed for it";
  EXPECT_FALSE(is_tried_again());
  std::ofstream(one() / "a" / "rig.toml") << "no rig";
  EXPECT_TRUE(is_tried_again());
  EXPECT_FALSE(is_tried_again());
  fs::remove(one() / "a" / "rig.toml");
  EXPECT_TRUE(is_tried_again());
}

TEST_F(BatchRecord, VerifyFindsWhatChangedWithoutATrace) {
  ASSERT_EQ(run().exit_code, 0);
  // As a disk does it: the bytes change, and neither the time nor the size does.
  const auto file = result("mesh.ply");
  struct ::stat before {};
  ASSERT_EQ(::stat(file.c_str(), &before), 0);
  damage(file, false);
  const std::array<timespec, 2> times{before.st_atim, before.st_mtim};
  ASSERT_EQ(::utimensat(AT_FDCWD, file.c_str(), times.data(), 0), 0);
  EXPECT_FALSE(is_done_again());
  EXPECT_TRUE(is_done_again("--verify"));
  EXPECT_FALSE(is_done_again("--verify"));
}

TEST_F(BatchRecord, VerifyNamesAFrameThatDiffersFromTheManifest) {
  const fs::path frame = first_frame();
  fs::create_directories(one() / "a" / "capture");
  std::string line =
      "frame " + fs::relative(frame, one() / "a").string() + " 00000000 100 attempts=1";
  const auto checksum = crc32(std::span<const char>(line.data(), line.size()));
  std::ofstream(one() / "a" / "capture" / "manifest.txt")
      << line << fmt::format(" crc={:08x}\n", checksum);
  ASSERT_EQ(run().exit_code, 0);
  const Answer answer = run("--verify --table");
  EXPECT_EQ(answer.exit_code, 4);
  EXPECT_NE(answer.output.find("does not have the checksum of capture/manifest.txt"),
            std::string::npos)
      << answer.output;
}

TEST_F(BatchRecord, AMarkThatIsNestedOrForeignIsOfNoScan) {
  ASSERT_EQ(run().exit_code, 0);
  const std::string nested = std::string(200'000, '[') + std::string(200'000, ']');
  const std::string object = R"({"row": [], "cause": 1, "inputs": [1], "results": {"../x": 1}})";
  for (const std::string& text : {nested, object, std::string("{}"), std::string("null")}) {
    std::ofstream(result("done.json")) << text;
    EXPECT_EQ(run("--table").exit_code, 4);
  }
  EXPECT_TRUE(is_done_again());
  // What a row says goes to the terminal.
  auto mark = nlohmann::ordered_json::parse(testing::text_of(result("done.json")));
  mark["row"]["message"] = "\x1b[31mred";
  mark["row"]["exit_code"] = 1e300;
  std::ofstream(result("done.json")) << mark;
  const Answer shown = testing::run_program("batch " + word_of(one()) + " -o " +
                                            word_of(out("record") / "meshes") + " --table");
  EXPECT_EQ(shown.exit_code, 0);
  EXPECT_EQ(shown.output.find('\x1b'), std::string::npos) << shown.output;
}

TEST_F(BatchRecord, ALinkAmongTheResultsIsNamedAndNothingIsWrittenThroughIt) {
  const fs::path elsewhere = out("record") / "elsewhere";
  fs::create_directories(elsewhere);
  fs::create_directories(result("").parent_path());
  const auto answer_with = [&](const fs::path& target, const fs::path& link) {
    fs::create_symlink(target, link);
    const Answer answer = run();
    EXPECT_TRUE(fs::is_symlink(link)) << "it is the user's";
    fs::remove(link);
    EXPECT_EQ(answer.exit_code, 4);
    return answer.output;
  };
  std::ofstream(elsewhere / "file") << "somebody's";
  for (const char* name : {"reconstruct.json", "reconstruct.log"}) {
    const std::string said = answer_with(elsewhere / "file", result(name));
    EXPECT_NE(said.find(result(name).string() + ": is a link to "), std::string::npos) << said;
    EXPECT_EQ(testing::text_of(elsewhere / "file"), "somebody's");
  }
  const fs::path folder = result("done.json").parent_path();
  fs::remove_all(folder);
  EXPECT_NE(answer_with(elsewhere, folder).find("bind-mount"), std::string::npos);
  EXPECT_EQ(std::distance(fs::directory_iterator(elsewhere), {}), 1);
  EXPECT_EQ(run().exit_code, 0);
  fs::rename(result("mesh.ply"), elsewhere / "mesh.ply");
  fs::create_symlink(elsewhere / "mesh.ply", result("mesh.ply"));
  EXPECT_TRUE(is_done_again()) << "the mesh is not in this folder";
}

/// The step of a batch whose command line has a word; 0: the batch has ended.
pid_t step_of(const testing::StartedProgram& batch, const std::string& word) {
  while (!batch.has_ended()) {
    std::error_code ended;
    for (const auto& task :
         fs::directory_iterator(fmt::format("/proc/{}/task", batch.process()), ended)) {
      pid_t child = 0;
      if (!(std::ifstream(task.path() / "children") >> child)) continue;
      // Before it runs the step, every open file of the batch is its own.
      if (testing::text_of(fmt::format("/proc/{}/cmdline", child)).find(word) != std::string::npos)
        return child;
    }
  }
  return 0;
}

/// Whether a process is halted, and not ended. It is halted a moment after the signal.
bool is_halted(pid_t process) {
  char state = ' ';
  return testing::wait_until([&] {
           const std::string line = testing::text_of(fmt::format("/proc/{}/stat", process));
           const auto name_end = line.rfind(')');
           state = name_end == std::string::npos ? 'X' : line.at(name_end + 2);
           return state == 'T' || state == 'Z' || state == 'X';
         }) &&
         state == 'T';
}

/// The reconstructing process survives its killed batch; no other process writes the same results.
TEST_F(BatchRecord, AnOrphanedStepKeepsOthersOut) {
  // Of so many pixels that a step takes long enough to be halted.
  fs::remove_all(one() / "a");
  static_cast<void>(testing::small_scan(one() / "a", "plate", "digital", 1, {.samples_per_px = 1}));
  std::optional<testing::StartedProgram> batch;
  pid_t step = 0;
  bool halted = false;
  for (int attempt = 0; attempt < 10 && !halted; ++attempt) {  // a step may end before it is seen
    fs::remove_all(out("record") / "meshes");
    batch.emplace(std::vector<std::string>{FRANGIA_PROGRAM,
                                           "--quiet",
                                           "batch",
                                           one().string(),
                                           "-o",
                                           (out("record") / "meshes").string()},
                  (out("record") / "log").string());
    step = step_of(*batch, "reconstruct");
    // A step that is halted before its parent ends would be woken by SIGHUP.
    batch->send(SIGKILL);
    static_cast<void>(batch->wait());
    halted = step > 0 && ::kill(step, SIGSTOP) == 0 && is_halted(step);
  }
  ASSERT_TRUE(halted) << "every step ended before it was halted";
  const Answer refused = run();
  EXPECT_EQ(refused.exit_code, 4);
  EXPECT_NE(refused.output.find("is writing to this folder"), std::string::npos) << refused.output;
  EXPECT_FALSE(fs::exists(result("done.json")));
  ASSERT_EQ(::kill(step, SIGKILL), 0);
  ASSERT_TRUE(testing::wait_until([&] { return run().exit_code == 0; }));
  EXPECT_TRUE(fs::exists(result("mesh.ply")));
}

}  // namespace
}  // namespace frangia
