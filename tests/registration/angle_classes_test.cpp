// Classes of angles that differ from those stated.
#include "frangia/registration/explain/internal/angle_classes.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

std::vector<double> in_rad(std::vector<double> degrees) {
  for (double& angle : degrees)
    angle = rad_from_deg(angle);
  return degrees;
}

TEST(AngleClasses, NameTheViewsThatDoNotTurnWithMostOthers) {
  const ClassedAngles all = all_turned(in_rad({0, 45, 90, 135}), in_rad({120, 165, 250, 255}));
  EXPECT_EQ(all.as.views, std::vector<std::size_t>{2});
  EXPECT_NEAR(all.as.turned_rad, rad_from_deg(40.0), 1e-9);
  EXPECT_NEAR(all.angles_rad[0], 0.0, 1e-9);
  EXPECT_NEAR(all.angles_rad[2], rad_from_deg(130.0), 1e-9);
}

TEST(AngleClasses, FollowRefinedAnglesByTheirOwnUnknownsAlone) {
  const std::vector<double> given = in_rad({0, 45, 90, 135});
  const ClassedAngles step =
      followed(given, turned_from(given, 2, rad_from_deg(10.0)), in_rad({0, 45, 100.4, 145.6}));
  EXPECT_NEAR(step.as.turned_rad, rad_from_deg(10.5), 1e-9);
  const ClassedAngles alone =
      followed(given, turned_alone(given, 2, rad_from_deg(10.0)), in_rad({0, 45.3, 100.4, 135}));
  EXPECT_NEAR(alone.angles_rad[1], rad_from_deg(45.0), 1e-9);
  EXPECT_NEAR(alone.angles_rad[2], rad_from_deg(100.4), 1e-9);
  const ClassedAngles scaled =
      followed(given, angles_scaled_by(given, -1.0), in_rad({0, -45.45, -90.9, -136.35}));
  EXPECT_NEAR(scaled.as.scale, -1.01, 1e-9);
  const std::vector<double> one = in_rad({0, 0, 0});
  const ClassedAngles even =
      followed(one, evenly_spaced(one, rad_from_deg(40.0)), in_rad({0, 40.5, 81}));
  EXPECT_NEAR(even.as.spacing_rad, rad_from_deg(40.5), 1e-9);
}

TEST(AngleClasses, FollowAViewBackToItsStatedAngle) {
  const std::vector<double> given = in_rad({0, 45, 90, 135});
  const ClassedAngles back = followed(given, turned_alone(given, 2, rad_from_deg(2.0)), given);
  EXPECT_TRUE(back.as.views.empty());
  EXPECT_EQ(followed(given, back, given).angles_rad, back.angles_rad);
}

TEST(AngleClasses, AreTheSimplestThatTurnsFollow) {
  const std::vector<double> given = in_rad({0, 45, 90, 135});
  EXPECT_EQ(simplest_of(given, in_rad({0, 4.5, 9, 13.5})).kind, AngleClass::Scaled);
  EXPECT_EQ(simplest_of(given, in_rad({0, 0, 7, 7})).kind, AngleClass::Step);
  const ClassedAngles any = simplest_of(given, in_rad({0, 7, 0, 0}));
  EXPECT_EQ(any.kind, AngleClass::All);
  EXPECT_EQ(any.as.views, std::vector<std::size_t>{1});
}

TEST(AngleClasses, ChangeTurnsBetweenViewsAndNotThoseOfAll) {
  EXPECT_NEAR(largest_change(in_rad({0, 45, 90}), in_rad({350, 35, 80})).change_rad, 0.0, 1e-9);
  const ViewChange change = largest_change(in_rad({0, 45, 90}), in_rad({0, 45, 300}));
  EXPECT_EQ(change.view, 2U);
  EXPECT_NEAR(change.change_rad, rad_from_deg(150.0), 1e-9);
}

}  // namespace
}  // namespace frangia
