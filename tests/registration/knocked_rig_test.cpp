// Explanations of views between two of which the camera, the projector or the table was knocked.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/registration/register_views.h"
#include "frangia/simulate/parts.h"

#include "support/pose_faults.h"

namespace frangia {
namespace {

using testing::ball_bar;
using testing::bracket;
using testing::FaultyScan;
using testing::registered;
using testing::Registered;

/// What is named and how good the surface is.
void expect_corrected(const Registered& out, PoseCause cause, std::size_t before) {
  const PoseExplanation& found = out.report.explanation;
  EXPECT_EQ(found.best, cause) << found.text;
  EXPECT_TRUE(found.decided) << found.text;
  EXPECT_EQ(found.views, std::vector<std::size_t>{before}) << found.text;
  EXPECT_TRUE(out.report.outliers.empty());
  EXPECT_EQ(out.report.untrusted_reason(), "");
  EXPECT_LT(out.error_mm, 0.015) << found.text;
  EXPECT_LT(out.error.share_beyond, 0.05) << out.error.over_sigma;
}

TEST(KnockedRig, CorrectsAKnockOfTheCamera) {
  FaultyScan scan(8);
  scan.knock(4, rad_from_deg(0.06), 0.1, true, true);
  const Registered out = registered(scan, ball_bar());
  expect_corrected(out, PoseCause::RigMoved, 4);
  EXPECT_EQ(out.report.explanation.terms, std::vector<std::string>{"camera"});
}

TEST(KnockedRig, CorrectsAKnockOfTheProjector) {
  FaultyScan scan(8);
  scan.knock(3, rad_from_deg(0.05), 0.1, true, false);
  const Registered out = registered(scan, bracket());
  expect_corrected(out, PoseCause::RigMoved, 3);
  EXPECT_EQ(out.report.explanation.terms, std::vector<std::string>{"projector"});
}

TEST(KnockedRig, CorrectsAKnockOfTheTable) {
  FaultyScan scan(8);
  scan.knock(5, rad_from_deg(0.05), 0.3, false, true);
  expect_corrected(registered(scan, ball_bar()), PoseCause::TableMoved, 5);
}

/// A camera that was knocked before the second view moves all others as an axis elsewhere does, but
/// for a fifth of the way.
TEST(KnockedRig, IsNotBlamedForAnAxisThatIsElsewhere) {
  FaultyScan scan(8);
  scan.state_exact();
  scan.misalign(0.1, 2e-4, 0.0);
  const Registered out = registered(scan, RayScene(make_part("blade")));
  EXPECT_NE(out.report.explanation.best, PoseCause::RigMoved) << out.report.explanation.text;
  EXPECT_LT(out.error_mm, 0.005);
}

}  // namespace
}  // namespace frangia
