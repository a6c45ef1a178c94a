#include "frangia/fusion/internal/place_vertices.h"

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// The exact distance from the intersection of half spaces, and the face that is nearest.
struct ConvexPart {
  std::vector<Eigen::Hyperplane<double, 3>> faces;

  [[nodiscard]] std::size_t nearest(const Vector3d& p) const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < faces.size(); ++i) {
      if (faces[i].signedDistance(p) > faces[best].signedDistance(p)) best = i;
    }
    return best;
  }
  [[nodiscard]] double distance(const Vector3d& p) const {
    return faces[nearest(p)].signedDistance(p);
  }
};

/// The crossings of a part with a grid around the origin, and what one exact view contributes to
/// each: the plane of the nearest face.
struct ExactSamples {
  ExactSamples(const ConvexPart& part, double voxel_mm, double sigma_mm)
      : crossings(find(part, voxel_mm)), hermite(crossings.points_mm.size()) {
    for (std::size_t i = 0; i < hermite.size(); ++i) {
      const Vector3d point = crossings.points_mm[i].cast<double>();
      const auto& face = part.faces[part.nearest(point)];
      const auto weight = static_cast<float>(1.0 / (sigma_mm * sigma_mm));
      HermiteAccumulator::PlaneSum& sum = hermite[i].first;
      sum.weight = weight;
      sum.weight_squared = weight * weight;
      sum.offset = weight * static_cast<float>(face.signedDistance(point));
      sum.noise_squared = weight;                                  // w^2 sigma^2
      sum.spacing = weight * static_cast<float>(0.01 * voxel_mm);  // no correlation
      sum.normal = weight * face.normal().cast<float>();
      sum.views = 3;
    }
  }

  static EdgeCrossings find(const ConvexPart& part, double voxel_mm) {
    DistanceField field;
    field.voxel_mm = voxel_mm;
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3i coords(i % 2 - 1, i / 2 % 2 - 1, i / 4 - 1);
      field.index.add(block_key(coords), static_cast<std::uint32_t>(i));
      field.block_coords.push_back(coords);
      field.blocks.append_uninitialized();
      for (int k = 0; k < static_cast<int>(DistanceField::kVoxels); ++k) {
        const Eigen::Vector3i voxel = coords * 8 + Eigen::Vector3i(k & 7, k >> 3 & 7, k >> 6);
        const double d = part.distance(voxel_mm * voxel.cast<double>());
        field.blocks[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = {
            static_cast<float>(d), 1.0F};
      }
    }
    return find_edge_crossings(field);
  }

  EdgeCrossings crossings;
  HermiteAccumulators hermite;
};

Eigen::Hyperplane<double, 3> plane(const Vector3d& normal, const Vector3d& through) {
  return {normal.normalized(), through};
}

TEST(PlaceVertices, PutsVerticesOfAPlaneOntoIt) {
  const auto face = plane({0.3, -0.5, 1.0}, {0.1, 0.2, 0.3});
  const ExactSamples samples({{face}}, 1.0, 0.01);
  const PlacedVertices placed = place_vertices(samples.crossings, samples.hermite);
  ASSERT_GT(placed.mesh.vertices_mm.size(), 200U);
  for (std::size_t i = 0; i < placed.mesh.vertices_mm.size(); ++i) {
    EXPECT_NEAR(face.signedDistance(placed.mesh.vertices_mm[i].cast<double>()), 0.0, 1e-5);
    EXPECT_EQ(placed.sharp[i], 0);
    EXPECT_EQ(placed.mesh.views[i], 3);
    EXPECT_NEAR(placed.mesh.normals[i].dot(face.normal().cast<float>()), 1.0F, 1e-6F);
  }
}

TEST(PlaceVertices, DividesTheVarianceByTheNumberOfIndependentCrossings) {
  const ExactSamples samples({{plane({0.02, -0.03, 1.0}, {0.0, 0.0, 0.4})}}, 1.0, 0.01);
  const PlacedVertices placed = place_vertices(samples.crossings, samples.hermite);
  // Nearly level: the four upright edges of a cell cross, and no other.
  std::size_t of_four = 0;
  for (const float sigma : placed.mesh.sigma_mm)
    of_four += std::abs(sigma - 0.01F / 2.0F) < 1e-4F ? 1U : 0U;
  EXPECT_GT(of_four, placed.mesh.sigma_mm.size() * 3 / 4);
}

