// Explanations of views that were taken by a rig or of a part which is not where it is stated.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/registration/register_views.h"
#include "frangia/simulate/parts.h"

#include "support/pose_faults.h"

namespace frangia {
namespace {

using testing::FaultyScan;

struct Registered {
  RegistrationReport report;
  double error_mm = 0.0;
  std::vector<std::string> warnings;
};

Registered registered(const FaultyScan& scan, const RayScene& part, bool with_error = true) {
  Registered out;
  ViewStore views = scan.take(part);
  const auto stations = scan.stations();
  Run run;
  run.on_warning = [&](const std::string& sentence) { out.warnings.push_back(sentence); };
  out.report = register_views(
      views, scan.stated.reference().model, scan.given(stations), RegisterOptions{}, run);
  if (with_error) out.error_mm = testing::surface_error_mm(scan, part, views);
  return out;
}

const RayScene& bracket() {
  static const RayScene kPart(make_part("bracket"));
  return kPart;
}

const RayScene& ball_bar() {
  static const RayScene kPart(make_part("ball-bar"));
  return kPart;
}

TEST(ExplainPoses, JoinsBothGroupsOfAPartThatSlid) {
  FaultyScan scan(8);
  scan.slide(4, Eigen::Vector3d(0.32, 0.24, 0.0));
  const Registered out = registered(scan, ball_bar());
  const PoseExplanation& found = out.report.explanation;
  EXPECT_EQ(found.best, PoseCause::PartMoved) << found.text;
  EXPECT_TRUE(found.decided) << found.text;
  EXPECT_EQ(found.views, std::vector<std::size_t>{4});
  EXPECT_NEAR(found.moved_mm, 0.4, 0.02);
  EXPECT_LT(found.moved_sigma_mm, 0.02);
  EXPECT_TRUE(out.report.outliers.empty());
  EXPECT_LT(out.error_mm, 0.008);
  EXPECT_NE(found.text.find("the part slid by 0.4"), std::string::npos) << found.text;
  EXPECT_NE(found.text.find("between views 4 and 5"), std::string::npos) << found.text;
  ASSERT_EQ(out.warnings.size(), 1U);
}

TEST(ExplainPoses, StatesHowFarASlideAlongFlatFacesIsOpen) {
  FaultyScan scan(8);
  scan.slide(4, Eigen::Vector3d(0.32, 0.24, 0.0));
  const Registered out = registered(scan, bracket(), false);
  const PoseExplanation& found = out.report.explanation;
  EXPECT_EQ(found.best, PoseCause::PartMoved) << found.text;
  EXPECT_TRUE(out.report.outliers.empty());
  EXPECT_LT(std::abs(found.moved_mm - 0.4), 3.0 * found.moved_sigma_mm);
  EXPECT_TRUE(out.report.untrusted_reason().empty()) << out.report.untrusted_reason();
}

TEST(ExplainPoses, CorrectsADriftOfTheProjector) {
  FaultyScan scan(8);
  scan.drift_projector(rad_from_deg(0.05), 0.1);
  const Registered out = registered(scan, ball_bar());
  const PoseExplanation& found = out.report.explanation;
  EXPECT_EQ(found.best, PoseCause::RigDrift) << found.text;
  EXPECT_TRUE(found.decided) << found.text;
  EXPECT_TRUE(out.report.outliers.empty());
  EXPECT_LT(out.error_mm, 0.025);
}

TEST(ExplainPoses, NamesARigThatIsNotAsStated) {
  FaultyScan scan(8);
  scan.drift_projector(rad_from_deg(0.1), 0.5, true);
  const Registered out = registered(scan, bracket());
  const PoseExplanation& found = out.report.explanation;
  EXPECT_EQ(found.best, PoseCause::Rig) << found.text;
  EXPECT_TRUE(out.report.outliers.empty());
  EXPECT_FALSE(found.terms.empty());
  EXPECT_NE(found.remedy.find("refine_rig"), std::string::npos) << found.remedy;
}

TEST(ExplainPoses, EstimatesTheWobbleOfATable) {
  FaultyScan scan(8);
  scan.wobble(rad_from_deg(0.03), 0.03);
  const Registered out = registered(scan, bracket());
  const PoseExplanation& found = out.report.explanation;
  EXPECT_EQ(found.best, PoseCause::Wobble) << found.text;
  EXPECT_GT(found.scale, 0.008);
  EXPECT_LT(found.scale, 0.12);
  EXPECT_TRUE(out.report.outliers.empty());
  EXPECT_LT(out.error_mm, 0.015);
}

TEST(ExplainPoses, LeavesOutAViewThatAloneIsElsewhere) {
  FaultyScan scan(8);
  scan.views[3].part = Eigen::Translation3d(0.5, 0.4, 0.0) * Eigen::Isometry3d::Identity();
  const Registered out = registered(scan, ball_bar());
  EXPECT_EQ(out.report.explanation.best, PoseCause::ViewMoved) << out.report.explanation.text;
  EXPECT_EQ(out.report.outliers, std::vector<std::size_t>{3});
  ASSERT_EQ(out.warnings.size(), 1U);
  EXPECT_NE(out.warnings[0].find("view 4"), std::string::npos) << out.warnings[0];
}

TEST(ExplainPoses, FindsATableThatTurnsByHalfOfWhatWasCommanded) {
  FaultyScan scan(8);
  for (testing::TrueView& view : scan.views)
    view.angle_rad *= 0.5;
  const Registered out = registered(scan, bracket());
  EXPECT_EQ(out.report.explanation.best, PoseCause::AnglesScaled) << out.report.explanation.text;
  EXPECT_EQ(out.report.explanation.scale, 0.5);
  EXPECT_TRUE(out.report.outliers.empty());
  EXPECT_LT(out.error_mm, 0.01);
}

TEST(ExplainPoses, FindsATurnThatDidNotHappen) {
  FaultyScan scan(8);
  for (std::size_t view = 5; view < 8; ++view)
    scan.views[view].angle_rad -= rad_from_deg(45.0);
  const Registered out = registered(scan, bracket());
  EXPECT_EQ(out.report.explanation.best, PoseCause::Turned) << out.report.explanation.text;
  EXPECT_EQ(out.report.explanation.views, std::vector<std::size_t>{5});
  EXPECT_TRUE(out.report.outliers.empty());
  EXPECT_LT(out.error_mm, 0.01);
}

TEST(ExplainPoses, BlamesNothingInASoundScan) {
  for (const int views : {4, 8}) {
    for (const bool exact : {true, false}) {
      FaultyScan scan(views);
      scan.seed = static_cast<std::uint32_t>(views);
      if (!exact) scan.misalign(0.5, rad_from_deg(0.3), rad_from_deg(0.15));
      const Registered out = registered(scan, ball_bar(), false);
      EXPECT_EQ(out.report.explanation.best, PoseCause::AsStated)
          << views << exact << out.report.explanation.text;
      EXPECT_TRUE(out.report.outliers.empty()) << views << exact;
      EXPECT_TRUE(out.report.untrusted_reason().empty()) << out.report.untrusted_reason();
    }
  }
}

/// A fault of the study. `size` is a multiple of the noise of a pair of surfels.
struct StudyFault {
  const char* name;
  PoseCause right;
  std::function<void(FaultyScan&, double mm)> make;
};

// Minutes: `./run figures poses` asks for it.
TEST(PoseStudy, NamesTheFault) {
  const char* const part_name = std::getenv("FRANGIA_POSE_PART");
  const char* const seeds_text = std::getenv("FRANGIA_POSE_SEEDS");
  if (seeds_text == nullptr) GTEST_SKIP() << "FRANGIA_POSE_SEEDS is not set";
  const int seeds = std::atoi(seeds_text);
  const RayScene part(make_part(part_name == nullptr ? "bracket" : part_name));
  constexpr double kPairNoise_mm = 0.01;
  constexpr double kArm_mm = 50.0;
  const std::vector<StudyFault> faults{
      {"none", PoseCause::AsStated, [](FaultyScan&, double) {}},
      {"slide before view 5",
       PoseCause::PartMoved,
       [](FaultyScan& scan, double mm) {
         scan.slide(4, Eigen::Vector3d(0.8 * mm, 0.6 * mm, 0.0));
       }},
      {"one view elsewhere",
       PoseCause::ViewMoved,
       [](FaultyScan& scan, double mm) {
         scan.views[3].part =
             Eigen::Translation3d(0.8 * mm, 0.6 * mm, 0.0) * Eigen::Isometry3d::Identity();
       }},
      {"wobble",
       PoseCause::Wobble,
       [](FaultyScan& scan, double mm) { scan.wobble(0.5 * mm / kArm_mm, 0.5 * mm); }},
      {"drift of the projector",
       PoseCause::RigDrift,
       [](FaultyScan& scan, double mm) { scan.drift_projector(mm / 500.0, mm); }},
      {"rig not as stated", PoseCause::Rig, [](FaultyScan& scan, double mm) {
         scan.drift_projector(mm / 500.0, mm, true);
       }}};
  std::string json;
  int blamed = 0;
  for (const StudyFault& fault : faults) {
    for (const double size : {2.0, 10.0, 50.0}) {
      int right = 0;
      int wrong = 0;
      std::size_t left_out = 0;
      double ratio = 0.0;
      for (int seed = 1; seed <= seeds; ++seed) {
        FaultyScan scan(8);
        scan.seed = static_cast<std::uint32_t>(seed);
        const double without_mm = registered(scan, part).error_mm;
        fault.make(scan, size * kPairNoise_mm);
        const Registered out = registered(scan, part);
        const PoseExplanation& found = out.report.explanation;
        const bool named =
            found.best == fault.right ||
            std::find(found.alike.begin(), found.alike.end(), fault.right) != found.alike.end();
        right += named && found.decided ? 1 : 0;
        wrong += !named && found.decided && found.best != PoseCause::AsStated ? 1 : 0;
        left_out += out.report.outliers.size();
        ratio += out.error_mm / without_mm / seeds;
      }
      if (fault.right == PoseCause::AsStated) blamed += wrong;
      json += fmt::format(
          "{}{{\"fault\": \"{}\", \"size\": {}, \"seeds\": {}, \"right\": {}, \"wrong\": {}, "
          "\"left_out\": {}, \"ratio\": {:.3f}}}",
          json.empty() ? "" : ", ",
          fault.name,
          size,
          seeds,
          right,
          wrong,
          left_out,
          ratio);
      if (fault.right == PoseCause::AsStated) break;
    }
  }
  std::printf("FIGURE [%s]\n", json.c_str());
  EXPECT_EQ(blamed, 0);
}

}  // namespace
}  // namespace frangia
