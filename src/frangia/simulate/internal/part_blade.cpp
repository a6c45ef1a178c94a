#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"
#include "frangia/simulate/internal/solid_builder.h"
#include "frangia/simulate/parts.h"

namespace frangia {
namespace {

constexpr double kPlatformTop = 29.0;  ///< z
constexpr double kTip = 102.0;
constexpr double kHalfLength = 20.0;  ///< of root and platform, along x
constexpr double kHalfWidth = 14.0;   ///< of the platform, along y
constexpr double kFillet = 2.5;       ///< between platform and aerofoil
constexpr int kAlongSide = 72;        ///< points along one side of the aerofoil
constexpr int kSections = 72;

/// A corner of an outline and the radius that rounds it.
struct Corner {
  double y, z, radius;
};

/// One flank of the fir tree, from its foot up to the platform.
constexpr std::array<Corner, 11> kFlank{{{5.0, 0.0, 1.2},
                                         {8.6, 3.4, 1.2},
                                         {8.6, 5.2, 1.2},
                                         {5.2, 8.4, 1.0},
                                         {5.2, 9.6, 1.0},
                                         {11.2, 13.4, 1.3},
                                         {11.2, 15.4, 1.3},
                                         {7.2, 18.8, 1.2},
                                         {7.2, 21.0, 2.0},
                                         {kHalfWidth, 24.0, 0.0},
                                         {kHalfWidth, kPlatformTop, 0.0}}};

/// The arc that rounds the corner b between a and c.
void append_rounded(std::vector<Eigen::Vector2d>& line,
                    const Eigen::Vector2d& a,
                    const Corner& corner,
                    const Eigen::Vector2d& c) {
  const Eigen::Vector2d b(corner.y, corner.z);
  if (corner.radius == 0.0) {
    line.push_back(b);
    return;
  }
  constexpr int kSteps = 12;
  const Eigen::Vector2d u = (a - b).normalized();
  const Eigen::Vector2d v = (c - b).normalized();
  const double half = 0.5 * std::acos(u.dot(v));
  const Eigen::Vector2d center = b + (u + v).normalized() * (corner.radius / std::sin(half));
  const Eigen::Vector2d from = b + u * (corner.radius / std::tan(half)) - center;
  const double sweep = kPi - 2.0 * half;
  const double sense = u.x() * v.y() - u.y() * v.x() < 0.0 ? 1.0 : -1.0;
  for (int i = 0; i <= kSteps; ++i)
    line.emplace_back(center + Eigen::Rotation2Dd(sense * sweep * i / kSteps) * from);
}

/// The root's outline from the platform's edge at -y, round the foot, to the edge at +y.
std::vector<Eigen::Vector2d> root_outline() {
  constexpr std::size_t kLast = kFlank.size() - 1;
  std::vector<Eigen::Vector2d> right;
  for (std::size_t i = 0; i <= kLast; ++i) {
    const Eigen::Vector2d before = i == 0 ? Eigen::Vector2d(-kFlank[0].y, kFlank[0].z)
                                          : Eigen::Vector2d(kFlank[i - 1].y, kFlank[i - 1].z);
    const Corner& next = kFlank[std::min(i + 1, kLast)];
    append_rounded(right, before, kFlank[i], {next.y, next.z});
  }
  std::vector<Eigen::Vector2d> line(right.rbegin(), right.rend());
  for (auto& p : line)
    p.x() = -p.x();
  line.insert(line.end(), right.begin(), right.end());
  return line;
}

/// The aerofoil for a chord of 1 along x, counter-clockwise: suction side (+y) from the trailing to
/// the leading edge, back along the pressure side, round the trailing edge.
/// @source  NACA four-digit thickness on a circular camber line, trailing edge opened and rounded
std::vector<Eigen::Vector2d> aerofoil(double thickness, double camber) {
  constexpr double kEdge = 0.016;  // half the thickness of the trailing edge
  const auto side = [&](int i, double sign) {
    const double x = 0.5 * (1.0 - std::cos(kPi * i / kAlongSide));
    const double half =
        5.0 * thickness *
            (0.2969 * std::sqrt(x) + x * (-0.1260 + x * (-0.3516 + x * (0.2843 - 0.1036 * x)))) +
        kEdge * x;
    const double slope = 4.0 * camber * (1.0 - 2.0 * x);
    const Eigen::Vector2d normal = Eigen::Vector2d(-slope, 1.0).normalized();
    return Eigen::Vector2d(Eigen::Vector2d(x, 4.0 * camber * x * (1.0 - x)) + sign * half * normal);
  };
  std::vector<Eigen::Vector2d> line;
  for (int i = kAlongSide; i > 0; --i)
    line.push_back(side(i, 1.0));
  for (int i = 0; i <= kAlongSide; ++i)
    line.push_back(side(i, -1.0));
  const Eigen::Vector2d center = 0.5 * (line.front() + line.back());
  const Eigen::Vector2d from = line.back() - center;
  constexpr int kAroundEdge = 8;
  for (int i = 1; i < kAroundEdge; ++i)
    line.emplace_back(center + Eigen::Rotation2Dd(kPi * i / kAroundEdge) * from);
  return line;
}

/// The aerofoil at height z: shorter, thinner and more twisted towards the tip.
Loop section(double z) {
  const double share = (z - kPlatformTop) / (kTip - kPlatformTop);
  const double chord = 31.0 - 8.0 * share;
  const double stagger = rad_from_deg(-14.0 - 38.0 * share);
  const std::vector<Eigen::Vector2d> line = aerofoil(0.15 - 0.06 * share, 0.16 - 0.07 * share);
  const double height = z - kPlatformTop;
  const double short_of = std::max(0.0, kFillet - height);
  const double offset = kFillet - std::sqrt(kFillet * kFillet - short_of * short_of);
  Loop loop;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Eigen::Vector2d along =
        line[(i + 1) % line.size()] - line[(i + line.size() - 1) % line.size()];
    const Eigen::Vector2d out = Eigen::Vector2d(along.y(), -along.x()).normalized();
    const Eigen::Vector2d p = Eigen::Rotation2Dd(stagger) *
                              (chord * (line[i] - Eigen::Vector2d(0.5, 0.09)) + offset * out);
    loop.emplace_back(p.x(), p.y(), z);
  }
  return loop;
}

}  // namespace

Mesh make_blade() {
  SolidBuilder solid;
  const auto root_at = [](double x) {
    Loop loop;
    for (const auto& p : root_outline())
      loop.emplace_back(x, p.x(), p.y());
    return loop;
  };
  const Loop front = root_at(kHalfLength);
  const Loop back = root_at(-kHalfLength);
  solid.add_face(front);
  solid.add_face({back.rbegin(), back.rend()});
  solid.add_strip(back, front);

  Loop last = section(kPlatformTop);
  solid.add_face({back.front(), front.front(), front.back(), back.back()},
                 {{last.rbegin(), last.rend()}});
  constexpr int kFilletSections = 10;
  for (int i = 1; i <= kFilletSections + kSections; ++i) {
    // The fillet's sections lie evenly along its arc, the others evenly in height.
    const double z =
        i <= kFilletSections
            ? kPlatformTop + kFillet * (1.0 - std::cos(0.5 * kPi * i / kFilletSections))
            : kPlatformTop + kFillet +
                  (kTip - kPlatformTop - kFillet) * (i - kFilletSections) / kSections;
    const Loop next = section(z);
    solid.add_band(last, next);
    last = next;
  }
  solid.add_face(last);
  return solid.build();
}

}  // namespace frangia