TEST(PlaceVertices, PutsAVertexOntoTheEdgeOfTwoFaces) {
  const Vector3d through(0.23, 0.0, 0.31);
  const ConvexPart roof{{plane({1.0, 0.1, 0.4}, through), plane({-0.5, 0.0, 1.0}, through)}};
  const Eigen::ParametrizedLine<double, 3> edge(
      through, roof.faces[0].normal().cross(roof.faces[1].normal()).normalized());
  const ExactSamples samples(roof, 1.0, 0.01);
  const PlacedVertices placed = place_vertices(samples.crossings, samples.hermite);
  std::size_t sharp = 0;
  for (std::size_t i = 0; i < placed.sharp.size(); ++i) {
    const Vector3d vertex = placed.mesh.vertices_mm[i].cast<double>();
    EXPECT_NEAR(roof.distance(vertex), 0.0, 1e-4);
    if (placed.sharp[i] == 0) continue;
    ++sharp;
    EXPECT_NEAR(edge.distance(vertex), 0.0, 1e-4);
    // It lies on the edge, and not on a bend of one face somewhere in the cell: 0.1 voxels.
    EXPECT_LT(placed.mesh.sigma_mm[i], 0.05F);
  }
  EXPECT_GE(sharp, 12U);  // the edge runs through 15 cells along y and more
}

TEST(PlaceVertices, PutsAVertexOntoTheCornerOfThreeFaces) {
  const Vector3d corner(0.4, 0.45, 0.6);
  const ConvexPart part{{plane({1.0, 0.1, 0.2}, corner),
                         plane({-0.1, 1.0, 0.1}, corner),
                         plane({0.1, -0.2, 1.0}, corner)}};
  const ExactSamples samples(part, 1.0, 0.01);
  const PlacedVertices placed = place_vertices(samples.crossings, samples.hermite);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vector3f& vertex : placed.mesh.vertices_mm)
    nearest = std::min(nearest, (vertex.cast<double>() - corner).norm());
  EXPECT_LT(nearest, 1e-4);
}

TEST(PlaceVertices, LeavesAVertexWithoutASupportedCrossingAtZero) {
  ExactSamples samples({{plane({0.0, 0.0, 1.0}, {0.0, 0.0, 0.4})}}, 1.0, 0.01);
  for (std::size_t i = 0; i < samples.hermite.size(); ++i)
    samples.hermite[i].free_space_weight = 1e9F;
  const PlacedVertices placed = place_vertices(samples.crossings, samples.hermite);
  ASSERT_FALSE(placed.mesh.vertices_mm.empty());
  for (const Vector3f& vertex : placed.mesh.vertices_mm)
    EXPECT_TRUE(vertex.isZero());
}

HermiteSample sample(const Vector3f& point, const Vector3f& normal) {
  HermiteSample out{};
  out.point = point;
  out.normal = normal.normalized();
  out.supported = true;
  return out;
}

TEST(SolvePosition, StaysInTheCellWhereNearlyParallelPlanesIntersectFarAway) {
  const HermiteSample one = sample({0.2F, 0.5F, 0.5F}, {0.35F, 0.0F, 1.0F});
  const HermiteSample other = sample({0.8F, 0.5F, 0.5F}, {0.9F, 0.0F, 1.0F});
  LoopSamples loop;
  loop.add(one);
  loop.add(other);
  loop.close();
  const CellBox cell(Vector3f::Zero(), 1.0F, 0.0F);
  // The planes intersect at x = 1.18, outside of the cell.
  EXPECT_TRUE(cell.contains(solve_position(loop, false, 0.001F, cell)));
  const CellBox larger(Vector3f::Zero(), 1.0F, 0.5F);
  const Vector3f point = solve_position(loop, false, 0.001F, larger);
  EXPECT_NEAR(one.normal.dot(point - one.point), 0.0F, 1e-4F);
  EXPECT_NEAR(other.normal.dot(point - other.point), 0.0F, 1e-4F);
}

}  // namespace
}  // namespace frangia
