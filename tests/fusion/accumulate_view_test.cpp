#include "frangia/fusion/internal/accumulate_view.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

using testing::look_from;
using testing::small_camera_model;

constexpr std::int8_t kUp = 3;  // the edge along z, whose upper end is outside
constexpr float kWeight = 400.0F;

/// A floor at z = 0 seen from a latitude, without noise, and points that it is sampled at.
struct FloorSeenObliquely {
  explicit FloorSeenObliquely(double latitude_rad = 0.9)
      : view(testing::snapshot(testing::floor_at(0.0),
                               camera.model,
                               look_from(0.4, latitude_rad, 650.0),
                               {.noise_mm = 0.0})),
        planes(local_planes(view, camera)) {
    for (LocalPlanes::Quad& quad : planes.quads.pixels())
      quad.weight = kWeight;
    for (LocalPlanes::Plane& plane : planes.planes.pixels())
      if (plane.weight > 0.0F) plane.weight = kWeight;
  }

  std::size_t add(const Eigen::Vector3f& point_mm, std::int8_t outward = kUp) {
    crossings.points_mm.push_back(point_mm);
    crossings.outward.push_back(outward);
    return crossings.points_mm.size() - 1;
  }

  [[nodiscard]] HermiteAccumulators sums(const Image<float>& systematic_mm = {},
                                         const Image<float>& differing_mm = {}) const {
    HermiteAccumulators hermite(crossings.points_mm.size(), !systematic_mm.empty());
    accumulate_view(hermite, crossings, planes, camera, options, {systematic_mm, differing_mm});
    return hermite;
  }

  /// A point in the frame of the camera.
  [[nodiscard]] Eigen::Vector3d seen(std::size_t i) const {
    return view.rig_from_object * crossings.points_mm[i].cast<double>();
  }
  /// Cosine of the incidence of the ray through a point of the floor.
  [[nodiscard]] double cosine(std::size_t i) const {
    return -(view.rig_from_object.linear() * Eigen::Vector3d::UnitZ()).dot(seen(i).normalized());
  }

  CameraRays camera{small_camera_model(160)};
  View view;
  LocalPlanes planes;
  EdgeCrossings crossings;
  HermiteOptions options{.near_mm = 1.0, .free_space_mm = 4.0, .parameters = {}};
};

TEST(AccumulateView, SumsTheDistanceWithItsVariances) {
  FloorSeenObliquely floor;
  // More than two batches of 64, so that each is projected.
  for (int i = 0; i < 150; ++i)
    floor.add({0.1F * static_cast<float>(i - 75),
               0.05F * static_cast<float>(i),
               0.004F * static_cast<float>(i - 75)});
  const HermiteAccumulators hermite = floor.sums();
  for (std::size_t i = 0; i < hermite.size(); ++i) {
    const HermiteAccumulator::PlaneSum& face = hermite[i].first;
    const double height = static_cast<double>(floor.crossings.points_mm[i].z());
    const double weight = kWeight * std::pow(1.0 - height * height, 2);
    const double cosine = floor.cosine(i);
    const double pixel_mm = floor.seen(i).z() / 1500.0;
    const double noise = 0.73 * std::pow(cosine, 4) / kWeight;
    const double lateral_mm = 0.01 * pixel_mm * std::sqrt(1.0 - cosine * cosine);
    ASSERT_EQ(face.views, 1) << i;
    EXPECT_NEAR(face.offset / face.weight, height, 2e-3);
    EXPECT_NEAR(face.weight / weight, 1.0, 2e-3);
    EXPECT_NEAR(face.weight_squared / (weight * weight), 1.0, 4e-3);
    EXPECT_NEAR(face.offset_squared / face.weight, height * height, 2e-3);
    EXPECT_NEAR(face.noise / (weight * noise), 1.0, 3e-3);
    EXPECT_NEAR(face.noise_squared / (weight * weight * noise), 1.0, 5e-3);
    EXPECT_NEAR(face.lateral_squared / (weight * weight * lateral_mm * lateral_mm), 1.0, 5e-3);
    EXPECT_NEAR(face.spacing / (weight * pixel_mm / std::sqrt(cosine)), 1.0, 3e-3);
    EXPECT_NEAR((face.normal / face.weight - Eigen::Vector3f::UnitZ()).norm(), 0.0F, 1e-3F);
    EXPECT_EQ(hermite[i].free_space_weight, 0.0F);
    EXPECT_EQ(hermite.secondary(i).views, 0);
  }
}

