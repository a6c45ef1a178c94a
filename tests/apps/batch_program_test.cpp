// Several scans by one command: one that fails is a row of the table and stops nothing.
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "apps/batch_fixture.h"
#include "support/run_program.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::word_of;
namespace fs = std::filesystem;

class BatchProgram : public testing::BatchFixture {};

/// The path as a shell reads it back.
std::string shell_word_of(const fs::path& path) {
  std::string word = "'";
  for (const char letter : path.string())
    word += letter == '\'' ? std::string(R"('\'')") : std::string(1, letter);
  return word + "'";
}

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

TEST_F(BatchProgram, QuotesWhatTheShellOfSlurmReads) {
  const fs::path strange = out("it's a \"$(touch pwned)\" %a; folder");
  fs::create_directories(strange / "bin");
  fs::create_directories(strange / "scans");
  fs::copy(scans() / "a", strange / "scans" / "a", fs::copy_options::recursive);
  // Runs each script at once, as the first task of its array.
  std::ofstream(strange / "bin" / "sbatch")
      << "#!/bin/sh\nfor script; do :; done\nSLURM_ARRAY_TASK_ID=0 sh \"$script\" && echo 7\n";
  fs::permissions(strange / "bin" / "sbatch", fs::perms::owner_all);
  const Answer answer = testing::run_shell(
      fmt::format("PATH={}:$PATH " FRANGIA_PROGRAM " --json batch {} -o {} --slurm --memory 100 "
                  "--minutes 5",
                  shell_word_of(strange / "bin"),
                  shell_word_of(strange / "scans"),
                  shell_word_of(strange / "meshes")));
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_TRUE(fs::exists(strange / "meshes" / "a" / "mesh.ply"));
  EXPECT_TRUE(fs::exists(strange / "meshes" / "table.csv"));
  EXPECT_TRUE(fs::exists(strange / "meshes" / "slurm" / "0.log"));
  const std::string script = testing::text_of(strange / "meshes" / "slurm" / "scans.sh");
  const std::string directives = script.substr(0, script.rfind("#SBATCH"));
  EXPECT_EQ(directives.find("folder"), std::string::npos) << "Slurm has rules of its own";
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

TEST_F(BatchProgram, AReferenceOrAPlanThatChangesIsSeen) {
  const auto plan = out("referring.toml");
  const auto reference = out("reference.ply");
  fs::copy_file(scans() / "a" / "truth.ply", reference);
  std::ofstream(out("inspection.toml"))
      << "format = \"frangia-inspection\"\nversion = 1\nreference = \"reference.ply\"\n";
  std::ofstream(plan) << "format = \"frangia-batch\"\nversion = 1\ninspect = [\"--plan\", \""
                      << out("inspection.toml").string() << "\"]\n[[scan]]\nfolder = \"scans/a\"\n";
  ASSERT_EQ(batch(plan, out("referred")).exit_code, 0);
  ASSERT_EQ(batch(plan, out("referred"), "--table").exit_code, 0);
  std::ofstream(out("inspection.toml"), std::ios::app) << "part = \"plate\"\n";
  EXPECT_EQ(batch(plan, out("referred"), "--table").exit_code, 4);
  ASSERT_EQ(batch(plan, out("referred")).exit_code, 0);
  std::ofstream(reference, std::ios::app) << " ";
  const Answer answer = batch(plan, out("referred"), "--table");
  EXPECT_EQ(answer.exit_code, 4);
  EXPECT_NE(answer.output.find("reference.ply has changed"), std::string::npos) << answer.output;
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
  std::ofstream(plan)
      << "format = \"frangia-batch\"\nversion = 1\nformats = [\"ply\"]\nscans = \".\"\n"
         "inspekt = [\"--features\"]\n";
  EXPECT_NE(batch(plan, out("none")).output.find("perhaps inspect was meant"), std::string::npos);
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
