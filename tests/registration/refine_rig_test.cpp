#include "frangia/registration/refine_rig.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/registration/internal/drift_field.h"
#include "frangia/registration/internal/drift_model.h"
#include "frangia/registration/internal/known_length.h"
#include "frangia/registration/internal/view_transfer.h"

#include "support/error_of.h"
#include "support/misaligned_table.h"

namespace frangia {
namespace {

using testing::knobbly;
using testing::Shape;
using testing::small_camera_model;
using testing::sphere;

const Pattern kColumns{.name = "columns", .period_px = 20.0};
const Pattern kRows{.name = "rows", .direction = FringeDirection::Horizontal, .period_px = 20.0};

/// A rig of any size: projector left of the camera, both look at the turntable.
Rig true_rig(double scale = 1.0) {
  Rig rig;
  rig.reference().model = small_camera_model(160, 800.0);
  rig.projector.model = PinholeModel{.width_px = 1280,
                                     .height_px = 800,
                                     .focal_px = {1900.0, 1900.0},
                                     .principal_point_px = {639.5, 399.5}};
  rig.projector.position_mm = scale * Eigen::Vector3d(-220.0, -25.0, 20.0);
  const Eigen::Vector3d target = scale * Eigen::Vector3d(0.0, 0.0, 650.0);
  const Eigen::Vector3d forward = (target - rig.projector.position_mm).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(forward).normalized();
  rig.projector.rotation << right.transpose(), forward.cross(right).transpose(),
      forward.transpose();
  rig.turntable = Turntable{scale * Eigen::Vector3d(2.0, 8.0, 650.0),
                            Eigen::Vector3d(0.03, -0.9, -0.4).normalized()};
  return rig;
}

/// The projector turned by 0.1 degrees and moved by 0.5 mm.
Rig drifted(Rig rig, double scale = 1.0) {
  const Eigen::Vector3d axis = Eigen::Vector3d(0.6, 1.0, -0.4).normalized();
  rig.projector.rotation =
      Eigen::AngleAxisd(rad_from_deg(0.1), axis).toRotationMatrix() * rig.projector.rotation;
  rig.projector.position_mm += 0.5 * scale * Eigen::Vector3d(0.3, -0.5, 0.8).normalized();
  return rig;
}

/// What the rig of unit scale sees of a shape.
ViewStore views_of(const Shape& shape, int count) {
  const Rig unit = true_rig();
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < count; ++i)
    poses.push_back(unit.rig_from_object(kTwoPi * i / count));
  return testing::snapshots(
      shape, unit.reference().model, poses, {.noise_mm = 0.01, .sigma_mm = 0.01});
}

/// Six views of the knobbly part, rendered once for all tests.
const ViewStore& knobbly_views() {
  static const ViewStore kViews = views_of(knobbly, 6);
  return kViews;
}

/// The same views in another unit of length.
ViewStore scaled(const ViewStore& views, double scale) {
  ViewStore out;
  for (std::size_t i = 0; i < views.size(); ++i) {
    View view = views.load(i);
    for (Image<float>* image : {&view.range.depth_mm, &view.range.sigma_mm}) {
      for (float& value : image->pixels())
        value *= static_cast<float>(scale);
    }
    out.add(view);
  }
  return out;
}

std::vector<Station> stations_of(int count, double noise_rad = 0.0) {
  std::mt19937 generator(7);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<Station> stations;
  for (int i = 0; i < count; ++i)
    stations.push_back({kTwoPi * i / count + (i == 0 ? 0.0 : noise_rad * noise(generator)), ""});
  return stations;
}

std::vector<std::size_t> counted(int count) {
  std::vector<std::size_t> numbers;
  for (int i = 0; i < count; ++i)
    numbers.push_back(static_cast<std::size_t>(i));
  return numbers;
}

/// Shape error of a view that a rig triangulates: RMS distance from the true points after the
/// similarity that fits best, as a share of the true distance.
struct ShapeError {
  double shape = 0.0;
  double scale = 1.0;  ///< true size over measured size
};

ShapeError shape_error(const ViewStore& truth, const Rig& true_one, const Rig& rig) {
  const View right = truth.load(0);
  const ViewStore other = retriangulate_views(truth, kColumns, true_one, rig);
  const View wrong = other.load(0);
  const auto rays = rays_of(true_one.reference().model);
  const auto rays_other = rays_of(rig.reference().model);
  std::vector<Eigen::Vector3d> from;
  std::vector<Eigen::Vector3d> to;
  for (int y = 0; y < rays.height(); y += 3) {
    for (int x = 0; x < rays.width(); x += 3) {
      const double depth = static_cast<double>(right.range.depth_mm(x, y));
      const double found = static_cast<double>(wrong.range.depth_mm(x, y));
      if (std::isnan(depth) || std::isnan(found)) continue;
      from.emplace_back(found * rays_other(x, y).cast<double>().homogeneous());
      to.emplace_back(depth * rays(x, y).cast<double>().homogeneous());
    }
  }
  Eigen::Matrix3Xd a(3, from.size());
  Eigen::Matrix3Xd b(3, to.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    a.col(static_cast<Eigen::Index>(i)) = from[i];
    b.col(static_cast<Eigen::Index>(i)) = to[i];
  }
  const Eigen::Matrix4d motion = Eigen::umeyama(a, b, true);
  const Eigen::Matrix3Xd moved =
      (motion.topLeftCorner<3, 3>() * a).colwise() + motion.topRightCorner<3, 1>();
  return {std::sqrt((moved - b).colwise().squaredNorm().mean()) / b.colwise().norm().mean(),
          motion.topLeftCorner<3, 1>().norm()};
}

struct Refined {
  RigRefinement result;
  double error_before = 0.0;
  double error_after = 0.0;
  double scale_before = 1.0;
  double scale_after = 1.0;
};

/// Refines a rig of which the projector moved, by what the true rig of a scale saw.
Refined refine(const ViewStore& seen, double scale, const RefineRigOptions& options = {}) {
  const Rig truth = true_rig(scale);
  const Rig given = drifted(truth, scale);
  const int count = static_cast<int>(seen.size());
  const ViewStore views = retriangulate_views(seen, kColumns, truth, given);
  const std::vector<RigSurfaces> surfaces{{views, kColumns, counted(count)}};
  Refined out;
  out.result = refine_rig(given, surfaces, stations_of(count, rad_from_deg(0.05)), options);
  const ShapeError before = shape_error(seen, truth, given);
  const ShapeError after = shape_error(seen, truth, out.result.rig);
  out.error_before = before.shape;
  out.error_after = after.shape;
  out.scale_before = before.scale;
  out.scale_after = after.scale;
  return out;
}

/// The tests run in one process, and share the views and a refinement.
class RefineRig : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { static_cast<void>(knobbly_views()); }
  static const Refined& of_unit_size() {
    static const Refined kFound = refine(knobbly_views(), 1.0);
    return kFound;
  }
};

