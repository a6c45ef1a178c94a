#include "frangia/surface/paste_views.h"

#include <cmath>
#include <map>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "support/analytic_views.h"

namespace frangia {
namespace {

using testing::all_around;
using testing::around_table;
using testing::both;
using testing::Shape;
using testing::small_lens;
using testing::snapshots;

constexpr double kRadius = 50.0;
constexpr double kDistance = 650.0;

double rms(const Mesh& mesh, const Shape& truth) {
  double sum = 0.0;
  for (const auto& vertex : mesh.vertices_mm) {
    const double error = truth(vertex.cast<double>());
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(mesh.vertices_mm.size()));
}

double volume_of(const Mesh& mesh) {
  double volume = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices_mm[t[0]].cast<double>();
    const Eigen::Vector3d b = mesh.vertices_mm[t[1]].cast<double>();
    volume += a.dot(b.cross(mesh.vertices_mm[t[2]].cast<double>())) / 6.0;
  }
  return volume;
}

/// How often each directed edge is used; in a manifold once, and once the other way unless at a
/// rim.
struct Edges {
  std::size_t repeated = 0;
  std::size_t open = 0;

  explicit Edges(const Mesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
    for (const auto& t : mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i)
        ++count[{t[i], t[(i + 1) % 3]}];
    }
    for (const auto& [edge, times] : count) {
      repeated += times > 1 ? 1U : 0U;
      open += count.count({edge.second, edge.first}) == 0 ? 1U : 0U;
    }
  }
};

TEST(PasteViews, MakesAClosedSphereMoreExactThanItsPoints) {
  const Mesh mesh = paste_views(
      snapshots(testing::sphere(kRadius), small_lens(), all_around(12, kDistance)), small_lens());
  const Edges edges(mesh);
  EXPECT_EQ(edges.repeated, 0U);
  EXPECT_EQ(edges.open, 0U);
  EXPECT_NEAR(volume_of(mesh) / (4.0 / 3.0 * kPi * std::pow(kRadius, 3)), 1.0, 1e-3);
  EXPECT_LT(rms(mesh, testing::sphere(kRadius)), 0.007);  // of points with 0.02 mm
}

TEST(PasteViews, StaysOpenWhereNothingWasSeen) {
  const Mesh mesh = paste_views(
      snapshots(testing::sphere(kRadius), small_lens(), around_table(6, 0.5, kDistance)),
      small_lens());
  const Edges edges(mesh);
  EXPECT_EQ(edges.repeated, 0U);
  EXPECT_GT(edges.open, 100U);
  EXPECT_LT(rms(mesh, testing::sphere(kRadius)), 0.01);
}

TEST(PasteViews, RefusesViewsWithoutAPoint) {
  View empty{{Image<float>(300, 300, kMissing), Image<float>(300, 300, kMissing)}, {}};
  ViewStore store;
  store.add(empty);
  EXPECT_THROW(static_cast<void>(paste_views(store, small_lens())), Error);
}

}  // namespace
}  // namespace frangia
