#include <gtest/gtest.h>

#include "frangia/rig/rig.h"
#include "frangia/simulate/rig_presets.h"

namespace frangia {
namespace {

TEST(RigOfCamera, ShowsTheSameRigInTheFrameOfAnotherCamera) {
  Rig rig = rig_preset("binocular");
  rig.laser_sheet = LaserSheet{{0.6, 0.0, 0.8}, 250.0};
  const Rig seen = rig_of_camera(rig, 1);
  const Eigen::Isometry3d to_camera = rig.cameras[1].camera_from_rig();
  EXPECT_EQ(rig.cameras.size(), 2U);
  EXPECT_EQ(seen.cameras.size(), 1U);
  EXPECT_EQ(seen.reference().name, "left");
  EXPECT_TRUE((to_camera * rig.cameras[1].position_mm).isZero(1e-9));
  const Eigen::Vector3d point(12.0, -7.0, 480.0);
  EXPECT_TRUE(
      seen.projector.from_rig(to_camera * point).isApprox(rig.projector.from_rig(point), 1e-12));
  EXPECT_NEAR(seen.laser_sheet->normal.dot(to_camera * point) - seen.laser_sheet->offset_mm,
              rig.laser_sheet->normal.dot(point) - rig.laser_sheet->offset_mm,
              1e-9);
  for (const double angle_rad : {0.0, 1.0, -2.5}) {
    EXPECT_TRUE(seen.rig_from_object(angle_rad).isApprox(to_camera * rig.rig_from_object(angle_rad),
                                                         1e-12));
  }
}

}  // namespace
}  // namespace frangia
