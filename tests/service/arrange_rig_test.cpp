#include "frangia/service/arrange_rig.h"

#include <variant>

#include <gtest/gtest.h>

#include "frangia/simulate/rig_presets.h"

#include "support/error_of.h"

namespace frangia {
namespace {

using testing::error_of;

Eigen::Vector2d aim_of(const Rig& rig) {
  const auto& model = std::get<PinholeModel>(rig.projector.model);
  return model.project(rig.projector.from_rig(rig.turntable->point_mm));
}

TEST(ArrangeRig, KeepsTheProjectorAimedAtTheTurntable) {
  const Rig before = rig_preset("digital");
  const Rig after = arrange_rig(before, {.baseline_mm = 150.0, .distance_mm = 420.0});
  EXPECT_NEAR(after.projector.position_mm.norm(), 150.0, 1e-9);
  EXPECT_NEAR(after.turntable->point_mm.norm(), 420.0, 1e-9);
  EXPECT_NEAR((aim_of(after) - aim_of(before)).norm(), 0.0, 1e-6);
  const auto error_of_rotation = [](const Eigen::Matrix3d& rotation) {
    return (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  };
  EXPECT_NEAR(error_of_rotation(after.projector.rotation),
              error_of_rotation(before.projector.rotation),
              1e-13);
}

TEST(ArrangeRig, ScalesFocalLengthsAndDropsTheCalibration) {
  Rig before = rig_preset("digital");
  before.calibration = Calibration{};
  const Rig after = arrange_rig(before, {.camera_focal_px = 1000.0, .projector_focal_px = 900.0});
  EXPECT_NEAR(after.reference().model.focal_px.x(), 1000.0, 1e-9);
  EXPECT_NEAR(after.reference().model.focal_px.y() / after.reference().model.focal_px.x(),
              before.reference().model.focal_px.y() / before.reference().model.focal_px.x(),
              1e-12);
  EXPECT_NEAR(std::get<PinholeModel>(after.projector.model).focal_px.x(), 900.0, 1e-9);
  EXPECT_FALSE(after.calibration);
}

TEST(ArrangeRig, RefusesWhatTheRigDoesNotHave) {
  const auto refusal = [](const Rig& rig, const RigArrangement& wanted) {
    return error_of([&] { static_cast<void>(arrange_rig(rig, wanted)); });
  };
  Rig rig = rig_preset("angular");
  EXPECT_NE(refusal(rig, {.projector_focal_px = 900.0}).find("projector_focal_px"),
            std::string::npos);
  EXPECT_NE(refusal(rig, {.baseline_mm = -1.0}).find("baseline_mm"), std::string::npos);
  rig.turntable.reset();
  EXPECT_NE(refusal(rig, {.distance_mm = 300.0}).find("distance_mm"), std::string::npos);
}

}  // namespace
}  // namespace frangia
