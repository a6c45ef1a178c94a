// Explanations of views that were taken by a rig or of a part which is not where it is stated.
#include <cmath>
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

TEST(ExplainPoses, CorrectsFaultsOfACurvedPartAsFarAsItsNoiseLets) {
  const RayScene bust(make_part("bust"));
  FaultyScan slid(8);
  slid.slide(4, Eigen::Vector3d(0.12, 0.09, 0.0));
  FaultyScan wobbled(8);
  wobbled.wobble(rad_from_deg(0.03), 0.03);
  FaultyScan drifted(8);
  drifted.drift_projector(rad_from_deg(0.05), 0.1);
  const auto expect_corrected = [&](const FaultyScan& scan, PoseCause cause) {
    const Registered out = registered(scan, bust);
    EXPECT_EQ(out.report.explanation.best, cause) << out.report.text();
    EXPECT_TRUE(out.report.outliers.empty()) << out.report.text();
    EXPECT_EQ(out.report.untrusted_reason(), "");
    EXPECT_LT(out.error_mm, 0.008) << out.report.text();
    EXPECT_LT(out.error.share_beyond, 0.05) << out.error.over_sigma;
  };
  expect_corrected(slid, PoseCause::PartMoved);
  expect_corrected(wobbled, PoseCause::Wobble);
  expect_corrected(drifted, PoseCause::RigDrift);
}

