// Which fringes measure depth, by where the projector stands.
#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/rig/paper_rig.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

/// A digital projector at a place, which looks at a point 500 mm before the camera.
Rig rig_with_projector_at(const Eigen::Vector3d& position_mm) {
  Rig rig = make_paper_rig({});
  CameraModel model;
  model.width_px = 1280;
  model.height_px = 800;
  model.focal_px = {1900.0, 1900.0};
  model.principal_point_px = {639.5, 399.5};
  rig.projector.model = model;
  rig.projector.position_mm = position_mm;
  const Eigen::Vector3d forward = (Eigen::Vector3d(0.0, 0.0, 500.0) - position_mm).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(forward).normalized();
  rig.projector.rotation.row(0) = right;
  rig.projector.rotation.row(1) = forward.cross(right);
  rig.projector.rotation.row(2) = forward;
  return rig;
}

TEST(FringeParallax, DecidesTheDirectionByThePlaceOfTheProjector) {
  using Direction = FringeDirection;
  for (const double side : {1.0, -1.0}) {
    const Rig beside = rig_with_projector_at({180.0 * side, 20.0, 30.0});
    const Rig above = rig_with_projector_at({20.0, 180.0 * side, 30.0});
    EXPECT_EQ(measuring_direction(beside), Direction::Vertical);
    EXPECT_EQ(measuring_direction(above), Direction::Horizontal);
    EXPECT_FALSE(lacks_parallax(beside, Direction::Vertical));
    EXPECT_FALSE(lacks_parallax(above, Direction::Horizontal));
    EXPECT_TRUE(
        lacks_parallax(rig_with_projector_at({0.0, 180.0 * side, 0.0}), Direction::Vertical));
  }
  // A point 500 mm away, 1 % farther: 5 mm, seen at 180 / 500 under the baseline of 180 mm.
  const Rig rig = rig_with_projector_at({180.0, 0.0, 0.0});
  const double distance = std::hypot(180.0, 500.0);
  EXPECT_NEAR(fringe_parallax_px(rig, Direction::Vertical),
              1900.0 * 5.0 * (180.0 / distance) / distance,
              0.3);
  EXPECT_NEAR(fringe_parallax_px(rig, Direction::Horizontal), 0.0, 0.01);
  EXPECT_EQ(measuring_direction(make_paper_rig({})), Direction::Vertical);  // angular
  EXPECT_FALSE(lacks_parallax(make_paper_rig({}), Direction::Vertical));
}

}  // namespace
}  // namespace frangia
