// Which measured feature is that of a planned one.
#include "frangia/inspection/internal/assign_features.h"

#include <gtest/gtest.h>

namespace frangia {
namespace {

using inspection::assign_features;

PlannedFeature planned(const char* name, const Eigen::Vector3d& near_mm, double diameter_mm) {
  PlannedFeature feature;
  feature.name = name;
  feature.kind = ShapeKind::Cylinder;
  feature.near_mm = near_mm;
  feature.diameter_mm = diameter_mm;
  return feature;
}

/// A hole along z through a plate of 10 mm.
MeasuredFeature hole(double x_mm, double diameter_mm) {
  MeasuredFeature measured;
  measured.feature.fit.shape = {
      .kind = ShapeKind::Cylinder, .center_mm = {x_mm, 0.0, 5.0}, .radius_mm = 0.5 * diameter_mm};
  measured.feature.fit.shape.axis = Eigen::Vector3d::UnitZ();
  for (const double z : {0.0, 10.0}) {
    for (const double side : {-0.5, 0.5}) {
      measured.points_mm.emplace_back(x_mm + side * diameter_mm, 0.0, z);
      measured.points_mm.emplace_back(x_mm, side * diameter_mm, z);
    }
  }
  measured.low_mm = -5.0;
  measured.high_mm = 5.0;
  return measured;
}

TEST(PlannedShapes, AreThoseOfTheKindAtThePlaceAndOfTheSize) {
  Mesh part;  // with a diagonal of 100 mm
  part.vertices_mm = {{0, 0, 0}, {60, 80, 0}};
  const auto is_planned = inspection::planned_shapes({planned("bore", {10, 0, 5}, 6)}, part);
  Shape shape = hole(10.0, 6.0).feature.fit.shape;
  EXPECT_TRUE(is_planned(shape));
  shape.center_mm.z() += 4.0;  // along its axis
  EXPECT_TRUE(is_planned(shape));
  shape.center_mm.x() += 1.1;
  EXPECT_FALSE(is_planned(shape));
  EXPECT_FALSE(is_planned(hole(10.0, 7.1).feature.fit.shape));
  shape = hole(10.0, 6.0).feature.fit.shape;
  shape.kind = ShapeKind::Cone;
  EXPECT_FALSE(is_planned(shape));
  EXPECT_FALSE(inspection::planned_shapes({}, part));
}

TEST(AssignFeatures, LeavesAHoleThatIsMissingWithoutTheOneBesideIt) {
  const std::vector<MeasuredFeature> found{hole(0.0, 6.0), hole(20.0, 6.0)};
  const std::vector<PlannedFeature> plan{
      planned("missing", {10, 0, 5}, 6), planned("a", {0, 0, 5}, 6), planned("b", {20, 0, 5}, 6)};
  const auto assigned = assign_features(plan, found, 15.0);
  EXPECT_EQ(assigned[0].measured, nullptr);
  ASSERT_NE(assigned[0].claimed_by, nullptr);
  EXPECT_EQ(assigned[1].measured, found.data());
  EXPECT_EQ(assigned[2].measured, &found[1]);
}

/// A counterbore that was not measured is not the bore below it.
TEST(AssignFeatures, TellsConcentricHolesByTheirSizes) {
  const std::vector<MeasuredFeature> found{hole(0.0, 6.0)};
  const std::vector<PlannedFeature> plan{planned("bore", {0, 0, 5}, 6),
                                         planned("counterbore", {0, 0, 5}, 12)};
  const auto assigned = assign_features(plan, found, 15.0);
  EXPECT_EQ(assigned[0].measured, found.data());
  EXPECT_EQ(assigned[1].measured, nullptr);
}

TEST(AssignFeatures, SharesAFeatureOfTwoNamesAndFindsOneThatMoved) {
  const std::vector<MeasuredFeature> found{hole(0.0, 6.0)};
  const auto shared =
      assign_features({planned("bore", {0, 0, 5}, 6), planned("again", {0, 0, 9}, 6)}, found, 15.0);
  EXPECT_EQ(shared[1].measured, found.data());
  EXPECT_EQ(shared[1].off_mm, 0.0);
  const auto moved = assign_features({planned("bore", {8, 0, 5}, 6)}, found, 15.0);
  EXPECT_EQ(moved[0].measured, found.data());
  EXPECT_NEAR(moved[0].off_mm, 5.0, 1e-9);
}

}  // namespace
}  // namespace frangia