TEST(ExplainPoses, NamesFaultsThatAreSmallerThanTheNoiseOfOnePair) {
  // Thousands of pairs show them, with the noise of a cheap camera too.
  const RayScene bust(make_part("bust"));
  const auto expect_named = [&](FaultyScan scan, PoseCause cause) {
    scan.phase_sigma_rad = 0.03;
    const Registered out = registered(scan, bust, false);
    EXPECT_EQ(out.report.explanation.best, cause) << out.report.text();
    EXPECT_TRUE(out.report.explanation.decided) << out.report.text();
  };
  FaultyScan wobbled(8);
  wobbled.wobble(rad_from_deg(0.03), 0.03);
  FaultyScan wrong(8);
  wrong.drift_projector(rad_from_deg(0.1), 0.5, true);
  FaultyScan lost(8);
  for (std::size_t view = 3; view < lost.views.size(); ++view)
    lost.views[view].angle_rad -= rad_from_deg(1.8);
  expect_named(wobbled, PoseCause::Wobble);
  expect_named(wrong, PoseCause::Rig);
  expect_named(lost, PoseCause::Turned);
  expect_named(FaultyScan(8), PoseCause::AsStated);
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

TEST(ExplainPoses, CorrectsTheWarmUpOfAProjector) {
  for (const double constant_views : {1.2, 3.0}) {
    FaultyScan scan(8);
    scan.warm_up_projector(rad_from_deg(0.05), 0.1, constant_views);
    const Registered out = registered(scan, ball_bar());
    const PoseExplanation& found = out.report.explanation;
    EXPECT_EQ(found.best, PoseCause::RigDrift) << found.text;
    EXPECT_TRUE(found.decided) << found.text;
    EXPECT_TRUE(out.report.outliers.empty());
    EXPECT_LT(out.error_mm, 0.012) << found.text;
    EXPECT_LT(out.error.share_beyond, 0.05) << out.error.over_sigma;
  }
}

TEST(ExplainPoses, FollowsADriftByTheTimesOfTheViews) {
  FaultyScan scan(8);
  // Even in time, with a pause that the order of the views does not show.
  scan.times_s = {0.0, 20.0, 40.0, 60.0, 600.0, 620.0, 640.0, 660.0};
  scan.move_projector(rad_from_deg(0.05), 0.1, [&](std::size_t view) {
    return scan.times_s[view] / scan.times_s.back();
  });
  const Registered out = registered(scan, ball_bar());
  const PoseExplanation& found = out.report.explanation;
  EXPECT_EQ(found.best, PoseCause::RigDrift) << found.text;
  EXPECT_TRUE(found.decided) << found.text;
  EXPECT_LT(out.error_mm, 0.012) << found.text;
  EXPECT_EQ(found.text.find("evenly spaced in time"), std::string::npos) << found.text;
  scan.times_s.clear();
  const Registered without = registered(scan, ball_bar());
  const std::string& text = without.report.explanation.text;
  EXPECT_TRUE(without.report.explanation.best != PoseCause::RigDrift ||
              text.find("evenly spaced in time") != std::string::npos)
      << text;
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

TEST(ExplainPoses, NamesAWrongRigThoughAnAxisElsewhereBringsTheViewsTogether) {
  for (const char* part : {"bust", "shaft"}) {
    FaultyScan scan(8);
    scan.drift_projector(rad_from_deg(0.1), 0.5, true);
    const Registered out = registered(scan, RayScene(make_part(part)), false);
    const PoseExplanation& found = out.report.explanation;
    EXPECT_EQ(found.best, PoseCause::Rig) << part << found.text;
    EXPECT_TRUE(found.decided) << part << found.text;
  }
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
  EXPECT_TRUE(out.report.undetermined.empty()) << out.report.text();  // by a view that is not there
}

TEST(ExplainPoses, JoinsSeveralViewsThatWereEachElsewhere) {
  const std::vector<std::vector<std::size_t>> cases{{1, 3, 5}, {1, 2}, {2, 5}};
  for (const auto& moved : cases) {
    FaultyScan scan(6);
    double way = 0.4;
    for (const std::size_t view : moved) {
      scan.displace(view, 0.4 * Eigen::Vector3d(std::cos(way), std::sin(way), 0.0));
      way += 2.2;
    }
    const Registered out = registered(scan, bracket());
    // Six views of flat faces do not decide which were elsewhere: that is in sigma.
    EXPECT_LT(out.error.share_beyond, 0.05) << out.error.rms_mm << out.report.explanation.text;
    EXPECT_LT(out.error_mm, 0.25) << out.report.explanation.text;
    EXPECT_TRUE(out.report.outliers.empty());
    ASSERT_EQ(out.warnings.size(), 1U);
  }
}

TEST(ExplainPoses, NamesTheViewsThatWereEachElsewhereWhereTheyOverlapWell) {
  FaultyScan scan(8);
  scan.displace(1, Eigen::Vector3d(0.46, 0.19, 0.0));
  scan.displace(4, Eigen::Vector3d(-0.43, 0.26, 0.0));
  const Registered out = registered(scan, ball_bar());
  const PoseExplanation& found = out.report.explanation;
  EXPECT_EQ(found.best, PoseCause::ViewsMoved) << found.text;
  EXPECT_EQ(found.views, (std::vector<std::size_t>{1, 4})) << found.text;
  EXPECT_TRUE(found.decided) << found.text;
  EXPECT_LT(out.error_mm, 0.01);
  EXPECT_NE(found.text.find("in views 2 and 5"), std::string::npos) << found.text;
}

TEST(ExplainPoses, SaysByHowMuchAViewIsTurned) {
  FaultyScan scan(8);
  const Eigen::Vector3d axis = Eigen::Vector3d(0.6, 0.0, 0.8);
  scan.displace(3, Eigen::Isometry3d(Eigen::AngleAxisd(rad_from_deg(2.0), axis)));
  const Registered out = registered(scan, ball_bar());
  const PoseExplanation& found = out.report.explanation;
  EXPECT_EQ(found.best, PoseCause::ViewMoved) << found.text;
  EXPECT_NEAR(found.turned_rad, rad_from_deg(2.0), rad_from_deg(0.1)) << found.text;
  EXPECT_EQ(out.report.outliers, std::vector<std::size_t>{3});
}

TEST(ExplainPoses, BlamesTheRigAndNotTheTableForAWrongPrincipalPoint) {
  FaultyScan scan(8);
  for (testing::TrueView& view : scan.views)
    view.rig.reference().model.principal_point_px += Eigen::Vector2d(0.4, 0.3);
  const Registered out = registered(scan, bracket());
  const PoseExplanation& found = out.report.explanation;
  EXPECT_EQ(found.best, PoseCause::Rig) << found.text;
  EXPECT_TRUE(out.report.outliers.empty());
}

const RayScene& shaft() {
  static const RayScene kPart(make_part("shaft"));
  return kPart;
}

TEST(ExplainPoses, CorrectsTheWobbleOfATableUnderAShaft) {
  FaultyScan scan(8);
  scan.wobble(rad_from_deg(0.03), 0.03);
  const Registered out = registered(scan, shaft());
  const PoseExplanation& found = out.report.explanation;
  EXPECT_EQ(found.best, PoseCause::Wobble) << found.text;
  EXPECT_LT(out.error_mm, 0.02);
  EXPECT_LT(out.error.share_beyond, 0.05) << out.error.over_sigma;
  EXPECT_TRUE(out.report.untrusted_reason().empty()) << out.report.untrusted_reason();
}

TEST(ExplainPoses, NamesAnglesThatRestOnTheStatementAlone) {
  FaultyScan scan(8);
  Turntable& table = *scan.stated.turntable;
  table.point_sigma_mm = 0.02;
  table.axis_sigma_rad = rad_from_deg(0.01);
  table.angle_sigma_rad = rad_from_deg(0.3);
  const Registered out = registered(scan, shaft());
  ASSERT_TRUE(out.report.kept_rig);
  EXPECT_NE(out.report.text().find("hardly shows the angles of the views (0.3°)"),
            std::string::npos)
      << out.report.text();
  // The keyway shows them a little.
  const auto turns = out.report.motions[3].row(2) - out.report.motions[0].row(2);
  EXPECT_GT(turns.norm(), rad_from_deg(0.15));
  EXPECT_LT(turns.norm(), rad_from_deg(0.3));
}

TEST(ExplainPoses, CountsInSigmaAMoveThatTheScatterOfThePairsHides) {
  for (const int views : {6, 8}) {
    FaultyScan scan(views);
    scan.seed = static_cast<std::uint32_t>(views);
    const double way_mm = views == 6 ? 0.1 : 0.03;
    scan.slide(scan.views.size() / 2, way_mm * Eigen::Vector3d(0.8, 0.6, 0.0));
    const Registered out = registered(scan, bracket());
    EXPECT_LT(out.error.share_beyond, 0.05)
        << out.error.rms_mm << " " << out.error.over_sigma << out.report.explanation.text;
  }
}

TEST(ExplainPoses, CountsInSigmaTwoViewsThatWereElsewhereAlongFlatFaces) {
  // 0.1 mm along the faces changes the distances of the pairs by less than is noticeable.
  FaultyScan scan(6);
  scan.displace(1, 0.1 * Eigen::Vector3d(std::cos(0.4), std::sin(0.4), 0.0));
  scan.displace(4, 0.1 * Eigen::Vector3d(std::cos(2.6), std::sin(2.6), 0.0));
  const Registered out = registered(scan, bracket());
  EXPECT_LT(out.error.share_beyond, 0.02)
      << out.error.rms_mm << " " << out.error.over_sigma << out.report.explanation.text;
  EXPECT_LT(out.error.over_sigma, 2.0);
}

TEST(ExplainPoses, AdvisesNoRefinementOfARigThatWasRefined) {
  FaultyScan scan(8);
  scan.drift_projector(rad_from_deg(0.1), 0.5, true);
  RegisterOptions options;
  options.wrong_rig = WrongRig::AdviseCalibration;
  const Registered out = registered(scan, bracket(), false, options);
  EXPECT_EQ(out.report.explanation.best, PoseCause::Rig) << out.report.explanation.text;
  EXPECT_EQ(out.report.explanation.remedy, "calibrate the rig again");
}

TEST(ExplainPoses, CountsInSigmaWhatNoOverlapShowsOfAPlate) {
  const RayScene plate(make_part("plate"));
  FaultyScan scan(8);
  scan.slide(4, Eigen::Vector3d(0.32, 0.24, 0.0));
  const Registered out = registered(scan, plate);
  const bool trusted = out.report.untrusted_reason().empty();
  EXPECT_TRUE(!trusted || out.error.share_beyond < 0.05)
      << out.error.rms_mm << " " << out.error.over_sigma << out.report.explanation.text;
}

TEST(RegistrationReport, IsNotTrustedWithoutAWholeSide) {
  RegistrationReport report;
  for (int i = 0; i < 12; ++i)
    report.given_angles_rad.push_back(kTwoPi * i / 12);
  report.outliers = {3, 7, 10};
  EXPECT_EQ(report.untrusted_reason(), "");
  report.outliers = {3, 4, 5, 6};
  EXPECT_NE(report.untrusted_reason().find("more than a quarter"), std::string::npos);
  report.outliers = {3, 4, 5};
  EXPECT_EQ(report.untrusted_reason(), "");
  report.given_angles_rad = {0.0, 0.8, 1.6, 2.4, 3.2, 4.4, 5.5};
  report.outliers = {5};
  EXPECT_NE(report.untrusted_reason().find("a whole side"), std::string::npos)
      << report.untrusted_reason();
}

/// The standard deviation of a parameter of the rig; 0 where it is not open.
double open_sigma(const RegistrationReport& report, const std::string& name) {
  const RigCovariance& open = report.rig_open;
  for (std::size_t i = 0; i < open.parameters.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (open.parameters[i] == name) return std::sqrt(open.covariance(at, at));
  }
  return 0.0;
}

TEST(ExplainPoses, LeavesOpenARigWhoseFaultTheScatterOfThePairsHides) {
  FaultyScan scan(8);
  scan.stated.reference().model.distortion[0] += 0.03;
  const Registered out = registered(scan, ball_bar(), false);
  EXPECT_GT(open_sigma(out.report, "camera.k1"), 0.01) << out.report.explanation.text;
}

TEST(ExplainPoses, LeavesNothingOpenOfASoundRig) {
  const Registered out = registered(FaultyScan(8), ball_bar());
  EXPECT_LT(open_sigma(out.report, "camera.k1"), 0.001);
}

TEST(ExplainPoses, FindsNoContradictionInTheNoiseOfGrazingFaces) {
  // The bracket has faces that a view sees at grazing incidence, with ten times the usual noise.
  const Registered out = registered(FaultyScan(8), bracket());
  EXPECT_EQ(out.report.explanation.best, PoseCause::AsStated) << out.report.explanation.text;
  EXPECT_LT(out.report.contradiction, 0.002);
  EXPECT_TRUE(out.report.outliers.empty());
  EXPECT_EQ(out.report.untrusted_reason(), "");
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

}  // namespace
}  // namespace frangia
