#include "frangia/simulate/rig_presets.h"

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

TEST(RigPresets, SeeAndLightTheWholeOfAPartOfAHundredMillimetres) {
  for (const std::string& name : rig_preset_names()) {
    const Rig rig = rig_preset(name);
    for (const double x : {-30.0, 30.0}) {
      for (const double y : {-30.0, 30.0}) {
        for (const double z : {0.0, 100.0}) {
          const Eigen::Vector3d seen = rig.rig_from_object(0.7) * Eigen::Vector3d(x, y, z);
          const Eigen::Vector2d pixel = rig.reference().model.project(seen);
          EXPECT_GT(pixel.minCoeff(), 0.0) << name;
          EXPECT_LT(pixel.x(), rig.reference().model.width_px) << name;
          EXPECT_LT(pixel.y(), rig.reference().model.height_px) << name;
          const Eigen::Vector3d lit = rig.projector.from_rig(seen);
          if (const auto* model = std::get_if<PinholeModel>(&rig.projector.model)) {
            EXPECT_GT(model->project(lit).minCoeff(), 0.0) << name;
            EXPECT_LT(model->project(lit).x(), model->width_px) << name;
            EXPECT_LT(model->project(lit).y(), model->height_px) << name;
          } else {
            EXPECT_LT(std::abs(std::atan2(lit.x(), lit.z())), rad_from_deg(12.0)) << name;
          }
        }
      }
    }
  }
}

TEST(RigPresets, HaveRotationsAndUnitAxes) {
  for (const std::string& name : rig_preset_names()) {
    const Rig rig = rig_preset(name);
    const Eigen::Matrix3d& r = rig.projector.rotation;
    EXPECT_NEAR((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-10) << name;
    EXPECT_NEAR(r.determinant(), 1.0, 1e-10) << name;
    EXPECT_NEAR(rig.turntable->axis.norm(), 1.0, 1e-12) << name;
  }
}

TEST(RigPresets, CarduccisLaserSheetHoldsTheAxisAndTheProjector) {
  const Rig rig = rig_preset("carducci");
  for (const double up : {0.0, 100.0}) {
    const Eigen::Vector3d on_axis = rig.turntable->point_mm + up * rig.turntable->axis;
    EXPECT_NEAR(rig.laser_sheet->normal.dot(on_axis), rig.laser_sheet->offset_mm, 1e-9);
  }
  EXPECT_NEAR(
      rig.laser_sheet->normal.dot(rig.projector.position_mm), rig.laser_sheet->offset_mm, 1e-9);
  // 20 degrees between the two axes, which cross 490 mm before the camera.
  EXPECT_NEAR(std::acos(rig.projector.rotation(2, 2)), rad_from_deg(20.0), 1e-12);
  EXPECT_NEAR(
      (rig.projector.from_rig({0, 0, 490}) - Eigen::Vector3d(0, 0, 1000)).norm(), 0.0, 1e-9);
}

TEST(RigPresets, RefuseAnotherName) {
  EXPECT_THROW(static_cast<void>(rig_preset("hubble")), Error);
}

}  // namespace
}  // namespace frangia