TEST(AccumulateView, VotesForFreeSpaceFarInFrontOfTheSurfaceOnly) {
  FloorSeenObliquely floor;
  for (const float height : {-9.0F, -3.0F, -1.5F, 1.5F, 3.5F})
    floor.add({1.0F, 2.0F, height});
  const std::size_t free = floor.add({1.0F, 2.0F, 5.0F});
  const HermiteAccumulators hermite = floor.sums();
  for (std::size_t i = 0; i < free; ++i) {
    EXPECT_EQ(hermite[i].first.views, 0) << i;
    EXPECT_EQ(hermite[i].free_space_weight, 0.0F) << i;
  }
  // The cosine of the incidence where the ray through the point meets the floor, over that of the
  // ray and the axis: distance over depth.
  const Eigen::Vector3d p = floor.seen(free);
  const double cosine = floor.cosine(free) * p.norm() / p.z();
  EXPECT_NEAR(
      hermite[free].free_space_weight / (147.0 / 11.0 * kWeight / (cosine * cosine)), 1.0, 3e-3);
}

TEST(AccumulateView, VotesForNoFreeSpaceNextToAHigherSurface) {
  // A wall beside the point, four pixels away: the sight is not clear there.
  const CameraRays camera(small_camera_model(160));
  const auto scene = testing::both(testing::floor_at(0.0), testing::box({20.0, 20.0, 8.0}));
  const View view =
      testing::snapshot(scene, camera.model, look_from(0.0, 1.5, 650.0), {.noise_mm = 0.0});
  const LocalPlanes planes = local_planes(view, camera);
  EdgeCrossings crossings;
  const double pixel_mm = 650.0 / 1500.0;
  for (const double apart_px : {3.0, 8.0}) {
    crossings.points_mm.emplace_back(0.0F, static_cast<float>(20.0 + apart_px * pixel_mm), 7.0F);
    crossings.outward.push_back(kUp);
  }
  HermiteAccumulators hermite(2);
  const Image<float> none;
  accumulate_view(hermite,
                  crossings,
                  planes,
                  camera,
                  {.near_mm = 1.0, .free_space_mm = 4.0, .parameters = {}},
                  {none, none});
  EXPECT_EQ(hermite[0].free_space_weight, 0.0F);
  EXPECT_GT(hermite[1].free_space_weight, 0.0F);
}

TEST(AccumulateView, LeavesOutTheBackOfAThinWall) {
  FloorSeenObliquely floor;
  for (const int outward : {1, -1, 2, -2, 3, -3})
    floor.add({1.0F, 2.0F, 0.1F}, static_cast<std::int8_t>(outward));
  const HermiteAccumulators hermite = floor.sums();
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(hermite[i].first.views, 1) << i;
  EXPECT_EQ(hermite[5].first.views, 0) << "the normal points away from the outside";
}

TEST(AccumulateView, AddsToTheFaceWhoseNormalAgrees) {
  FloorSeenObliquely floor;
  const std::size_t at = floor.add({1.0F, 2.0F, 0.1F});
  const auto faces_after = [&](double tilt_deg) {
    HermiteAccumulators hermite(1);
    HermiteAccumulator::PlaneSum& first = hermite[at].first;
    const double tilt = rad_from_deg(tilt_deg);
    first.weight = 2.0F;
    first.normal = 2.0F * Eigen::Vector3d(std::sin(tilt), 0.0, std::cos(tilt)).cast<float>();
    first.views = 1;
    const Image<float> none;
    accumulate_view(
        hermite, floor.crossings, floor.planes, floor.camera, floor.options, {none, none});
    return std::pair<int, int>(hermite[at].first.views, hermite.secondary(at).views);
  };
  EXPECT_EQ(faces_after(35.0), std::pair(2, 0));
  EXPECT_EQ(faces_after(39.0), std::pair(1, 1));
  EXPECT_EQ(faces_after(150.0), std::pair(1, 1));
}

