// The truth is the rig through which the poses are rendered.
#include "frangia/calibrate/solve/calibrate_rig.h"

#include <cmath>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/calibrate/report/calibration_report.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/dataset/write_scan.h"
#include "frangia/rig/read_rig.h"
#include "frangia/simulate/simulate_calibration.h"

#include "support/error_of.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

namespace frangia {
namespace {

/// Six poses of a checkerboard, rendered once for all tests.
class CalibrateRig : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_folder = new testing::TemporaryFolder;  // NOLINT(*-owning-memory) deleted below
    CalibrationPlan plan;
    plan.folder = shared_folder->path() / "poses";
    plan.rig = testing::small_rig("digital");
    plan.poses = 6;
    static_cast<void>(simulate_calibration(plan, {.samples_per_px = 4}));
  }
  static void TearDownTestSuite() {
    delete shared_folder;  // NOLINT(*-owning-memory)
    delete shared_result;  // NOLINT(*-owning-memory)
  }

  [[nodiscard]] static Scan scan() {
    return read_scan(shared_folder->path() / "poses", {}, RigContent::StartValues);
  }
  [[nodiscard]] static Rig truth() {
    return read_rig(shared_folder->path() / "poses" / "truth-rig.toml");
  }
  /// What the poses give, with the pictures for a report, calibrated once.
  [[nodiscard]] static const RigCalibration& found() {
    if (shared_result == nullptr) {
      CalibrateRigOptions options;
      options.pose.keep_picture = true;
      shared_result =
          new RigCalibration(calibrate_rig(scan(), options));  // NOLINT(*-owning-memory)
    }
    return *shared_result;
  }
  static std::string fault_of(const Scan& scan) {
    return testing::error_of([&] { static_cast<void>(calibrate_rig(scan)); });
  }

 private:
  static testing::TemporaryFolder* shared_folder;
  static RigCalibration* shared_result;
};

testing::TemporaryFolder* CalibrateRig::shared_folder = nullptr;
RigCalibration* CalibrateRig::shared_result = nullptr;

TEST_F(CalibrateRig, FindsTheRigThatRenderedThePoses) {
  const RigCalibration& found = CalibrateRig::found();
  const Rig rig = truth();
  const auto& projector = std::get<PinholeModel>(found.rig.projector.model);
  const auto& true_projector = std::get<PinholeModel>(rig.projector.model);
  EXPECT_EQ(found.views.size(), 6U);
  EXPECT_LT(found.solution.reference().residuals.rms_px, 0.1);
  EXPECT_LT(found.solution.reference().projector_residuals.rms_px,
            0.25);  // of a camera with pixels twice as wide
  const double focal_px = rig.reference().model.focal_px.x();
  EXPECT_NEAR(found.rig.reference().model.focal_px.x(), focal_px, 2e-3 * focal_px);
  EXPECT_NEAR(projector.focal_px.x(), true_projector.focal_px.x(), 2e-3 * focal_px);
  EXPECT_NEAR(found.rig.projector.position_mm.norm(), rig.projector.position_mm.norm(), 0.3);
  EXPECT_GT(found.solution.point_sigma_mm, 0.0);
  EXPECT_LT(found.solution.point_sigma_mm,
            0.2);  // without motions of the whole frame
  ASSERT_TRUE(found.rig.calibration);
  EXPECT_EQ(found.rig.calibration->poses, 6);
  EXPECT_EQ(found.rig.calibration->sigma.size(), found.solution.parameters.size());
}

