// A temperature that is not known scales sizes and distances alike.
#include <gtest/gtest.h>

#include "frangia/features/find_features.h"
#include "frangia/features/geometric_tolerance.h"
#include "frangia/features/shape_uncertainty.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

TEST(ThermalDisplacement, ScalesDiametersAndDistancesAlike) {
  Mesh mesh = testing::sphere({0.0, -35.0, 0.0}, 15.0, 40);
  const Mesh second = testing::sphere({0.0, 35.0, 0.0}, 15.0, 40);
  const auto first = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  mesh.vertices_mm.insert(
      mesh.vertices_mm.end(), second.vertices_mm.begin(), second.vertices_mm.end());
  for (const Mesh::Triangle& t : second.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), 1e-4F);
  // 20e-6/K and 5 K: 1e-4.
  const Eigen::MatrixXf thermal = thermal_displacement(mesh, 20e-6, 5.0);
  const auto features = find_features(mesh, {.edges = false, .calibration_mm = &thermal});
  ASSERT_EQ(features.size(), 2U);
  for (const Feature& feature : features)
    EXPECT_NEAR(feature.uncertainty.systematic_mm, 30.0 * 1e-4, 2e-5);
  const MeasuredFeature datum{.feature = features[1]};
  const MeasuredValue distance =
      measure(Characteristic::Distance, {.feature = features[0]}, &datum);
  EXPECT_NEAR(distance.u95, 1.96 * 70.0 * 1e-4, 3e-4);
}

}  // namespace
}  // namespace frangia
