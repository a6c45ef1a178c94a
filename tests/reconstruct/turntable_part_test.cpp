// What an uncertain turntable means for the shape of a part, against the geometry of a plate.
#include "frangia/reconstruct/internal/turntable_part.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/registration/register_views.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

constexpr double kHalfPlate_mm = 4.0;

/// Both faces of a plate, seen from 0 and 180 degrees, each as a grid of vertices.
struct SeenPlate {
  CameraModel camera = testing::small_camera_model();
  Turntable table{{0.0, 0.0, 600.0}, -Eigen::Vector3d::UnitY()};
  std::vector<Station> stations{{0.0, ""}, {rad_from_deg(180.0), ""}};
  ViewStore views;
  FusedSurface fused;
  Mesh& mesh = fused.mesh;

  SeenPlate() {
    const testing::Shape shape = testing::box({kHalfPlate_mm, 30.0, 30.0});
    for (const Station& station : stations)
      views.add(testing::snapshot(shape, camera, table.rig_from_object(station.angle_rad)));
    const std::vector<CameraViews> cameras{CameraViews{views, camera}};
    fused.weights = fuse_with_weights(cameras).weights;
    for (const float side : {-1.0F, 1.0F}) {
      for (int y = -25; y <= 25; ++y) {
        for (int z = -25; z <= 25; ++z) {
          mesh.vertices_mm.emplace_back(side * static_cast<float>(kHalfPlate_mm),
                                        static_cast<float>(y),
                                        static_cast<float>(z));
          mesh.normals.emplace_back(side, 0.0F, 0.0F);
          mesh.sigma_mm.push_back(0.01F);
        }
      }
    }
  }
  bool add(const TurntableSigma& sigma) {
    return add_turntable_part(fused, motions_of_rig({table, stations}, sigma), {});
  }
};

TEST(TurntablePart, IsTheShiftOfTheAxisOnBothFacesOfAPlate) {
  // An axis that is off along the line of sight makes the plate twice that thicker or thinner; one
  // that is off across it moves the faces along themselves.
  SeenPlate plate;
  ASSERT_TRUE(plate.add({.point_mm = 0.5, .axis_rad = 0.0, .angle_rad = 0.0}));
  for (std::size_t i = 0; i < plate.mesh.vertices_mm.size(); ++i) {
    EXPECT_NEAR(plate.mesh.sigma_systematic_mm[i], 0.5, 0.02);
    EXPECT_FLOAT_EQ(plate.mesh.sigma_noise_mm[i], 0.01F);
    EXPECT_NEAR(plate.mesh.sigma_mm[i], std::hypot(plate.mesh.sigma_systematic_mm[i], 0.01), 1e-6);
  }
}

TEST(TurntablePart, GrowsWithTheHeightOfAPlateWhoseAxisIsTilted) {
  // Each face is turned about the point of the axis towards the camera: both tops lean outwards.
  SeenPlate plate;
  const double tilt = rad_from_deg(0.5);
  ASSERT_TRUE(plate.add({.point_mm = 0.0, .axis_rad = tilt, .angle_rad = 0.0}));
  for (std::size_t i = 0; i < plate.mesh.vertices_mm.size(); ++i) {
    const double height = std::abs(static_cast<double>(plate.mesh.vertices_mm[i].z()));
    EXPECT_NEAR(plate.mesh.sigma_systematic_mm[i], height * tilt, 0.02) << height;
  }
}

TEST(TurntablePart, TurnsTheFacesOfAPlateAgainstEachOther) {
  SeenPlate plate;
  const double turn = rad_from_deg(0.3);
  ASSERT_TRUE(plate.add({.point_mm = 0.0, .axis_rad = 0.0, .angle_rad = turn}));
  for (std::size_t i = 0; i < plate.mesh.vertices_mm.size(); ++i) {
    const double aside = std::abs(static_cast<double>(plate.mesh.vertices_mm[i].y()));
    EXPECT_NEAR(plate.mesh.sigma_systematic_mm[i], 0.5 * aside * turn, 0.01) << aside;
  }
}

TEST(TurntablePart, OfAnExactTurntableLeavesSigmaAsItIs) {
  SeenPlate plate;
  EXPECT_FALSE(plate.add({.point_mm = 0.0005, .axis_rad = 0.0, .angle_rad = 0.0}));
  EXPECT_TRUE(plate.mesh.sigma_systematic_mm.empty());
}

TEST(TurntablePart, StandsAtThePointsAlongTheirRays) {
  SeenPlate plate;
  PointCloud cloud = collect_points(plate.views, plate.camera);
  add_turntable_part(cloud,
                     {CameraViews{plate.views, plate.camera}},
                     motions_of_rig({plate.table, plate.stations}, {.point_mm = 0.5}),
                     {});
  ASSERT_EQ(cloud.systematic_mm.size(), cloud.points_mm.size());
  const auto [low, high] =
      std::minmax_element(cloud.systematic_mm.begin(), cloud.systematic_mm.end());
  EXPECT_NEAR(*low, 0.5, 0.02);
  EXPECT_NEAR(*high, 0.5, 0.02);
}

}  // namespace
}  // namespace frangia
