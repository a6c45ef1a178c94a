// Several scans by one command: one that fails is a row of the table and stops nothing.
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/run_program.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::run_program;
namespace fs = std::filesystem;

std::string word_of(const fs::path& path) {
  return "'" + path.string() + "'";
}

class BatchProgram : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new testing::TemporaryFolder;  // NOLINT(*-owning-memory) deleted below
    for (const char* name : {"a", "b"}) {
      const auto scan =
          testing::small_scan(scans() / name, "plate", "digital", 1, {.samples_per_px = 1});
      static_cast<void>(scan);
    }
    fs::create_directories(scans() / "broken");
    std::ofstream(scans() / "broken" / "scan.toml") << "format = \"frangia-scan\"\nversion = 2\n";
  }
  static void TearDownTestSuite() { delete folder_; }  // NOLINT(*-owning-memory)

  [[nodiscard]] static fs::path scans() { return folder_->path() / "scans"; }
  [[nodiscard]] static fs::path out(const char* name) { return folder_->path() / name; }
  [[nodiscard]] static Answer batch(const fs::path& plan,
                                    const fs::path& to,
                                    const char* more = "") {
    return run_program("--json batch " + word_of(plan) + " -o " + word_of(to) + " " + more);
  }

 private:
  static testing::TemporaryFolder* folder_;
};

testing::TemporaryFolder* BatchProgram::folder_ = nullptr;

TEST_F(BatchProgram, AFailingScanIsOneRow) {
  const Answer answer = batch(scans(), out("all"), "--jobs 2");
  EXPECT_EQ(answer.exit_code, 4) << answer.output;
  const auto rows = nlohmann::json::parse(testing::text_of(out("all") / "table.json"));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0]["state"], "done") << rows;
  EXPECT_EQ(rows[1]["state"], "done") << rows;
  EXPECT_EQ(rows[2]["state"], "failed");
  EXPECT_EQ(rows[2]["exit_code"], 3);
  EXPECT_NE(rows[2]["message"].get<std::string>().find("rig.toml"), std::string::npos) << rows[2];
  EXPECT_GT(rows[0]["triangles"].get<int>(), 100);
  EXPECT_GT(rows[0]["memory_mb"].get<double>(), 10.0);
  EXPECT_GT(fs::file_size(out("all") / "b" / "mesh.ply"), 1000U);
  const std::string csv = testing::text_of(out("all") / "table.csv");
  EXPECT_NE(csv.find("\nbroken,failed,3,"), std::string::npos) << csv;
}

TEST_F(BatchProgram, DoesWhatIsOpenOnly) {
  static_cast<void>(batch(scans(), out("again"), "--task 0"));
  const auto mark = out("again") / "a" / "done.json";
  const auto first = fs::last_write_time(mark);
  static_cast<void>(batch(scans(), out("again")));
  EXPECT_EQ(fs::last_write_time(mark), first);
  EXPECT_TRUE(fs::exists(out("again") / "b" / "done.json"));
  const auto failed = out("again") / "broken" / "done.json";
  const auto once = fs::last_write_time(failed);
  static_cast<void>(batch(scans(), out("again")));
  EXPECT_EQ(fs::last_write_time(failed), once);
  static_cast<void>(batch(scans(), out("again"), "--retry"));
  EXPECT_GT(fs::last_write_time(failed), once);
}

TEST_F(BatchProgram, RunsAPlanWithEditsAndInspection) {
  const auto plan = out("plan.toml");
  std::ofstream(out("repair.json"))
      << R"({"format": "frangia-edits", "version": 1, "steps": [{"operation": "remove-islands", "value": "2mm"}]})";
  std::ofstream(plan)
      << "format = \"frangia-batch\"\nversion = 1\nformats = [\"ply\", \"stl\"]\n"
         "edit = \"repair.json\"\ninspect = [\"--reference\", \""
      << (scans() / "a" / "truth.ply").string()
      << "\"]\n[[scan]]\nfolder = \"scans/a\"\nreconstruct = [\"--voxel\", \"2mm\"]\n";
  const Answer answer = batch(plan, out("planned"));
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  for (const char* file : {"measured.ply", "mesh.ply", "mesh.stl", "inspect.json"})
    EXPECT_TRUE(fs::exists(out("planned") / "a" / file)) << file;
  std::ofstream(out("repair.json"))
      << R"({"format": "frangia-edits", "version": 1, "steps": [{"operation": "remove-islands", "value": "3.5mm"}]})";
  const auto before = fs::last_write_time(out("planned") / "a" / "done.json");
  EXPECT_EQ(batch(plan, out("planned")).exit_code, 0);
  EXPECT_GT(fs::last_write_time(out("planned") / "a" / "done.json"), before);
}

TEST_F(BatchProgram, NamesWhatIsWrongWithAPlan) {
  const auto plan = out("wrong.toml");
  std::ofstream(plan) << "format = \"frangia-batch\"\nversion = 1\nscans = \"nowhere\"\n";
  const Answer answer = batch(plan, out("none"));
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_NE(answer.output.find("nowhere"), std::string::npos) << answer.output;
  fs::create_directories(out("empty"));
  EXPECT_NE(batch(out("empty"), out("none")).output.find("holds no scan"), std::string::npos);
  EXPECT_EQ(batch(scans(), out("none"), "--task 7").exit_code, 3);
}

TEST_F(BatchProgram, SaysThatSlurmIsMissing) {
  const Answer answer =
      testing::run_shell("PATH=/nonexistent " FRANGIA_PROGRAM " --json batch " + word_of(scans()) +
                         " -o " + word_of(out("slurm")) + " --slurm --memory 100 --minutes 5");
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_NE(answer.output.find("sbatch"), std::string::npos) << answer.output;
}

}  // namespace
}  // namespace frangia