TEST_F(RefineRig, FindsTheDriftOfAProjectorFromOverlappingViews) {
  const Refined& found = of_unit_size();
  EXPECT_FALSE(found.result.kept_rig) << found.result.text();
  EXPECT_LT(found.error_after, 0.35 * found.error_before) << found.error_before;
  EXPECT_GT(found.result.held, 0U);  // the scale at least
  EXPECT_GT(found.result.rms_before_mm, 1.1 * found.result.rms_after_mm);
  ASSERT_TRUE(found.result.rig.calibration);
  EXPECT_FALSE(found.result.rig.calibration->covariance.empty());
}

/// The refinement of a rig that is stated wrongly, by the views of the knobbly part.
RigRefinement refine_stated(const Rig& given) {
  const Rig truth = true_rig();
  constexpr int kViews = 6;
  const ViewStore views = retriangulate_views(knobbly_views(), kColumns, truth, given);
  const std::vector<RigSurfaces> surfaces{{views, kColumns, counted(kViews)}};
  return refine_rig(given, surfaces, stations_of(kViews, rad_from_deg(0.05)));
}

TEST_F(RefineRig, FindsTheDistortionOfALens) {
  Rig given = true_rig();
  constexpr double kWrong = 0.6;  // by half a pixel at the ends of a row
  given.reference().model.distortion[0] = kWrong;
  const RigRefinement found = refine_stated(given);
  EXPECT_FALSE(found.kept_rig) << found.text();
  EXPECT_LT(found.rms_after_mm, 0.6 * found.rms_before_mm);
  const auto k1 = std::find_if(found.parameters.begin(), found.parameters.end(), [](const auto& p) {
    return p.name == "camera.k1";
  });
  ASSERT_NE(k1, found.parameters.end());
  // The part covers the middle of the image, where other changes resemble it.
  EXPECT_NEAR(k1->change, -kWrong, 0.3 * kWrong);
  // Of independent noise alone it would be 8 sigmas: the views share errors.
  EXPECT_LT(std::abs(k1->change + kWrong), 5.0 * k1->sigma) << k1->change << " +- " << k1->sigma;
}

