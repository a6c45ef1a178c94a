#include <cmath>

#include "frangia/core/angles.h"
#include "frangia/simulate/internal/solid_builder.h"
#include "frangia/simulate/parts.h"

namespace frangia {
namespace {

constexpr double kSide = 25.0;    ///< |y| of the two sides
constexpr double kBack = -30.0;   ///< x
constexpr double kInner = -22.0;  ///< x of the wall's inner face
constexpr double kShelfEnd = 8.0;
constexpr double kFront = 30.0;
constexpr double kBaseTop = 8.0;  ///< z
constexpr double kShelfLow = 62.0;
constexpr double kTop = 70.0;
constexpr double kRibHalf = 3.0;  ///< |y|
constexpr double kRibEnd = 8.0;   ///< x
constexpr double kRibTop = 38.0;  ///< z
constexpr int kRound = 256;

/// A circle in the plane of u and v, counter-clockwise seen against u x v.
Loop bore(const Eigen::Vector3d& center,
          const Eigen::Vector3d& u,
          const Eigen::Vector3d& v,
          double radius) {
  Loop loop;
  for (const auto& p : circle(Eigen::Vector3d::Zero(), radius, kRound))
    loop.emplace_back(center + p.x() * u + p.y() * v);
  return loop;
}

Loop bore_z(double x, double y, double z, double radius) {
  return bore({x, y, z}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), radius);
}

Loop bore_x(double x, double y) {
  return bore({x, y, 50.0}, Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ(), 6.0);
}

Loop outline(double y) {
  return {{kBack, y, 0},
          {kFront, y, 0},
          {kFront, y, kBaseTop},
          {kInner, y, kBaseTop},
          {kInner, y, kShelfLow},
          {kShelfEnd, y, kShelfLow},
          {kShelfEnd, y, kTop},
          {kBack, y, kTop}};
}

void add_base(SolidBuilder& solid) {
  std::vector<Loop> low;
  std::vector<Loop> high;
  for (const double y : {-14.0, 14.0}) {
    const Loop below = bore_z(18.0, y, 0.0, 5.0);
    const Loop above = bore_z(18.0, y, kBaseTop, 5.0);
    low.push_back(below);
    high.push_back(reversed(above));
    solid.add_band(reversed(below), reversed(above));
  }
  solid.add_face({{kBack, kSide, 0}, {kFront, kSide, 0}, {kFront, -kSide, 0}, {kBack, -kSide, 0}},
                 low);
  solid.add_face({{kInner, -kSide, kBaseTop},
                  {kFront, -kSide, kBaseTop},
                  {kFront, kSide, kBaseTop},
                  {kInner, kSide, kBaseTop},
                  {kInner, kRibHalf, kBaseTop},
                  {kRibEnd, kRibHalf, kBaseTop},
                  {kRibEnd, -kRibHalf, kBaseTop},
                  {kInner, -kRibHalf, kBaseTop}},
                 high);
  solid.add_face({{kFront, -kSide, 0},
                  {kFront, kSide, 0},
                  {kFront, kSide, kBaseTop},
                  {kFront, -kSide, kBaseTop}});
}

void add_wall(SolidBuilder& solid) {
  std::vector<Loop> inner;
  std::vector<Loop> back;
  for (const double y : {-13.0, 13.0}) {
    back.push_back(bore_x(kBack, y));
    inner.push_back(reversed(bore_x(kInner, y)));
    solid.add_band(reversed(back.back()), inner.back());
  }
  solid.add_face({{kInner, -kSide, kBaseTop},
                  {kInner, -kRibHalf, kBaseTop},
                  {kInner, -kRibHalf, kRibTop},
                  {kInner, kRibHalf, kRibTop},
                  {kInner, kRibHalf, kBaseTop},
                  {kInner, kSide, kBaseTop},
                  {kInner, kSide, kShelfLow},
                  {kInner, -kSide, kShelfLow}},
                 inner);
  solid.add_face(
      {{kBack, kSide, 0}, {kBack, -kSide, 0}, {kBack, -kSide, kTop}, {kBack, kSide, kTop}}, back);
}

void add_shelf(SolidBuilder& solid) {
  const Loop below = bore_z(-6.0, 0.0, kShelfLow, 7.0);
  const Loop above = bore_z(-6.0, 0.0, kTop, 7.0);
  solid.add_band(reversed(below), reversed(above));
  solid.add_face({{kInner, kSide, kShelfLow},
                  {kShelfEnd, kSide, kShelfLow},
                  {kShelfEnd, -kSide, kShelfLow},
                  {kInner, -kSide, kShelfLow}},
                 {below});
  solid.add_face({{kBack, -kSide, kTop},
                  {kShelfEnd, -kSide, kTop},
                  {kShelfEnd, kSide, kTop},
                  {kBack, kSide, kTop}},
                 {reversed(above)});
  solid.add_face({{kShelfEnd, -kSide, kShelfLow},
                  {kShelfEnd, kSide, kShelfLow},
                  {kShelfEnd, kSide, kTop},
                  {kShelfEnd, -kSide, kTop}});
}

void add_rib(SolidBuilder& solid) {
  const auto side = [](double y) {
    return Loop{{kInner, y, kBaseTop}, {kRibEnd, y, kBaseTop}, {kInner, y, kRibTop}};
  };
  const Loop right = side(-kRibHalf);
  const Loop left = side(kRibHalf);
  solid.add_face(right);
  solid.add_face(reversed(left));
  solid.add_face({right[1], left[1], left[2], right[2]});
}

}  // namespace

Mesh make_bracket() {
  SolidBuilder solid;
  solid.add_face(outline(-kSide));
  solid.add_face(reversed(outline(kSide)));
  add_base(solid);
  add_wall(solid);
  add_shelf(solid);
  add_rib(solid);
  return solid.build();
}

}  // namespace frangia
