#include "frangia/registration/register_poses.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "frangia/core/error.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/registration/internal/free_pose_bundle.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

using testing::around_table;
using testing::lumpy;
using testing::small_camera_model;

/// Views of a part, all but the first displaced by a millimetre and half a degree.
struct DisplacedViews {
  CameraModel camera = small_camera_model(200, 1000.0);
  std::vector<Eigen::Isometry3d> truth;
  ViewStore views;

  explicit DisplacedViews(int count = 5)
      : truth(around_table(count, 0.4, 650.0)), views(testing::snapshots(lumpy, camera, truth)) {
    for (std::size_t i = 1; i < truth.size(); ++i) {
      const Eigen::Vector3d way(
          std::cos(2.0 * static_cast<double>(i)), std::sin(2.0 * static_cast<double>(i)), 0.3);
      Eigen::Isometry3d by = Eigen::Isometry3d::Identity();
      by.linear() = Eigen::AngleAxisd(0.009, way.normalized()).toRotationMatrix();
      by.translation() = way;
      views.set_rig_from_object(i, truth[i] * by);
    }
  }
  PosesReport refine(const RegisterPosesOptions& options = {}, const Run& run = {}) {
    return register_poses(views, make_surfel_maps(views, camera, 40000), camera, options, run);
  }
  [[nodiscard]] double farthest_mm() const {
    double farthest = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const Eigen::Isometry3d off = truth[i].inverse() * views.rig_from_object(i);
      farthest = std::max(farthest, off.translation().norm());
    }
    return farthest;
  }
};

TEST(RegisterPoses, FindsDisplacedPoses) {
  DisplacedViews displaced;
  const PosesReport report = displaced.refine();
  EXPECT_LT(displaced.farthest_mm(), 0.02);
  EXPECT_GT(report.rms_before_mm, 0.2);
  EXPECT_LT(report.rms_after_mm, 0.035);  // of two points with 0.02 mm each
  EXPECT_GT(report.overlap, 0.5);
}

TEST(RegisterPoses, FindsDisplacedPosesOfManyViews) {
  DisplacedViews displaced(30);  // more than are compared with each other
  const PosesReport report = displaced.refine();
  EXPECT_LT(displaced.farthest_mm(), 0.03);
  EXPECT_LT(report.rms_after_mm, 0.035);
  EXPECT_GT(report.overlap, 0.5);
}

/// How far the corners of a cube of 60 mm are moved by the change of a pose.
double moved_mm(const Eigen::Isometry3d& before, const Eigen::Isometry3d& after) {
  double farthest = 0.0;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner(i % 2 * 60 - 30, i / 2 % 2 * 60 - 30, i / 4 * 60 - 30);
    farthest = std::max(farthest, (before.inverse() * (after * corner) - corner).norm());
  }
  return farthest;
}

TEST(RegisterPoses, RestsOnGivenPosesWhereTheSurfacesSlide) {
  // Views of one flat face: they slide on each other both ways, and turn.
  const CameraModel camera = small_camera_model(120, 600.0);
  std::vector<Eigen::Isometry3d> truth;
  for (int i = 0; i < 4; ++i)
    truth.push_back(testing::look_from(1.5 * i, 1.1, 650.0));
  constexpr double kNoise_mm = 0.05;
  ViewStore views = testing::snapshots(
      testing::floor_at(0.0), camera, truth, {.noise_mm = kNoise_mm, .sigma_mm = kNoise_mm});
  const auto maps = make_surfel_maps(views, camera, 40000);
  EXPECT_GT(register_poses(views, maps, camera).iterations, 0);
  for (std::size_t i = 1; i < truth.size(); ++i)
    EXPECT_LT(moved_mm(truth[i], views.rig_from_object(i)), 0.02) << i;
}

/// Views of the sides of a box, of which some share one face only, so that the box may be longer.
struct SidesOfBox {
  CameraModel camera = small_camera_model(200, 1000.0);
  ViewStore views;

  explicit SidesOfBox(double off_mm) {
    std::vector<Eigen::Isometry3d> truth = around_table(8, 0.4, 650.0);
    views = testing::snapshots(testing::box({25.0, 25.0, 25.0}), camera, truth);
    for (std::size_t i = 1; i < truth.size(); ++i) {
      const auto at = static_cast<double>(i);
      const Eigen::Vector3d way(std::cos(2.0 * at), std::sin(2.0 * at), std::cos(3.0 * at));
      views.set_rig_from_object(i, truth[i] * Eigen::Translation3d(off_mm * way));
    }
  }
  PosesReport refine(const RegisterPosesOptions& options = {}) {
    return register_poses(views, make_surfel_maps(views, camera, 40000), camera, options);
  }
};

