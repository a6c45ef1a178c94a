#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/reconstruct/internal/calibration_part.h"

namespace frangia {
namespace {

const RigCovariance kOpen{{"camera.k1", "projector.x_mm"},
                          (Eigen::Matrix2d() << 4.0, 1.0, 1.0, 9.0).finished()};

TEST(WithOpenParameters, GivesARigWithoutCalibrationTheCovariance) {
  const Rig rig = with_open_parameters({}, kOpen);
  ASSERT_TRUE(rig.calibration);
  EXPECT_EQ(rig.calibration->covariance.parameters, kOpen.parameters);
  EXPECT_EQ(rig.calibration->covariance.covariance, kOpen.covariance);
}

TEST(WithOpenParameters, AddsToTheCovarianceOfTheCalibrationByName) {
  Rig given;
  given.calibration.emplace().covariance = {{"projector.x_mm", "camera.focal_px"},
                                            (Eigen::Matrix2d() << 1.0, 0.5, 0.5, 2.0).finished()};
  const RigCovariance all = with_open_parameters(given, kOpen).calibration->covariance;
  EXPECT_EQ(all.parameters,
            (std::vector<std::string>{"projector.x_mm", "camera.focal_px", "camera.k1"}));
  Eigen::Matrix3d wanted;
  wanted << 10.0, 0.5, 1.0, 0.5, 2.0, 0.0, 1.0, 0.0, 4.0;
  EXPECT_EQ(all.covariance, wanted);
}

TEST(WithOpenParameters, KeepsARigOfWhichNothingIsOpen) {
  EXPECT_FALSE(with_open_parameters({}, {}).calibration);
}

}  // namespace
}  // namespace frangia
