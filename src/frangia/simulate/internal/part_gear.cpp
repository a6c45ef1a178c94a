#include <algorithm>
#include <cmath>

#include "frangia/core/angles.h"
#include "frangia/simulate/internal/solid_builder.h"
#include "frangia/simulate/parts.h"

namespace frangia {
namespace {

constexpr int kTeeth = 14;
constexpr double kModule = 4.0;
constexpr double kPressureAngle_rad = 20.0 * kPi / 180.0;
constexpr double kPitchRadius = kTeeth * kModule / 2.0;
constexpr double kTipRadius = kPitchRadius + kModule;
constexpr double kRootRadius = kPitchRadius - 1.25 * kModule;
constexpr double kWidth = 24.0;  ///< z of the face of the teeth
constexpr double kHubRadius = 15.0;
constexpr double kHubTop = 40.0;
constexpr double kBoreRadius = 7.0;
constexpr double kKeyHalf = 2.5;  ///< |y| of the keyway, DIN 6885
constexpr double kKeyDepth = 2.3;
constexpr int kCorners = 256;

double involute(double angle_rad) {
  return std::tan(angle_rad) - angle_rad;
}

/// Half the angle that a tooth takes at a radius, at least that of the base circle.
/// @source   ISO 21771
double half_tooth_rad(double radius) {
  const double base = kPitchRadius * std::cos(kPressureAngle_rad);
  const double pressure_rad = std::acos(std::min(1.0, base / radius));
  return kPi / (2 * kTeeth) + involute(kPressureAngle_rad) - involute(pressure_rad);
}

Eigen::Vector3d at(double radius, double angle_rad, double z) {
  return {radius * std::cos(angle_rad), radius * std::sin(angle_rad), z};
}

/// Tooth by tooth, counter-clockwise from above: half a root, flank, tip, flank, half a root.
Loop teeth(double z) {
  constexpr int kSteps = 24;
  constexpr int kHalves = 4;
  const double base = kPitchRadius * std::cos(kPressureAngle_rad);
  const double foot_rad = half_tooth_rad(base);
  const double tip_rad = half_tooth_rad(kTipRadius);
  Loop half;  // radius and angle from the middle of a tooth, from the middle of the root on
  for (int i = 0; i <= kHalves; ++i)
    half.emplace_back(kRootRadius, kPi / kTeeth + (foot_rad - kPi / kTeeth) * i / kHalves, z);
  for (int i = 0; i <= kSteps; ++i) {
    const double radius = base + (kTipRadius - base) * i / kSteps;
    half.emplace_back(radius, half_tooth_rad(radius), z);
  }
  for (int i = 1; i <= kHalves / 2; ++i)
    half.emplace_back(kTipRadius, tip_rad * (1.0 - 2.0 * i / kHalves), z);
  Loop loop;
  for (int tooth = 0; tooth < kTeeth; ++tooth) {
    const double middle_rad = kTwoPi * tooth / kTeeth;
    for (const auto& p : half)
      loop.push_back(at(p.x(), middle_rad - p.y(), z));
    // Back down the other side, but for the middles of tip and root.
    for (auto p = half.rbegin() + 1; p + 1 != half.rend(); ++p)
      loop.push_back(at(p->x(), middle_rad + p->y(), z));
  }
  return loop;
}

Loop bore_with_keyway(double z) {
  const double corner_rad = std::asin(kKeyHalf / kBoreRadius);
  Loop loop;
  for (int i = 0; i <= kCorners; ++i)
    loop.push_back(at(kBoreRadius, corner_rad + (kTwoPi - 2.0 * corner_rad) * i / kCorners, z));
  loop.emplace_back(kBoreRadius + kKeyDepth, -kKeyHalf, z);
  loop.emplace_back(kBoreRadius + kKeyDepth, kKeyHalf, z);
  return loop;
}

}  // namespace

Mesh make_gear() {
  const Loop low = teeth(0.0);
  const Loop high = teeth(kWidth);
  const Loop hub_low = circle({0.0, 0.0, kWidth}, kHubRadius, kCorners);
  const Loop hub_high = circle({0.0, 0.0, kHubTop}, kHubRadius, kCorners);
  const Loop bore_low = bore_with_keyway(0.0);
  const Loop bore_high = bore_with_keyway(kHubTop);
  SolidBuilder solid;
  solid.add_face(reversed(low), {bore_low});
  solid.add_band(low, high);
  solid.add_face(high, {reversed(hub_low)});
  solid.add_band(hub_low, hub_high);
  solid.add_face(hub_high, {reversed(bore_high)});
  solid.add_band(reversed(bore_low), reversed(bore_high));
  return solid.build();
}

}  // namespace frangia