/// The largest motion of a view by what is left open.
double open_mm(const PosesReport& report) {
  double most = 0.0;
  for (const auto& motion : report.motions)
    most = std::max(most, motion.bottomRows<3>().norm());
  return most;
}

TEST(RegisterPoses, LeavesOpenByWhatGivenPosesAreOffWhereTheSurfacesShowIt) {
  const PosesReport found = SidesOfBox(0.3).refine();
  EXPECT_GT(found.given_sigma_mm, 0.15);
  EXPECT_LT(found.given_sigma_mm, 0.6);
  EXPECT_LT(open_mm(found), 1.5);
  // Poses that surfaces laid, or whose deviation is stated, say nothing of what slides.
  const PosesReport laid = SidesOfBox(0.0).refine();
  EXPECT_GT(laid.given_sigma_mm, 1.5);
  RegisterPosesOptions stated;
  stated.prior_mm = 2.0;
  EXPECT_EQ(SidesOfBox(0.3).refine(stated).given_sigma_mm, 2.0);
}

TEST(RegisterPoses, ReportsTheResidualAfterTheLastStep) {
  DisplacedViews displaced;
  RegisterPosesOptions one_step;
  one_step.max_iterations = 1;
  const PosesReport report = displaced.refine(one_step);
  EXPECT_EQ(report.iterations, 1);
  EXPECT_LT(report.rms_after_mm,
            0.7 * report.rms_before_mm);  // was equal: measured before the step
}

TEST(RegisterPoses, KeepsPosesThatDoNotOverlap) {
  DisplacedViews displaced;
  for (std::size_t i = 1; i < 5; ++i) {
    Eigen::Isometry3d away = displaced.truth[i];
    away.translation().z() += 100.0 * static_cast<double>(i);
    displaced.views.set_rig_from_object(i, away);
  }
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  const Eigen::Matrix4d before = displaced.views.rig_from_object(2).matrix();
  EXPECT_EQ(displaced.refine({}, run).iterations, 0);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("do not overlap"), std::string::npos) << warnings[0];
  EXPECT_EQ(displaced.views.rig_from_object(2).matrix(), before);
}

TEST(RegisterPoses, GivesTheSameForAnyNumberOfThreads) {
  const auto refine = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    DisplacedViews displaced;
    static_cast<void>(displaced.refine());
    return displaced.views.rig_from_object(3).matrix();
  };
  EXPECT_EQ(refine(1), refine(2));
}

TEST(RegisterPoses, RefusesMapsOfOtherViewsAndOptionsOutOfRange) {
  DisplacedViews displaced;
  EXPECT_THROW(static_cast<void>(register_poses(displaced.views, {}, displaced.camera)), Error);
  RegisterPosesOptions options;
  options.max_iterations = 0;
  EXPECT_THROW(static_cast<void>(displaced.refine(options)), Error);
}

TEST(DefaultReach, IsThreePercentOfTheSizeOfAView) {
  SurfelMap map;
  map.surfels = Image<SurfelMap::Surfel>(2, 1);
  map.surfels(0, 0) = {{0.0F, 0.0F, 500.0F}, -Eigen::Vector3f::UnitZ(), 0.01F};
  map.surfels(1, 0) = {{60.0F, 80.0F, 500.0F}, -Eigen::Vector3f::UnitZ(), 0.01F};
  EXPECT_NEAR(default_reach_mm(std::vector<SurfelMap>{map}), 3.0, 1e-6);
  EXPECT_EQ(default_reach_mm({}), 0.0);
}

TEST(FreePoseBundle, HasTheDerivativesOfCentralDifferences) {
  const Eigen::Vector3d normal = Eigen::Vector3d(0.3, -0.5, 0.8).normalized();
  const Eigen::Vector3d point(12.0, -30.0, 49.0);
  const Eigen::Matrix<double, 6, 1> row = point_to_plane_jacobian(normal, point);
  for (Eigen::Index i = 0; i < 6; ++i) {
    constexpr double kStep = 1e-5;
    const auto residual = [&](double step) {
      // The world moves under a held view by the inverse of what the pose of the view does.
      FreePoseBundle bundle{{},
                            {},
                            {Eigen::Isometry3d::Identity(), Eigen::Isometry3d::Identity()},
                            FastCameraModel(small_camera_model())};
      apply_update(bundle, step * Eigen::VectorXd::Unit(6, i));
      return normal.dot(bundle.rig_from_world[1].inverse() * point);
    };
    EXPECT_NEAR(row[i], (residual(kStep) - residual(-kStep)) / (2.0 * kStep), 1e-6) << i;
  }
}

}  // namespace
}  // namespace frangia
