// The thickness of walls whose thickness is known.
#include "frangia/inspect/thickness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

/// A tube of two surfaces about z, open at both ends.
Mesh make_tube(double outer_mm, double inner_mm, double length_mm, int around, int rings) {
  Mesh mesh;
  for (const double radius : {outer_mm, inner_mm}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices_mm.size());
    for (int ring = 0; ring <= rings; ++ring) {
      for (int i = 0; i < around; ++i) {
        const double angle = kTwoPi * i / around;
        mesh.vertices_mm.emplace_back(static_cast<float>(radius * std::cos(angle)),
                                      static_cast<float>(radius * std::sin(angle)),
                                      static_cast<float>(length_mm * ring / rings));
      }
    }
    for (int ring = 0; ring < rings; ++ring) {
      for (int i = 0; i < around; ++i) {
        const auto at = [&](int r, int k) {
          return first + static_cast<std::uint32_t>(r * around + k % around);
        };
        Mesh::Triangle a{at(ring, i), at(ring, i + 1), at(ring + 1, i + 1)};
        Mesh::Triangle b{at(ring, i), at(ring + 1, i + 1), at(ring + 1, i)};
        if (radius == inner_mm) {
          std::swap(a[1], a[2]);
          std::swap(b[1], b[2]);
        }
        mesh.triangles.push_back(a);
        mesh.triangles.push_back(b);
      }
    }
  }
  return mesh;
}

std::size_t count_of(const ThicknessSummary& summary, ThicknessStatus status) {
  return summary.count.at(static_cast<std::size_t>(status));
}

TEST(Thickness, OfATubeIsTheDifferenceOfItsRadii) {
  Mesh mesh = make_tube(20.0, 17.0, 40.0, 360, 20);
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), 0.03F);
  const Thickness walls = thickness_of(RayScene(mesh));
  const ThicknessSummary summary = summarize(mesh, walls);
  EXPECT_NEAR(summary.min_mm, 3.0, 0.002);  // chords of the facets
  EXPECT_NEAR(summary.max_mm, 3.0, 0.002);
  EXPECT_NEAR(summary.median_mm, 3.0, 0.002);
  EXPECT_NEAR(summary.median_u_mm, 0.03 * std::sqrt(2.0), 0.0002);
  EXPECT_EQ(count_of(summary, ThicknessStatus::MeshEdge), 4U * 360U);
  EXPECT_EQ(count_of(summary, ThicknessStatus::Measured), 2U * 19U * 360U);
}

TEST(Thickness, OfAnEccentricTubeIsSmallestWhereTheBoreIsNearest) {
  Mesh mesh = make_tube(20.0, 17.0, 40.0, 360, 20);
  for (std::size_t i = mesh.vertices_mm.size() / 2; i < mesh.vertices_mm.size(); ++i)
    mesh.vertices_mm[i].x() += 1.0F;
  const ThicknessSummary summary = summarize(mesh, thickness_of(RayScene(mesh)));
  EXPECT_NEAR(summary.min_mm, 2.0, 0.002);
  EXPECT_NEAR(summary.max_mm, 4.0, 0.002);
  EXPECT_GT(summary.min_at_mm.x(), 16.0);
  EXPECT_NEAR(summary.min_at_mm.y(), 0.0, 0.5);
  EXPECT_TRUE(std::isnan(summary.median_u_mm));
}

TEST(Thickness, OfAWedgeIsTheRayAndAnInclinedWallIsNone) {
  // Two large squares at 20 degrees to each other; the ray from the lower one is x tan(20).
  for (const auto& [tilt_deg, measured] : {std::pair{20.0, true}, {50.0, false}}) {
    const double slope = std::tan(rad_from_deg(tilt_deg));
    Mesh mesh;
    constexpr int kAcross = 20;
    for (const bool upper : {false, true}) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices_mm.size());
      for (int y = 0; y <= kAcross; ++y) {
        for (int x = 0; x <= kAcross; ++x) {
          const double along = 10.0 + x;
          mesh.vertices_mm.emplace_back(static_cast<float>(along),
                                        static_cast<float>(y),
                                        static_cast<float>(upper ? along * slope : 0.0));
        }
      }
      for (int y = 0; y < kAcross; ++y) {
        for (int x = 0; x < kAcross; ++x) {
          const auto at = [&](int dx, int dy) {
            return first + static_cast<std::uint32_t>((y + dy) * (kAcross + 1) + x + dx);
          };
          Mesh::Triangle a{at(0, 0), at(1, 0), at(1, 1)};
          Mesh::Triangle b{at(0, 0), at(1, 1), at(0, 1)};
          if (!upper) {
            std::swap(a[1], a[2]);
            std::swap(b[1], b[2]);
          }
          mesh.triangles.push_back(a);
          mesh.triangles.push_back(b);
        }
      }
    }
    const Thickness walls = thickness_of(RayScene(mesh));
    const std::size_t middle = 10 * (kAcross + 1) + 5;  // x = 15 on the lower square
    if (measured) {
      EXPECT_NEAR(walls.thickness_mm[middle], 15.0 * slope, 1e-4);
    } else {
      EXPECT_EQ(walls.status[middle], ThicknessStatus::Oblique);
      EXPECT_TRUE(std::isnan(walls.thickness_mm[middle]));
    }
  }
}

