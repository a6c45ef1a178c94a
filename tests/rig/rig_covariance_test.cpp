#include "frangia/rig/rig_covariance.h"

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/rig/paper_rig.h"
#include "frangia/rig/rig.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

Rig pinhole_rig() {
  Rig rig = make_paper_rig({});
  CameraModel projector;
  projector.width_px = 1280;
  projector.height_px = 800;
  projector.focal_px = {2000.0, 2010.0};
  projector.principal_point_px = {640.0, 790.0};
  rig.projector.model = projector;
  return rig;
}

class RigCovarianceFile : public ::testing::Test {
 protected:
  [[nodiscard]] std::string error_of(const std::string& text, const Rig& rig = pinhole_rig()) {
    std::ofstream(path()) << text;
    return testing::error_of([&] { static_cast<void>(read_rig_covariance(path(), rig)); });
  }
  [[nodiscard]] std::filesystem::path path() const { return folder_.path() / "c.csv"; }

 private:
  testing::TemporaryFolder folder_;
};

TEST_F(RigCovarianceFile, IsReadAsItWasWritten) {
  RigCovariance written{rig_parameter_names(pinhole_rig()), {}};
  const auto count = static_cast<Eigen::Index>(written.parameters.size());
  ASSERT_EQ(count, 24);
  const Eigen::MatrixXd root = Eigen::MatrixXd::Random(count, count);
  written.covariance = root * root.transpose();
  write_rig_covariance(path(), written);
  const RigCovariance back = read_rig_covariance(path(), pinhole_rig());
  EXPECT_EQ(back.parameters, written.parameters);
  EXPECT_LT((back.covariance - written.covariance).norm(), 1e-7 * written.covariance.norm());
  const Eigen::MatrixXd factor = covariance_factor(back);
  EXPECT_LT((factor * factor.transpose() - back.covariance).norm(), 1e-9 * back.covariance.norm());
}

TEST_F(RigCovarianceFile, MayHoldAParameterWithoutUncertainty) {
  EXPECT_EQ(
      error_of("parameter,camera.k1,projector.x_mm\r\ncamera.k1,0,0\r\nprojector.x_mm,0,4\r\n"),
      "");
  EXPECT_EQ(covariance_factor(read_rig_covariance(path(), pinhole_rig())).cols(), 1);
}

TEST_F(RigCovarianceFile, ThatDoesNotFitIsAnErrorThatNamesTheFault) {
  const std::string head = "parameter,camera.k1,projector.x_mm\n";
  const std::vector<std::pair<std::string, std::string>> faults{
      {"", "first line"},
      {"parameter\n", "first line"},
      {"name,camera.k1\ncamera.k1,1\n", "first line"},
      {"parameter,camera.k9\ncamera.k9,1\n", "'camera.k9' is not a parameter of this rig"},
      {"parameter,camera.k1,camera.k1\n", "camera.k1 appears twice"},
      {head + "camera.k1,1,0\n", "the row of projector.x_mm is missing"},
      {head + "projector.x_mm,1,0\ncamera.k1,0,1\n", "'projector.x_mm' stands where"},
      {head + "camera.k1,1\nprojector.x_mm,0,1\n", "camera.k1 has 1 values instead of 2"},
      {head + "camera.k1,1,0\nprojector.x_mm,0,1\nmore,0,0\n", "more than 2 rows"},
      {head + "camera.k1,1,nan\nprojector.x_mm,nan,1\n", "'nan' in the row of camera.k1"},
      {head + "camera.k1,1,inf\nprojector.x_mm,inf,1\n", "not a finite number"},
      {head + "camera.k1,1,0.1x\nprojector.x_mm,0.1,1\n", "'0.1x'"},
      {head + "camera.k1,1,0.5\nprojector.x_mm,0.4,1\n", "not symmetric"},
      {head + "camera.k1,-1,0\nprojector.x_mm,0,1\n", "the variance of camera.k1 is -1"},
      {head + "camera.k1,0,0.1\nprojector.x_mm,0.1,1\n", "camera.k1 has no variance"},
      {head + "camera.k1,1,2\nprojector.x_mm,2,1\n", "not positive semidefinite"}};
  for (const auto& [text, fault] : faults) {
    const std::string message = error_of(text);
    EXPECT_NE(message.find(fault), std::string::npos) << message;
    EXPECT_NE(message.find("c.csv"), std::string::npos) << message;
  }
  const std::string angular =
      error_of("parameter,projector.k1\nprojector.k1,1\n", make_paper_rig({}));
  EXPECT_NE(angular.find("'projector.k1' is not a parameter"), std::string::npos) << angular;
}

TEST(ChangeParameters, MovesEachParameterAsTheCovarianceDefinesIt) {
  const Rig rig = pinhole_rig();
  const auto& before = std::get<PinholeModel>(rig.projector.model);
  const Rig changed = change_parameters(
      rig,
      {"projector.focal_px", "camera.focal_ratio", "camera.p1", "projector.principal_y_px"},
      Eigen::Vector4d(10.0, 0.01, 1e-3, -2.0));
  const auto& after = std::get<PinholeModel>(changed.projector.model);
  EXPECT_DOUBLE_EQ(after.focal_px.x(), 2010.0);
  EXPECT_DOUBLE_EQ(after.focal_px.y() / after.focal_px.x(), before.focal_px.y() / 2000.0);
  EXPECT_DOUBLE_EQ(after.principal_point_px.y(), 788.0);
  EXPECT_NEAR(changed.reference().model.focal_px.y() - rig.reference().model.focal_px.y(),
              0.01 * rig.reference().model.focal_px.x(),
              1e-9);
  EXPECT_DOUBLE_EQ(changed.reference().model.distortion[2], 1e-3);
}

TEST(ChangeParameters, ChangesATermOfTheWavefront) {
  Rig rig = make_paper_rig({});
  std::get<AngularModel>(rig.projector.model).wavefront.coefficients_rad[1] = 1e-4;
  const std::vector<std::string> names = rig_parameter_names(rig);
  ASSERT_EQ(names.back(), "projector.wavefront_vvv_rad");
  const Rig changed = change_parameters(
      rig, {"projector.wavefront_vv_rad", names.back()}, Eigen::Vector2d(2e-4, -1e-5));
  const auto& after = std::get<AngularModel>(changed.projector.model).wavefront;
  EXPECT_DOUBLE_EQ(after.coefficients_rad[1], 3e-4);
  EXPECT_DOUBLE_EQ(after.coefficients_rad[5], -1e-5);
}

TEST(ChangeParameters, TurnsAndShiftsTheProjectorInOpenCvsConvention) {
  const Rig rig = pinhole_rig();
  const Eigen::AngleAxisd turn(rig.projector.rotation);
  const Eigen::Vector3d translation = -(rig.projector.rotation * rig.projector.position_mm);
  const Rig changed = change_parameters(
      rig, {"projector.rotation_y_rad", "projector.z_mm"}, Eigen::Vector2d(0.01, 3.0));
  const Eigen::Vector3d vector = turn.angle() * turn.axis() + Eigen::Vector3d(0.0, 0.01, 0.0);
  const Eigen::Vector3d point(10.0, -20.0, 480.0);
  const Eigen::Vector3d expected = Eigen::AngleAxisd(vector.norm(), vector.normalized()) * point +
                                   translation + Eigen::Vector3d(0.0, 0.0, 3.0);
  EXPECT_LT((changed.projector.from_rig(point) - expected).norm(), 1e-9);
}

}  // namespace
}  // namespace frangia
