#include "frangia/align/align_datum.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"

#include "support/error_of.h"

namespace frangia {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Shape plane(const Vector3d& center, const Vector3d& normal) {
  return {.kind = ShapeKind::Plane, .center_mm = center, .axis = normal.normalized()};
}

Shape displaced(const Isometry3d& pose, Shape shape) {
  shape.center_mm = pose * shape.center_mm;
  shape.axis = pose.linear() * shape.axis;
  return shape;
}

Datum datum(const std::string& name, const Shape& nominal, const Shape& measured) {
  return {name, nominal, measured, {}};
}

/// A pose as a best fit leaves it: degrees and millimetres.
Isometry3d small_pose(double turn_deg, double shift_mm) {
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() =
      Eigen::AngleAxisd(rad_from_deg(turn_deg), Vector3d(1, -2, 0.5).normalized()).matrix();
  pose.translation() = shift_mm * Vector3d(0.3, 0.8, -0.5);
  return pose;
}

const Vector3d kCenter(10, 5, 20);

TEST(AlignToDatums, RestoresThePoseByThreePlanes) {
  const Isometry3d pose = small_pose(4.0, 3.0);
  std::vector<Datum> datums;
  for (int side = 0; side < 3; ++side) {
    const Shape nominal =
        plane(30.0 * Vector3d::Unit(side) + Vector3d(1, 2, 3), Vector3d::Unit(side));
    datums.push_back(datum(std::to_string(side), nominal, displaced(pose, nominal)));
  }
  datums[1].measured.axis *= -1.0;  // its direction has no meaning
  const DatumAlignment found = align_to_datums(datums, kCenter, 50.0);
  EXPECT_TRUE((found.motion * pose).isApprox(Isometry3d::Identity(), 1e-10));
  EXPECT_TRUE(found.free_directions.empty());
}

/// On a part whose sides are not square the first datum is met, the second as far as it may.
TEST(AlignToDatums, KeepsTheOrderOfTheDatums) {
  const double skew = 0.01;
  std::vector<Datum> datums;
  datums.push_back(datum("A", plane({0, 0, 0}, {0, 0, 1}), plane({20, 10, 0.4}, {0.003, 0, 1})));
  datums.push_back(datum("B", plane({0, 0, 0}, {0, 1, 0}), plane({30, 0.2, 10}, {0.02, 1, skew})));
  datums.push_back(datum("C", plane({0, 0, 0}, {1, 0, 0}), plane({-0.3, 10, 10}, {1, 0, 0})));
  const DatumAlignment found = align_to_datums(datums, kCenter, 50.0);
  ASSERT_EQ(found.residuals.size(), 3U);
  EXPECT_NEAR(found.residuals[0].angle_rad, 0.0, 1e-10);
  EXPECT_NEAR(found.residuals[0].distance_mm, 0.0, 1e-9);
  EXPECT_NEAR(found.residuals[1].angle_rad, skew, 2e-4);  // what the first datum does not allow
  EXPECT_NEAR(found.residuals[1].distance_mm, 0.0, 1e-9);
  EXPECT_NEAR(found.residuals[2].angle_rad, 0.02, 5e-3);
  EXPECT_NEAR(found.residuals[2].distance_mm, 0.0, 1e-9);
  // The other order meets the other plane.
  std::swap(datums[0], datums[1]);
  EXPECT_NEAR(align_to_datums(datums, kCenter, 50.0).residuals[0].angle_rad, 0.0, 1e-10);
}

TEST(AlignToDatums, TakesAnAxisAndACenter) {
  const Isometry3d pose = small_pose(3.0, 2.0);
  const Shape bore{
      .kind = ShapeKind::Cylinder, .center_mm = {5, 6, 10}, .axis = {0, 0, 1}, .radius_mm = 4};
  const Shape ball{.kind = ShapeKind::Sphere, .center_mm = {40, 10, 12}, .radius_mm = 8};
  Shape measured = displaced(pose, bore);
  measured.center_mm += 7.0 * measured.axis;  // any point of the axis
  const std::vector<Datum> datums{datum("bore", bore, measured),
                                  datum("ball", ball, displaced(pose, ball))};
  const DatumAlignment found = align_to_datums(datums, kCenter, 50.0);
  EXPECT_TRUE((found.motion * pose).isApprox(Isometry3d::Identity(), 1e-9));
}

TEST(AlignToDatums, NamesWhatIsLeftFree) {
  const Shape top = plane({0, 0, 30}, {0, 0, 1});
  const std::vector<Datum> datums{datum("top", top, plane({5, 5, 31}, {0.01, 0, 1}))};
  EXPECT_EQ(align_to_datums(datums, kCenter, 50.0).free_directions.size(), 3U);
  const Shape shaft{
      .kind = ShapeKind::Cylinder, .center_mm = {0, 0, 10}, .axis = {0, 0, 1}, .radius_mm = 4};
  const std::vector<Datum> round{datum("shaft", shaft, shaft), datum("top", top, top)};
  const auto free = align_to_datums(round, kCenter, 50.0).free_directions;
  ASSERT_EQ(free.size(), 1U);
  EXPECT_EQ(free[0].rfind("rotation about (", 0), 0U) << free[0];
}

/// The scatter of the poses over draws of the datums is that which the covariance states.
TEST(AlignToDatums, StatesTheUncertaintyOfThePose) {
  constexpr double kAngle = 0.0005;
  constexpr double kPlace = 0.01;
  std::vector<Datum> datums;
  for (int side = 0; side < 3; ++side) {
    const Shape nominal = plane(30.0 * Vector3d::Unit(side), Vector3d::Unit(side));
    datums.push_back(datum(std::to_string(side), nominal, nominal));
    datums.back().uncertainty.axis_u95_rad = 1.96 * kAngle;
    datums.back().uncertainty.center_u95_mm = 1.96 * kPlace;
  }
  const Vector3d probe(25, -10, 15);
  const Vector3d along = Vector3d(1, 2, -1).normalized();
  constexpr int kDraws = 2000;
  double squares = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<Datum> drawn = datums;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto random = [&](std::uint64_t which) {
        return normal_from(hash(hash(static_cast<std::uint64_t>(draw), k), which));
      };
      Shape& measured = drawn[k].measured;
      const Vector3d side = measured.axis.unitOrthogonal();
      measured.center_mm += kPlace * random(0) * measured.axis;
      measured.axis = (measured.axis + kAngle * random(1) * side +
                       kAngle * random(2) * measured.axis.cross(side))
                          .normalized();
    }
    const Isometry3d motion = align_to_datums(drawn, kCenter, 50.0).motion;
    squares += std::pow(along.dot(motion * probe - probe), 2) / kDraws;
  }
  const double stated = align_to_datums(datums, kCenter, 50.0).uncertainty.along(probe, along);
  EXPECT_NEAR(std::sqrt(squares) / stated, 1.0, 0.06);
}

TEST(AlignToDatums, RefusesDatumsThatDetermineNothing) {
  const Shape top = plane({0, 0, 30}, {0, 0, 1});
  const Shape bottom = plane({0, 0, 0}, {0, 0, 1});
  const auto fault = [](const std::vector<Datum>& datums) {
    return testing::error_of([&] { static_cast<void>(align_to_datums(datums, kCenter, 50.0)); });
  };
  EXPECT_NE(
      fault({datum("A", top, top), datum("B", bottom, bottom)}).find("datum \"B\" determines"),
      std::string::npos);
  const Shape ball{.kind = ShapeKind::Sphere, .center_mm = {0, 0, 0}, .radius_mm = 5};
  EXPECT_NE(fault({datum("A", top, ball)}).find("of one kind"), std::string::npos);
  EXPECT_NE(fault({}), "");
}

}  // namespace
}  // namespace frangia