/// A closed box of 40 x 30 x 3 mm in any orientation, one vertex a millimetre, shared at its edges.
Mesh turned_box() {
  constexpr std::array<int, 3> kSize{40, 30, 3};
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(0.3, 1.0, -0.4).normalized());
  Mesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> numbers;
  const auto number = [&](const std::array<int, 3>& at) {
    const auto [place, is_new] =
        numbers.try_emplace(at, static_cast<std::uint32_t>(mesh.vertices_mm.size()));
    if (is_new)
      mesh.vertices_mm.emplace_back((turn * Eigen::Vector3d(at[0], at[1], at[2])).cast<float>());
    return place->second;
  };
  for (std::size_t side = 0; side < 3; ++side) {
    const std::size_t u = (side + 1) % 3;
    const std::size_t v = (side + 2) % 3;
    for (const bool upper : {false, true}) {
      for (int i = 0; i < kSize.at(u); ++i) {
        for (int k = 0; k < kSize.at(v); ++k) {
          const auto corner = [&](int di, int dk) {
            std::array<int, 3> at{};
            at.at(side) = upper ? kSize.at(side) : 0;
            at.at(u) = i + di;
            at.at(v) = k + dk;
            return number(at);
          };
          Mesh::Triangle a{corner(0, 0), corner(1, 0), corner(1, 1)};
          Mesh::Triangle b{corner(0, 0), corner(1, 1), corner(0, 1)};
          if (!upper) {
            std::swap(a[1], a[2]);
            std::swap(b[1], b[2]);
          }
          mesh.triangles.push_back(a);
          mesh.triangles.push_back(b);
        }
      }
    }
  }
  return mesh;
}

TEST(Thickness, LeavesOutSharpEdgesInAnyOrientation) {
  const Mesh mesh = turned_box();
  const Thickness walls = thickness_of(RayScene(mesh));
  const ThicknessSummary summary = summarize(mesh, walls);
  // The vertices of twelve edges.
  EXPECT_EQ(count_of(summary, ThicknessStatus::SharpEdge), 4U * (39U + 29U + 2U) + 8U);
  EXPECT_EQ(count_of(summary, ThicknessStatus::Measured),
            mesh.vertices_mm.size() - count_of(summary, ThicknessStatus::SharpEdge));
  for (const float one : walls.thickness_mm) {
    if (std::isnan(one)) continue;
    const bool known = std::abs(one - 3.0F) < 1e-4F || std::abs(one - 30.0F) < 1e-4F ||
                       std::abs(one - 40.0F) < 1e-4F;
    EXPECT_TRUE(known) << one;
  }
}

TEST(Thickness, AddsTheSystematicPartsOfBothWalls) {
  Mesh mesh = turned_box();
  const std::size_t count = mesh.vertices_mm.size();
  mesh.sigma_noise_mm.assign(count, 0.004F);
  mesh.sigma_systematic_mm.assign(count, 0.003F);
  mesh.sigma_mm.assign(count, 0.005F);
  const ThicknessSummary summary = summarize(mesh, thickness_of(RayScene(mesh)));
  // Noise differs between the walls; an error that is alike in both, such as one of scale, adds up.
  EXPECT_NEAR(summary.median_u_mm, std::hypot(0.004 * std::sqrt(2.0), 2.0 * 0.003), 1e-7);
}

TEST(Thickness, LeavesOutWallsThatWereNotMeasured) {
  Mesh mesh = make_tube(20.0, 17.0, 40.0, 180, 20);
  // A patch of the bore is synthesized, another is missing.
  mesh.triangle_marks.assign(mesh.triangles.size(), Mark::Measured);
  const auto middle_of = [&](const Mesh::Triangle& t) {
    return Eigen::Vector3f(
        (mesh.vertices_mm[t[0]] + mesh.vertices_mm[t[1]] + mesh.vertices_mm[t[2]]) / 3.0F);
  };
  std::vector<Mesh::Triangle> kept;
  std::vector<Mark> marks;
  for (const Mesh::Triangle& triangle : mesh.triangles) {
    const Eigen::Vector3f at = middle_of(triangle);
    const bool bore = std::hypot(at.x(), at.y()) < 18.0F;
    const bool high = at.z() > 15.0F && at.z() < 25.0F;
    if (bore && high && at.y() > 12.0F) continue;
    kept.push_back(triangle);
    marks.push_back(bore && high && at.x() > 12.0F ? Mark::Synthesized : Mark::Measured);
  }
  mesh.triangles = kept;
  mesh.triangle_marks = marks;
  const Thickness walls = thickness_of(RayScene(mesh));
  const ThicknessSummary summary = summarize(mesh, walls);
  EXPECT_GT(count_of(summary, ThicknessStatus::Synthesized), 50U);
  for (std::size_t i = 0; i < mesh.vertices_mm.size() / 2; ++i) {
    const Eigen::Vector3f& p = mesh.vertices_mm[i];
    if (p.z() < 17.0F || p.z() > 23.0F) continue;
    if (p.x() > 18.0F) {
      EXPECT_EQ(walls.status[i], ThicknessStatus::Synthesized);
    }
    // The ray leaves through the hole and meets the far side of the bore from outside.
    if (p.y() > 18.0F) {
      EXPECT_NE(walls.status[i], ThicknessStatus::Measured);
    }
  }
  EXPECT_NEAR(summary.max_mm, 3.0, 0.01);
}

}  // namespace
}  // namespace frangia
