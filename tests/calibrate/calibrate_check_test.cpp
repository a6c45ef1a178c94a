// The truth is the rig through which the parts are rendered.
#include "frangia/calibrate/check/calibrate_check.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/reconstruct/refine_scan_rig.h"

#include "support/error_of.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

/// Names of the figures that failed.
std::vector<std::string> failed(const RigCheck& check) {
  std::vector<std::string> names;
  for (const RigCheckItem& item : check.items)
    if (!item.passed()) names.push_back(item.name);
  return names;
}

TEST(CalibrateCheck, TellsAnAxisThatMovedByTheFewFacesThatShowIt) {
  const testing::TemporaryFolder folder;
  const Scan scan = testing::small_scan(folder.path() / "scan", "bracket", "digital", 6, {});
  const RigCheck sound = calibrate_check(scan, scan.rig);
  EXPECT_TRUE(sound.passed()) << sound.items.front().measured;
  Rig moved = scan.rig;
  const Eigen::Vector3d across = moved.turntable->axis.unitOrthogonal();
  moved.turntable->point_mm += 0.3 * across;
  EXPECT_FALSE(calibrate_check(scan, moved).passed());
}

TEST(CalibrateCheck, NamesAFurtherCameraThatWasKnocked) {
  const testing::TemporaryFolder folder;
  Scan plan;
  plan.folder = folder.path() / "scan";
  plan.rig = testing::small_rig("binocular");
  plan.patterns = default_patterns(plan.rig);
  plan.views = {{0.0, "views/0"}, {rad_from_deg(20.0), "views/1"}};
  Scan scan = simulate_scan(make_part("bust"), plan, {});
  const RigCheck sound = calibrate_check(scan, scan.rig);
  EXPECT_TRUE(sound.passed());
  Rig knocked = scan.rig;
  PosedCamera& camera = knocked.cameras.at(1);
  camera.rotation =
      Eigen::AngleAxisd(rad_from_deg(0.2), Eigen::Vector3d::UnitX()).toRotationMatrix() *
      camera.rotation;
  const std::vector<std::string> names = failed(calibrate_check(scan, knocked));
  ASSERT_FALSE(names.empty());
  for (const std::string& name : names)
    EXPECT_NE(name.find(", camera left"), std::string::npos) << name;

  // Refining keeps the rig and says that the camera does not fit it.
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& warning) { warnings.push_back(warning); };
  scan.rig = knocked;
  static_cast<void>(refine_scan_rig(scan, {}, run));
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.find("camera left: its surfaces differ") != std::string::npos;
  }));
}

TEST(CalibrateCheck, RefusesAProjectorThatIsALabel) {
  Scan scan;
  scan.folder = "scan";
  scan.rig.projector.is_label = true;
  const std::string message =
      testing::error_of([&] { static_cast<void>(calibrate_check(scan, scan.rig)); });
  EXPECT_NE(message.find("its projector is a label"), std::string::npos) << message;
}

}  // namespace
}  // namespace frangia