TEST_F(RefineRig, StatesHowFarARigIsOpenThatChangedMoreThanExpected) {
  Rig given = true_rig();
  auto& projector = std::get<PinholeModel>(given.projector.model);
  projector.focal_px *= 1.006;  // 20 standard deviations
  const RigRefinement found = refine_stated(given);
  EXPECT_EQ(std::count(found.beyond_prior.begin(), found.beyond_prior.end(), "projector.focal_px"),
            1)
      << found.text();
  for (const RefinedParameter& parameter : found.parameters) {
    const double truth =
        parameter.name == "projector.focal_px" ? 1900.0 - projector.focal_px.x() : 0.0;
    EXPECT_LT(std::abs(parameter.change - truth), 3.0 * parameter.sigma) << parameter.name;
  }
}

TEST_F(RefineRig, HoldsTheScaleThoughTheProjectorMayBeFarFromWhereItIsStated) {
  Rig given = true_rig();
  CameraModel& camera = given.reference().model;
  camera.focal_px *= 1.005;  // 17 standard deviations
  const RigRefinement found = refine_stated(given);
  for (const RefinedParameter& parameter : found.parameters) {
    const double truth = parameter.name == "camera.focal_px" ? 800.0 - camera.focal_px.x() : 0.0;
    EXPECT_LT(std::abs(parameter.change - truth), 3.0 * parameter.sigma) << parameter.name;
  }
}

TEST_F(RefineRig, BehavesAlikeForARigOfTenTimesTheSize) {
  const Refined& one = of_unit_size();
  const Refined ten = refine(scaled(knobbly_views(), 10.0), 10.0);
  EXPECT_NEAR(ten.error_after, one.error_after, 0.1 * one.error_before);
  EXPECT_EQ(ten.result.held, one.result.held);
}

TEST_F(RefineRig, KeepsAnExactRig) {
  const Rig rig = true_rig();
  const std::vector<RigSurfaces> surfaces{{knobbly_views(), kColumns, counted(6)}};
  const RigRefinement result = refine_rig(rig, surfaces, stations_of(6));
  EXPECT_TRUE(result.kept_rig) << result.text();
  EXPECT_EQ(result.rig.projector.position_mm, rig.projector.position_mm);
  EXPECT_FALSE(result.rig.calibration);
}

TEST_F(RefineRig, IsNotWorseWithAPartThatIsRoundAboutTheAxis) {
  const Refined found = refine(views_of(sphere(38.0), 6), 1.0);
  EXPECT_LE(found.error_after, 1.05 * found.error_before);
  EXPECT_GT(found.result.held, 4U) << found.result.text();
}

TEST_F(RefineRig, TakesTheScaleFromTheBallsOfABallBar) {
  const Shape bar = testing::both(
      testing::both(sphere(14.0, {0.0, -22.0, 12.0}), sphere(14.0, {0.0, 22.0, 12.0})),
      testing::box({8.0, 40.0, 4.0}, {0.0, 0.0, -20.0}));
  RefineRigOptions options;
  options.ball_distance_mm = 44.0;
  const Refined found = refine(views_of(bar, 6), 1.0, options);
  EXPECT_GT(std::abs(found.scale_before - 1.0), 1e-3);
  EXPECT_NEAR(found.scale_after, 1.0, 4e-4);
  EXPECT_LT(found.error_after, 0.5 * found.error_before);
  options.ball_distance_mm = 60.0;
  EXPECT_NE(testing::error_of([&] {
              static_cast<void>(refine(views_of(bar, 3), 1.0, options));
            }).find("the two balls are 4"),
            std::string::npos);
}

TEST_F(RefineRig, FindsTheProjectorOfOneViewFromBothDirectionsOfFringes) {
  Rig truth = true_rig();
  truth.turntable.reset();
  const Rig given = drifted(truth);
  const ViewStore seen = views_of(knobbly, 1);
  const ViewStore columns = retriangulate_views(seen, kColumns, truth, given);
  const ViewStore rows = retriangulate_views(seen, kRows, truth, given);
  const std::vector<RigSurfaces> surfaces{{columns, kColumns, {0}}, {rows, kRows, {0}}};
  const RigRefinement result = refine_rig(given, surfaces, stations_of(1));
  EXPECT_FALSE(result.kept_rig) << result.text();
  EXPECT_FALSE(result.rig.turntable);
  EXPECT_LT(result.rms_after_mm, 0.2 * result.rms_before_mm) << result.text();
}

