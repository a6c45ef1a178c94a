// A result that is not trustworthy: first line, exit code and JSON.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "frangia/files/ply.h"

#include "support/displaced_views.h"
#include "support/run_program.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::displace_every_other_view;
using testing::run_program;
using testing::small_scan;
using testing::TemporaryFolder;

TEST(UntrustedProgram, AnnouncesAnUntrustworthyResultInTheFirstLine) {
  const TemporaryFolder folder;
  displace_every_other_view(small_scan(folder.path() / "scan", "bracket", "digital", 6, {}));
  const std::string arguments = "reconstruct " + (folder.path() / "scan").string() + " -o " +
                                (folder.path() / "a.ply").string();
  const Answer answer = run_program(arguments);
  EXPECT_EQ(answer.exit_code, 5) << answer.output;
  EXPECT_EQ(answer.output.find("the result is not trustworthy: the views contradict each other"),
            0U)
      << answer.output;
  const Answer json = run_program("--json " + arguments + " 2>/dev/null");
  EXPECT_EQ(json.exit_code, 5);
  EXPECT_NE(json.output.find("\"trustworthy\": false"), std::string::npos) << json.output;
  EXPECT_NE(json.output.find("\"reason\": \"the views contradict each other"), std::string::npos);
}

TEST(UntrustedProgram, AnnouncesScansThatContradictEachOtherInTheFirstLine) {
  const TemporaryFolder folder;
  const auto path = [&](const std::string& name) { return (folder.path() / name).string(); };
  Mesh relief = testing::relief();
  write_ply(path("one.ply"), relief);
  for (Eigen::Vector3f& vertex : relief.vertices_mm)
    vertex.z() *= 1.5F;
  write_ply(path("two.ply"), relief);
  const std::string arguments =
      "merge " + path("one.ply") + " " + path("two.ply") + " --poses given -o " + path("a.ply");
  const Answer answer = run_program(arguments);
  EXPECT_EQ(answer.exit_code, 5) << answer.output;
  const std::string first = "the result is not trustworthy: the scans contradict each other, ";
  EXPECT_EQ(answer.output.find(first), 0U) << answer.output;
  EXPECT_EQ(answer.output.find("contradict", first.size()), std::string::npos) << answer.output;
  const Answer json = run_program("--json " + arguments + " 2>/dev/null");
  EXPECT_EQ(json.exit_code, 5);
  EXPECT_NE(json.output.find("\"trustworthy\": false"), std::string::npos) << json.output;
}

}  // namespace
}  // namespace frangia