TEST(CalibrateRigByCode, FindsTheRigFromGrayCodeAlone) {
  const testing::TemporaryFolder folder;
  CalibrationPlan plan;
  plan.folder = folder.path() / "poses";
  plan.rig = testing::small_rig("digital");
  plan.poses = 5;
  plan.patterns.sequence = "gray-alone";
  plan.patterns.fringes = 160.0;
  static_cast<void>(simulate_calibration(plan, {.samples_per_px = 4}));
  Scan scan = read_scan(plan.folder, {}, RigContent::StartValues);
  // The frames of the code show the board, too.
  std::erase_if(scan.patterns, [](const Pattern& one) { return one.kind == PatternKind::White; });
  const RigCalibration found = calibrate_rig(scan);
  const Rig& rig = plan.rig;
  const auto& projector = std::get<PinholeModel>(found.rig.projector.model);
  const double true_focal_px = std::get<PinholeModel>(rig.projector.model).focal_px.x();
  EXPECT_LT(found.solution.reference().projector_residuals.rms_px, 0.4);
  EXPECT_NEAR(projector.focal_px.x(), true_focal_px, 4e-3 * true_focal_px);
  EXPECT_NEAR(found.rig.projector.position_mm.norm(), rig.projector.position_mm.norm(), 1.0);
}

TEST_F(CalibrateRig, WritesAReportThatStandsAlone) {
  const RigCalibration& found = CalibrateRig::found();
  const testing::TemporaryFolder folder;
  const std::vector<std::string> warnings = {"a < b"};
  write_calibration_report(folder.path() / "report.html", found, *scan().board, warnings);
  const std::string html = testing::text_of(folder.path() / "report.html");
  EXPECT_NE(html.find("a &lt; b"), std::string::npos);
  EXPECT_EQ(html.find("http"), std::string::npos);
  std::size_t pictures = 0;
  for (std::size_t at = html.find("data:image/png;base64,iVBOR"); at != std::string::npos;
       at = html.find("data:image/png;base64,iVBOR", at + 1))
    ++pictures;
  EXPECT_EQ(pictures, 6U);
  for (const BoardView& view : found.views)
    EXPECT_NE(html.find(view.name), std::string::npos) << view.name;
}

TEST_F(CalibrateRig, QuestionsTheSquareWhereTheBaselineIsKnown) {
  Scan known = scan();
  known.rig.projector.position_mm = truth().projector.position_mm;
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& text) {
    if (text.find("board.square_mm is") != std::string::npos) warnings.push_back(text);
  };
  static_cast<void>(calibrate_rig(known, {}, run));
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  known.board->square_mm *= 1.1;
  static_cast<void>(calibrate_rig(known, {}, run));
  EXPECT_EQ(warnings.size(), 1U);
}

TEST_F(CalibrateRig, NamesAMissingDirection) {
  Scan one = scan();
  std::erase_if(one.patterns, [](const Pattern& pattern) {
    return pattern.direction == FringeDirection::Horizontal;
  });
  EXPECT_NE(fault_of(one).find("there are no horizontal fringes"), std::string::npos)
      << fault_of(one);
}

TEST_F(CalibrateRig, RecognizesExchangedDirections) {
  Scan swapped = scan();
  for (Pattern& pattern : swapped.patterns) {
    if (pattern.kind != PatternKind::Fringe) continue;
    pattern.direction = pattern.direction == FringeDirection::Vertical ? FringeDirection::Horizontal
                                                                       : FringeDirection::Vertical;
  }
  // The period of the projector's height is too short for its width.
  EXPECT_NE(fault_of(swapped).find("rows and columns of the projector are exchanged"),
            std::string::npos)
      << fault_of(swapped);
  auto& projector = std::get<PinholeModel>(swapped.rig.projector.model);
  projector.height_px = projector.width_px = 800;  // both directions are absolute either way
  EXPECT_NE(fault_of(swapped).find("rows and columns of the projector are exchanged"),
            std::string::npos)
      << fault_of(swapped);
}

TEST_F(CalibrateRig, StatesTheCornersThatTheImagesShow) {
  Scan wrong = scan();
  wrong.board->columns = 9;
  wrong.views.resize(3);
  EXPECT_NE(fault_of(wrong).find("set corners = [10, 7]"), std::string::npos) << fault_of(wrong);
}

TEST_F(CalibrateRig, NeedsABoardAndThreePoses) {
  Scan none = scan();
  none.board.reset();
  EXPECT_NE(fault_of(none).find("[board] is missing"), std::string::npos) << fault_of(none);
  Scan two = scan();
  two.views.resize(2);
  EXPECT_NE(fault_of(two).find("the scan has 2 views"), std::string::npos) << fault_of(two);
}

}  // namespace
}  // namespace frangia
