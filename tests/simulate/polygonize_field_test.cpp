#include "frangia/simulate/internal/polygonize_field.h"

#include <gtest/gtest.h>

#include "frangia/core/error.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

TEST(PolygonizeField, MakesAClosedSphereWithEveryVertexOnIt) {
  const Eigen::Vector3d center(1, 2, 3);
  const auto field = [&](const Eigen::Vector3d& p) { return (p - center).norm() - 10.0; };
  const Mesh mesh =
      polygonize_field(field, {Eigen::Vector3d(-11, -11, -11), Eigen::Vector3d(14, 14, 15)}, 0.5);
  EXPECT_EQ(testing::open_edges(mesh), 0U);
  EXPECT_NEAR(testing::volume_mm3(mesh), 4.0 / 3.0 * kPi * 1000.0, 6.0);
  for (const auto& vertex : mesh.vertices_mm)
    EXPECT_NEAR((vertex.cast<double>() - center).norm(), 10.0, 1e-5);
}

TEST(PolygonizeField, RefusesASolidThatReachesTheBorder) {
  const auto field = [](const Eigen::Vector3d& p) { return p.norm() - 10.0; };
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-9, -12, -12), Eigen::Vector3d(12, 12, 12));
  EXPECT_THROW(static_cast<void>(polygonize_field(field, box, 1.0)), Error);
}

}  // namespace
}  // namespace frangia