TEST(AccumulateView, AddsToTheNearerOfTwoFaces) {
  FloorSeenObliquely floor;
  const std::size_t at = floor.add({1.0F, 2.0F, 0.1F});
  for (const double second_deg : {50.0, 70.0}) {
    HermiteAccumulators hermite(1);
    for (const double deg : {60.0, -second_deg}) {
      HermiteAccumulator::PlaneSum& face =
          deg > 0.0 ? hermite[at].first : hermite.make_secondary(at);
      face.normal = Eigen::Vector3d(std::sin(rad_from_deg(deg)), 0.0, std::cos(rad_from_deg(deg)))
                        .cast<float>();
      face.weight = 1.0F;
      face.views = 1;
    }
    const Image<float> none;
    accumulate_view(
        hermite, floor.crossings, floor.planes, floor.camera, floor.options, {none, none});
    EXPECT_EQ(hermite[at].first.views, second_deg < 60.0 ? 1 : 2);
    EXPECT_EQ(hermite.secondary(at).views, second_deg < 60.0 ? 2 : 1);
  }
}

TEST(AccumulateView, ProjectsBothSystematicPartsOntoTheNormal) {
  FloorSeenObliquely floor;
  const std::size_t at = floor.add({1.0F, 2.0F, 0.0F});
  const Image<float> all(160, 160, 0.5F);
  const Image<float> differing(160, 160, 0.3F);
  const auto cosine = static_cast<float>(floor.cosine(at));
  HermiteAccumulators alike = floor.sums(all);
  EXPECT_NEAR(alike.systematic_sums(at).first.common / (kWeight * cosine * 0.5F), 1.0F, 2e-3F);
  EXPECT_EQ(alike.systematic_sums(at).first.differing_squared, 0.0F);
  HermiteAccumulators both = floor.sums(all, differing);
  EXPECT_NEAR(both.systematic_sums(at).first.common / (kWeight * cosine * 0.4F), 1.0F, 2e-3F);
  EXPECT_NEAR(
      both.systematic_sums(at).first.differing_squared / std::pow(kWeight * cosine * 0.3F, 2),
      1.0F,
      4e-3F);
  EXPECT_EQ(both.systematic_sums(at).second.common, 0.0F);
}

TEST(AccumulateView, TakesTheSystematicPartOfTheNearestPixel) {
  FloorSeenObliquely floor;
  Image<float> columns(160, 160);
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x < 160; ++x)
      columns(x, y) = static_cast<float>(1 + x + 160 * y);
  }
  for (int i = 0; i < 20; ++i)
    floor.add({0.13F * static_cast<float>(i), 0.07F * static_cast<float>(i), 0.0F});
  HermiteAccumulators hermite = floor.sums(columns);
  for (std::size_t i = 0; i < hermite.size(); ++i) {
    const Eigen::Vector2d pixel = floor.camera.model.project(floor.seen(i));
    const auto wanted =
        static_cast<float>(1 + std::lround(pixel.x()) + 160 * std::lround(pixel.y()));
    const float found =
        hermite.systematic_sums(i).first.common / (kWeight * static_cast<float>(floor.cosine(i)));
    EXPECT_NEAR(found / wanted, 1.0F, 3e-3F) << pixel.transpose();
  }
}

