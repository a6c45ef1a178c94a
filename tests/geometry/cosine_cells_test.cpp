#include "frangia/geometry/cosine_cells.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace frangia {
namespace {

TEST(CosineCells, WeightDirectionsByTheirCosine) {
  const Eigen::Vector3d normal = Eigen::Vector3d(0.3, -0.5, 0.8).normalized();
  const Eigen::Vector3d side = normal.unitOrthogonal();
  // Means over the cosine-weighted hemisphere: of the cosine 2/3, of its square 1/2, of the square
  // of a tangential component 1/4, of a tangential component 0.
  double cosine = 0.0;
  double square = 0.0;
  double tangential = 0.0;
  double odd = 0.0;
  const auto cells = cosine_cells(normal, 8, 12, 0.3);
  ASSERT_EQ(cells.size(), 96U);
  for (const CosineCell& cell : cells) {
    EXPECT_NEAR(cell.center.norm(), 1.0, 1e-12);
    cosine += normal.dot(cell.center) / 96.0;
    square += std::pow(normal.dot(cell.center), 2) / 96.0;
    tangential += std::pow(side.dot(cell.center), 2) / 96.0;
    odd += side.dot(cell.center) / 96.0;
  }
  EXPECT_NEAR(cosine, 2.0 / 3.0, 0.005);
  EXPECT_NEAR(square, 0.5, 1e-12);
  EXPECT_NEAR(tangential, 0.25, 1e-12);
  EXPECT_NEAR(odd, 0.0, 1e-12);
}

TEST(CosineCells, HaveTheirCentresBetweenTheirSides) {
  for (const CosineCell& cell : cosine_cells(Eigen::Vector3d::UnitZ(), 6, 8, 0.7)) {
    for (const auto& [low, high] : cell.sides) {
      EXPECT_NEAR(low.norm(), 1.0, 1e-12);
      EXPECT_NEAR(high.norm(), 1.0, 1e-12);
      EXPECT_GT((low + high).normalized().dot(cell.center), 0.97);
    }
  }
}

}  // namespace
}  // namespace frangia
