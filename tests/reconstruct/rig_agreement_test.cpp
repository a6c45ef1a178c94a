// The truth is the rig that rendered the frames; rig.toml states another one.
#include "frangia/reconstruct/rig_agreement.h"

#include <cmath>
#include <functional>
#include <string>
#include <variant>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/reconstruct/reconstruct.h"

#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

/// One view of a ball bar with fringes in both directions, rendered once.
class RigAgreementOfAView : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_folder = new testing::TemporaryFolder;  // NOLINT(*-owning-memory) deleted below
    Scan plan;
    plan.folder = shared_folder->path() / "scan";
    plan.rig = testing::small_rig("digital", 3);
    plan.patterns = calibration_patterns(plan.rig, {});  // both directions
    plan.views.push_back({0.0, "views/0"});
    shared_scan = new Scan(  // NOLINT(*-owning-memory)
        simulate_scan(make_part("ball-bar"), plan, {.samples_per_px = 4}));
  }
  static void TearDownTestSuite() {
    delete shared_scan;    // NOLINT(*-owning-memory)
    delete shared_folder;  // NOLINT(*-owning-memory)
  }
  /// What the view says about a rig that differs from the true one.
  static Reconstruction with(const std::function<void(Rig&)>& change) {
    Scan scan = *shared_scan;
    change(scan.rig);
    return reconstruct(scan, {.indirect_light = false});
  }
  static void expect_contradiction(const Reconstruction& found) {
    ASSERT_EQ(found.agreements.size(), 1U);
    const RigAgreement& agreement = found.agreements.front();
    EXPECT_TRUE(agreement.contradicts()) << agreement.text();
    EXPECT_TRUE(agreement.explanation.is_decided()) << agreement.text();
    EXPECT_EQ(agreement.explanation.best.front(),
              "the projector or the camera is not what rig.toml states")
        << agreement.text();
    EXPECT_EQ(found.untrusted_reason, agreement.text());
    EXPECT_TRUE(found.untrusted_reason.starts_with("the two directions of fringes contradict"))
        << found.untrusted_reason;
    EXPECT_TRUE(std::isnan(found.sigma.combined_mm));
  }

 private:
  static testing::TemporaryFolder* shared_folder;
  static Scan* shared_scan;
};

testing::TemporaryFolder* RigAgreementOfAView::shared_folder = nullptr;
Scan* RigAgreementOfAView::shared_scan = nullptr;

TEST_F(RigAgreementOfAView, IsConsistentForTheRigThatRenderedIt) {
  const Reconstruction found = with([](Rig&) {});
  ASSERT_EQ(found.agreements.size(), 1U);
  const RigAgreement& agreement = found.agreements.front();
  EXPECT_TRUE(agreement.is_consistent()) << agreement.text();
  EXPECT_FALSE(agreement.contradicts());
  EXPECT_EQ(agreement.explanation.best.front(), "as described");
  EXPECT_NEAR(agreement.over_noise, 1.0, 0.25);
  EXPECT_EQ(found.untrusted_reason, "");
}

TEST_F(RigAgreementOfAView, NamesAProjectorThatMoved) {
  expect_contradiction(with([](Rig& rig) {
    rig.projector.position_mm += Eigen::Vector3d(0.8, -1.0, 0.5);
    rig.projector.rotation = Eigen::AngleAxisd(0.002, Eigen::Vector3d(1.0, 0.5, 0.3).normalized()) *
                             rig.projector.rotation;
  }));
}

TEST_F(RigAgreementOfAView, NamesAFocalLengthThatIsOff) {
  expect_contradiction(
      with([](Rig& rig) { std::get<PinholeModel>(rig.projector.model).focal_px *= 0.95; }));
}

TEST_F(RigAgreementOfAView, LeavesADisagreementInSigmaThatIsNoContradiction) {
  const Reconstruction sound = with([](Rig&) {});
  const Reconstruction found = with([](Rig& rig) {
    rig.projector.rotation =
        Eigen::AngleAxisd(rad_from_deg(0.001), Eigen::Vector3d::UnitX()) * rig.projector.rotation;
  });
  EXPECT_EQ(found.untrusted_reason, "");
  const std::string text = found.agreements.front().text();
  EXPECT_NE(text.find("the difference is in sigma"), std::string::npos) << text;
  EXPECT_GT(found.sigma.systematic_mm, 0.5 * found.agreements.front().median_mm);
  EXPECT_GT(found.sigma.combined_mm, sound.sigma.combined_mm);
}

}  // namespace
}  // namespace frangia