/// The floor, cut off beyond a column of the image: the boundary of the data.
struct FloorWithBoundary : FloorSeenObliquely {
  explicit FloorWithBoundary(double latitude_rad = 0.9) : FloorSeenObliquely(latitude_rad) {
    for (int y = 0; y < 160; ++y) {
      for (int x = kLast + 1; x < 160; ++x)
        view.range.depth_mm(x, y) = view.range.sigma_mm(x, y) = kMissing;
    }
    planes = local_planes(view, camera);
    for (LocalPlanes::Quad& quad : planes.quads.pixels())
      quad.weight = kWeight;
    for (LocalPlanes::Plane& plane : planes.planes.pixels())
      if (plane.weight > 0.0F) plane.weight = kWeight;
  }
  /// The point of the floor at a place in the image.
  [[nodiscard]] Eigen::Vector3f at_pixel(double u, double v) const {
    const Eigen::Vector3d ray = camera.model.ray({u, v}).homogeneous();
    const Eigen::Isometry3d object = view.rig_from_object.inverse();
    const Eigen::Vector3d along = object.linear() * ray;
    return (object.translation() - object.translation().z() / along.z() * along).cast<float>();
  }
  static constexpr int kLast = 90;
};

TEST(AccumulateView, CountsATenthHalfAPixelBeyondTheBoundary) {
  FloorWithBoundary floor;
  const std::size_t inside = floor.add(floor.at_pixel(floor.kLast - 5.0, 80.3));
  const std::size_t at_boundary = floor.add(floor.at_pixel(floor.kLast - 0.4, 80.3));
  const std::size_t beyond = floor.add(floor.at_pixel(floor.kLast + 0.4, 80.3));
  const std::size_t far = floor.add(floor.at_pixel(floor.kLast + 0.6, 80.3));
  const HermiteAccumulators hermite = floor.sums();
  EXPECT_NEAR(hermite[inside].first.weight, kWeight, 0.01F * kWeight);
  EXPECT_NEAR(hermite[at_boundary].first.weight, kWeight, 0.01F * kWeight);
  EXPECT_NEAR(hermite[beyond].first.weight, 0.1F * kWeight, 0.001F * kWeight);
  EXPECT_EQ(hermite[far].first.views, 0);
  // The position of a point at the boundary is uncertain by 0.072 px instead of 0.01 px.
  const auto lateral = [&](std::size_t i) {
    return hermite[i].first.lateral_squared / hermite[i].first.weight_squared;
  };
  EXPECT_NEAR(lateral(at_boundary) / lateral(inside), 7.2F * 7.2F, 1.5F);
  EXPECT_NEAR(lateral(beyond) / lateral(inside), 7.2F * 7.2F, 1.5F);
}

TEST(AccumulateView, TakesASteepSlopeThatNoLargeWindowFitsForAStep) {
  for (const double latitude_deg : {45.0, 22.0}) {  // incidence of 45 and 68 degrees
    FloorSeenObliquely floor(rad_from_deg(latitude_deg));
    const std::size_t middle = floor.add({0.3F, -0.2F, 0.0F});
    const auto lateral = [&] {
      const HermiteAccumulators hermite = floor.sums();
      return hermite[middle].first.lateral_squared / hermite[middle].first.weight_squared;
    };
    const float usual = lateral();
    for (LocalPlanes::Plane& plane : floor.planes.planes.pixels())
      plane.window = WindowKind::Small;
    // Anywhere within a pixel instead of 0.01 px.
    const float ratio = latitude_deg < 30.0 ? 28.9F * 28.9F : 1.0F;
    EXPECT_NEAR(lateral() / usual, ratio, 0.01F * ratio) << latitude_deg;
  }
}

TEST(AccumulateView, ReachesBeyondTheBoundaryWhereTheIncidenceIsSmallEnough) {
  for (const double latitude_deg :
       {22.0, 12.0}) {  // incidence of 68 and 78 degrees; 72.5 is the limit
    FloorWithBoundary floor(rad_from_deg(latitude_deg));
    const std::size_t beyond = floor.add(floor.at_pixel(floor.kLast + 0.4, 80.3));
    const HermiteAccumulators hermite = floor.sums();
    EXPECT_EQ(hermite[beyond].first.views, latitude_deg > 17.5 ? 1 : 0) << latitude_deg;
  }
}

}  // namespace
}  // namespace frangia