TEST_F(RefineRig, NamesWhatIsMissingWhenNothingCanBeCompared) {
  Rig rig = true_rig();
  const ViewStore views = views_of(knobbly, 1);
  const std::vector<RigSurfaces> surfaces{{views, kColumns, {0}}};
  EXPECT_NE(testing::error_of([&] {
              static_cast<void>(refine_rig(rig, surfaces, stations_of(1)));
            }).find("both directions"),
            std::string::npos);
}

TEST(PointDrift, IsTheMotionOfATriangulatedPoint) {
  const Rig rig = true_rig();
  const DriftModel model(rig, {}, 650.0);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(model.count());
  const PointDrift drift(model, none);
  const ViewStore views = views_of(knobbly, 1);
  const auto rays = rays_of(rig.reference().model);
  const View view = views.load(0);
  const int x = 80;
  const int y = 78;
  const Eigen::Vector3d point =
      static_cast<double>(view.range.depth_mm(x, y)) * rays(x, y).cast<double>().homogeneous();
  constexpr double kStep = 0.3;
  const PointDrift::Derivative by = drift.of(point, kColumns);
  for (Eigen::Index i = 0; i < model.count(); ++i) {
    Eigen::VectorXd w = none;
    w[i] = kStep;
    const Rig changed = model.rig_at(w);
    const View moved = retriangulate_views(views, kColumns, rig, changed).load(0);
    const Eigen::Vector3d there =
        static_cast<double>(moved.range.depth_mm(x, y)) *
        rays_of(changed.reference().model)(x, y).cast<double>().homogeneous();
    // Second order and rounding of single-precision depths.
    EXPECT_LT((there - point - kStep * by.col(i).cast<double>()).norm(),
              0.01 * kStep * by.col(i).norm() + 2e-4)
        << model.parameters()[static_cast<std::size_t>(i)];
  }
}

TEST(DriftField, IsTheMotionOfThePointsOfAView) {
  const Rig rig = true_rig();
  const DriftModel model(rig, {}, 650.0);
  const PointDrift drift(model, Eigen::VectorXd::Zero(model.count()));
  const auto maps = make_surfel_maps(views_of(knobbly, 1), rig.reference().model, 3000);
  const std::vector<SurfelMap::Surfel> surfels = pick_surfels(maps.front(), 1000);
  const DriftField field(drift, kColumns, surfels);
  for (const SurfelMap::Surfel& surfel : surfels) {
    const Eigen::Vector3d point = surfel.point_mm.cast<double>();
    const PointDrift::Derivative by = drift.of(point, kColumns);
    ASSERT_LT((field.of(point) - by).norm(), 1e-3F * by.norm());
  }
  const Eigen::Vector3d point(0.0, 0.0, 650.0);
  EXPECT_EQ(DriftField(drift, kColumns, {}).of(point),
            PointDrift::Derivative::Zero(3, model.count()));
}

TEST(DriftModel, AddsNothingToACovarianceThatIsNotMeasured) {
  const Rig rig = true_rig();
  const DriftModel model(rig, {}, 650.0);
  const Eigen::MatrixXd prior = model.factor() * model.factor().transpose();
  const RigCovariance same = model.updated(Eigen::MatrixXd::Zero(model.count(), model.count()));
  EXPECT_EQ(same.parameters.size(), model.parameters().size());
  EXPECT_NEAR(same.covariance.trace(), prior.trace(), 1e-9 * prior.trace());
  // A measurement as good as the prior halves the variances.
  const RigCovariance half = model.updated(Eigen::MatrixXd::Identity(model.count(), model.count()));
  EXPECT_NEAR(half.covariance.trace(), 0.5 * prior.trace(), 1e-9 * prior.trace());
}

TEST_F(RefineRig, ScalesFurtherCamerasWithTheRig) {
  Rig rig = true_rig();
  rig.cameras.emplace_back();
  rig.cameras[1].position_mm = {100.0, -20.0, 5.0};
  const double distance_mm = (rig.cameras[1].position_mm - rig.projector.position_mm).norm();
  scale_rig(rig, 1.01);
  EXPECT_NEAR(
      (rig.cameras[1].position_mm - rig.projector.position_mm).norm(), 1.01 * distance_mm, 1e-9);
}

}  // namespace
}  // namespace frangia
