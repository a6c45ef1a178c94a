#include <array>
#include <cmath>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/simulate/internal/solid_builder.h"
#include "frangia/simulate/parts.h"

namespace frangia {
namespace {

struct Ring {
  double radius, z;
};

/// The turned outline below and above the seat of the key, with a chamfer at each edge.
constexpr std::array<Ring, 10> kBelow{{{17, 0},
                                       {18, 1},
                                       {18, 18},
                                       {22, 18},
                                       {22, 21},
                                       {25, 21},
                                       {26, 22},
                                       {26, 37},
                                       {25, 38},
                                       {18, 38}}};
constexpr std::array<Ring, 6> kAbove{{{17, 80}, {13, 80}, {13, 83}, {14, 83}, {14, 99}, {13, 100}}};
constexpr double kSeatRadius = 18.0;
constexpr double kSeatLow = 38.0;
constexpr double kSeatHigh = 79.0;

/// The keyway: milled from +x, with round ends.
constexpr double kKeyHalfWidth = 3.0;
constexpr double kKeyFloor = 14.0;  ///< x of its floor
constexpr double kKeyLow = 50.0;    ///< z of the cutter's centre at its two ends
constexpr double kKeyHigh = 68.0;
constexpr int kKeyColumns = 64;
constexpr int kAroundAxis = 512;

/// The keyway's edge, column by column across its width.
struct KeyColumn {
  double y, half_height;
};

KeyColumn key_column(int i) {
  const double angle = -0.5 * kPi + kPi * i / kKeyColumns;
  const bool at_side = i == 0 || i == kKeyColumns;
  return {kKeyHalfWidth * std::sin(angle), at_side ? 0.0 : kKeyHalfWidth * std::cos(angle)};
}

/// The directions of all points around: the keyway's columns first, then evenly the rest.
std::vector<double> directions() {
  std::vector<double> angles;
  for (int i = 0; i <= kKeyColumns; ++i)
    angles.push_back(std::asin(key_column(i).y / kSeatRadius));
  const double first = angles.back();
  const double rest = kTwoPi - 2.0 * first;
  for (int i = 1; i < kAroundAxis; ++i)
    angles.push_back(first + rest * i / kAroundAxis);
  return angles;
}

Loop ring_of(const Ring& ring, const std::vector<double>& angles) {
  Loop loop;
  for (const double angle : angles) {
    loop.emplace_back(ring.radius * std::cos(angle), ring.radius * std::sin(angle), ring.z);
  }
  return loop;
}

/// The seat's cylinder with the keyway cut into it, between its lower and its upper edge loop.
void add_seat(SolidBuilder& solid, const Loop& low, const Loop& high) {
  constexpr auto kLast = static_cast<std::size_t>(kKeyColumns);
  Loop rim_low;
  Loop rim_high;
  Loop floor_low;
  Loop floor_high;
  for (std::size_t i = 0; i <= kLast; ++i) {
    const KeyColumn column = key_column(static_cast<int>(i));
    const double z_low = kKeyLow - column.half_height;
    const double z_high = kKeyHigh + column.half_height;
    rim_low.emplace_back(low[i].x(), low[i].y(), z_low);
    rim_high.emplace_back(low[i].x(), low[i].y(), z_high);
    floor_low.emplace_back(kKeyFloor, low[i].y(), z_low);
    floor_high.emplace_back(kKeyFloor, low[i].y(), z_high);
  }
  const Loop key_low(low.begin(), low.begin() + kKeyColumns + 1);
  const Loop key_high(high.begin(), high.begin() + kKeyColumns + 1);
  solid.add_strip(key_low, rim_low);
  solid.add_strip(rim_low, floor_low);
  solid.add_strip(floor_low, floor_high);
  solid.add_strip(floor_high, rim_high);
  solid.add_strip(rim_high, key_high);
  solid.add_face({rim_low.front(), floor_low.front(), floor_high.front(), rim_high.front()});
  solid.add_face({floor_low.back(), rim_low.back(), rim_high.back(), floor_high.back()});
  // The facets beside the keyway take up the ends of its straight sides.
  const std::size_t size = low.size();
  for (std::size_t i = kLast; i < size; ++i) {
    const std::size_t next = (i + 1) % size;
    Loop facet{low[i], low[next]};
    if (next == 0) facet.insert(facet.end(), {rim_low.front(), rim_high.front()});
    facet.insert(facet.end(), {high[next], high[i]});
    if (i == kLast) facet.insert(facet.end(), {rim_high.back(), rim_low.back()});
    solid.add_face(facet);
  }
}

}  // namespace

Mesh make_shaft() {
  const std::vector<double> angles = directions();
  SolidBuilder solid;
  const Loop bottom = ring_of(kBelow[0], angles);
  solid.add_fan({bottom.rbegin(), bottom.rend()}, Eigen::Vector3d::Zero());
  Loop last = bottom;
  const auto turn_to = [&](const Ring& ring) {
    const Loop next = ring_of(ring, angles);
    solid.add_band(last, next);
    last = next;
  };
  for (const Ring& ring : kBelow)
    if (ring.z > 0.0) turn_to(ring);
  const Loop seat_high = ring_of({kSeatRadius, kSeatHigh}, angles);
  add_seat(solid, last, seat_high);
  last = seat_high;
  for (const Ring& ring : kAbove)
    turn_to(ring);
  solid.add_fan(last, {0.0, 0.0, last.front().z()});
  return solid.build();
}

}  // namespace frangia
