// A result that is not trustworthy: first line, exit code and JSON.
#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "support/run_program.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::run_program;
using testing::small_scan;
using testing::TemporaryFolder;

/// Captures every other view again with the part displaced, each time differently.
void displace_every_other_view(const Scan& scan) {
  for (std::size_t view = 1; view < scan.views.size(); view += 2) {
    const TemporaryFolder folder;
    Scan plan = scan;
    plan.folder = folder.path();
    plan.views = {scan.views[view]};
    Mesh part = make_part("bracket");
    const double direction_rad = 2.3 * static_cast<double>(view);
    const Eigen::Vector3d shift_mm(
        2.5 * std::cos(direction_rad), 2.5 * std::sin(direction_rad), 1.5);
    for (Eigen::Vector3f& vertex : part.vertices_mm)
      vertex += shift_mm.cast<float>();
    static_cast<void>(simulate_scan(part, plan, {}));
    std::filesystem::copy(plan.folder / scan.views[view].folder,
                          scan.folder / scan.views[view].folder,
                          std::filesystem::copy_options::overwrite_existing |
                              std::filesystem::copy_options::recursive);
  }
}

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
  EXPECT_NE(json.output.find("\"reason\": \"the views contradict"), std::string::npos);
}

}  // namespace
}  // namespace frangia
