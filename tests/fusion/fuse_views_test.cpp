#include "frangia/fusion/fuse_views.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "support/analytic_views.h"
#include "support/mesh_checks.h"

namespace frangia {
namespace {

using testing::all_around;
using testing::around_table;
using testing::Edges;
using testing::Shape;
using testing::small_camera_model;
using testing::Snapshot;
using testing::snapshots;
using testing::VertexErrors;

constexpr double kDistance = 650.0;

/// A box rotated so that none of its edges is along the grid.
struct TurnedBox {
  Eigen::Vector3d half_mm{24.0, 20.0, 16.0};
  Eigen::Matrix3d box_from_object =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()).matrix();

  [[nodiscard]] Shape shape() const {
    return [box = testing::box(half_mm), turn = box_from_object](const Eigen::Vector3d& p) {
      return box(turn * p);
    };
  }
};

TEST(FuseViews, MakesAClosedSphereMoreAccurateThanItsPoints) {
  const Shape truth = testing::sphere(50.0);
  const Mesh mesh = fuse_views(snapshots(truth, small_camera_model(), all_around(12, kDistance)),
                               small_camera_model());
  const Edges edges(mesh);
  EXPECT_EQ(edges.repeated, 0U);
  EXPECT_EQ(edges.open, 0U);
  EXPECT_NEAR(testing::volume_mm3(mesh) / (4.0 / 3.0 * kPi * std::pow(50.0, 3)), 1.0, 1e-3);
  EXPECT_LT(VertexErrors(mesh, truth).rms_mm, 0.005);  // the points have a noise of 0.02 mm
}

TEST(FuseViews, LosesNoAccuracyWithVoxelsThatAreCoarserThanItsPixels) {
  // A pixel covers 0.22 mm: the field uses every third pixel, the vertices are placed with all.
  const Shape truth = testing::sphere(50.0);
  const CameraModel camera = small_camera_model(600, 3000.0);
  const ViewStore views = snapshots(truth, camera, all_around(8, kDistance));
  const Mesh fine = fuse_views(views, camera, {.voxel_mm = 0.3});
  const Mesh coarse = fuse_views(views, camera, {.voxel_mm = 0.6});
  EXPECT_EQ(Edges(coarse).repeated, 0U);
  EXPECT_LT(3 * coarse.triangles.size(), fine.triangles.size());
  EXPECT_LT(VertexErrors(coarse, truth).rms_mm, 1.1 * VertexErrors(fine, truth).rms_mm);
  EXPECT_LT(VertexErrors(coarse, truth).rms_sigmas, 1.25);
}

TEST(FuseViews, StaysOpenWhereNothingWasMeasured) {
  const Shape truth = testing::sphere(50.0);
  const Mesh mesh =
      fuse_views(snapshots(truth, small_camera_model(), around_table(6, 0.5, kDistance)),
                 small_camera_model());
  const Edges edges(mesh);
  EXPECT_EQ(edges.repeated, 0U);
  EXPECT_GT(edges.open, 100U);
  EXPECT_LT(VertexErrors(mesh, truth).rms_mm, 0.01);
}

TEST(FuseViews, ReachesTheEdgeOfTheDataWithinAPixelAndNotBeyond) {
  const double radius = 50.0;
  const double steepest = rad_from_deg(70.0);
  const Shape truth = testing::sphere(radius);
  const Mesh mesh = fuse_views(snapshots(truth,
                                         small_camera_model(),
                                         {testing::look_from(0.4, 0.9, kDistance)},
                                         {.steepest_rad = steepest}),
                               small_camera_model());
  // The cap that one view observes, extended by a number of pixels.
  const auto cap_mm2 = [&](double pixels) {
    const double pixel_rad = 1.0 / (1500.0 * std::cos(steepest)) * (kDistance - 20.0) / radius;
    const double from_camera = std::asin(radius * std::sin(steepest) / kDistance);
    return kTwoPi * radius * radius * (1.0 - std::cos(steepest - from_camera + pixels * pixel_rad));
  };
  double area_mm2 = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f& origin = mesh.vertices_mm[a];
    area_mm2 +=
        0.5 * static_cast<double>(
                  (mesh.vertices_mm[b] - origin).cross(mesh.vertices_mm[c] - origin).norm());
  }
  EXPECT_GT(area_mm2, cap_mm2(-1.0));
  EXPECT_LT(area_mm2, cap_mm2(0.5));
  EXPECT_LT(VertexErrors(mesh, truth).max_mm, 0.3);
}

TEST(FuseViews, KeepsTheEdgesOfABoxSharp) {
  const TurnedBox box;
  const double voxel_mm = 0.6;
  const Mesh mesh =
      fuse_views(snapshots(box.shape(), small_camera_model(), all_around(16, kDistance)),
                 small_camera_model(),
                 {.voxel_mm = voxel_mm});
  EXPECT_EQ(Edges(mesh).repeated, 0U);
  int near = 0;
  int all = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 4; ++side) {
      for (int step = 0; step < 32; ++step) {
        const double t = -0.95 + 0.06 * step;
        Eigen::Vector3d place(t, t, t);
        place[(axis + 1) % 3] = side % 2 == 0 ? -1.0 : 1.0;
        place[(axis + 2) % 3] = side / 2 == 0 ? -1.0 : 1.0;
        const Eigen::Vector3d edge =
            box.box_from_object.transpose() * place.cwiseProduct(box.half_mm);
        near += testing::mesh_distance(mesh, edge, 3.0 * voxel_mm) < 0.2 * voxel_mm ? 1 : 0;
        ++all;
      }
    }
  }
  // Marching cubes rounds edges off by a third of a voxel and more.
  EXPECT_GT(near, 0.95 * all) << near << " of " << all;
  // Sigma holds the errors at each distance from the edges.
  const std::vector<double> bands{0.25, 1.0, 2.5, 1e9};  // voxels
  std::vector<double> squares(bands.size(), 0.0);
  std::vector<double> counts(bands.size(), 0.0);
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    const Eigen::Vector3d point = box.box_from_object * mesh.vertices_mm[i].cast<double>();
    Eigen::Array3d off = (point.array().abs() - box.half_mm.array()).abs();
    std::sort(off.begin(), off.end());
    const double from_edge = std::hypot(off[0], off[1]) / voxel_mm;
    const auto band = static_cast<std::size_t>(
        std::upper_bound(bands.begin(), bands.end(), from_edge) - bands.begin());
    squares[band] += std::pow(
        box.shape()(mesh.vertices_mm[i].cast<double>()) / static_cast<double>(mesh.sigma_mm[i]), 2);
    counts[band] += 1.0;
  }
  for (std::size_t band = 0; band < bands.size(); ++band) {
    const double rms = std::sqrt(squares[band] / counts[band]);
    EXPECT_GT(counts[band], 100.0);
    EXPECT_LT(rms, 1.5) << "up to " << bands[band] << " voxels";
    // Next to an edge, fits of one side of a pixel are less certain than they prove to be here.
    EXPECT_GT(rms, bands[band] > 1.0 ? 0.5 : 0.2) << "up to " << bands[band] << " voxels";
  }
}

TEST(FuseViews, PredictsItsErrors) {
  const Shape truth = testing::sphere(50.0);
  const Mesh mesh = fuse_views(snapshots(truth, small_camera_model(), all_around(12, kDistance)),
                               small_camera_model());
  EXPECT_GT(VertexErrors(mesh, truth).rms_sigmas, 0.8);
  EXPECT_LT(VertexErrors(mesh, truth).rms_sigmas, 1.25);
}

TEST(FuseViews, KeepsTheErrorOfAWholeViewInItsSigma) {
  const Shape truth = testing::sphere(50.0);
  ViewStore views;
  Snapshot how;
  for (const auto& pose : all_around(12, kDistance)) {
    View view = testing::snapshot(truth, small_camera_model(), pose, how);
    const float off_mm = how.seed % 2 == 0 ? 0.03F : -0.03F;
    for (float& depth : view.range.depth_mm.pixels())
      depth += off_mm;
    views.add(view);
    ++how.seed;
  }
  const Mesh mesh = fuse_views(views, small_camera_model());
  EXPECT_GT(VertexErrors(mesh, truth).rms_sigmas, 0.6);
  EXPECT_LT(VertexErrors(mesh, truth).rms_sigmas, 1.4);
}

TEST(FuseViews, ConnectsNothingAcrossADepthStep) {
  const Shape scene =
      testing::both(testing::sphere(12.0, {0.0, 0.0, 20.0}), testing::floor_at(0.0));
  const Mesh mesh =
      fuse_views(snapshots(scene, small_camera_model(), around_table(6, 0.9, kDistance)),
                 small_camera_model());
  EXPECT_GT(mesh.triangles.size(), 10000U);
  EXPECT_LT(VertexErrors(mesh, scene).max_mm, 0.3);
}

TEST(FuseViews, RemovesAPatchInTheFreeSpaceOfOtherViews) {
  const Shape truth = testing::sphere(50.0);
  ViewStore views = snapshots(truth, small_camera_model(), all_around(12, kDistance));
  View wrong = views.load(0);
  for (int y = 120; y < 160; ++y) {
    for (int x = 120; x < 160; ++x)
      wrong.range.depth_mm(x, y) -= 4.0F;  // a wrong fringe order
  }
  views.replace(0, wrong);
  const Mesh mesh = fuse_views(views, small_camera_model());
  EXPECT_LT(VertexErrors(mesh, truth).max_mm, 0.3);
  EXPECT_EQ(Edges(mesh).open, 0U);
}

TEST(FuseViews, GivesTheSameBytesForAnyNumberOfThreads) {
  const ViewStore views =
      snapshots(TurnedBox{}.shape(), small_camera_model(), all_around(5, kDistance));
  const auto fuse = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return fuse_views(views, small_camera_model());
  };
  const Mesh one = fuse(1);
  const Mesh two = fuse(2);
  EXPECT_EQ(one.triangles, two.triangles);
  ASSERT_EQ(one.vertices_mm.size(), two.vertices_mm.size());
  EXPECT_EQ(std::memcmp(one.vertices_mm.data(),
                        two.vertices_mm.data(),
                        one.vertices_mm.size() * sizeof(one.vertices_mm[0])),
            0);
  EXPECT_EQ(one.sigma_mm, two.sigma_mm);
}

TEST(FuseViews, RefusesVoxelsThatDoNotFitAndNamesASizeThatDoes) {
  const ViewStore views =
      snapshots(testing::sphere(50.0), small_camera_model(), all_around(3, kDistance));
  double fits_mm = 0.0;
  try {
    static_cast<void>(
        fuse_views(views, small_camera_model(), {.voxel_mm = 0.05, .max_memory_mb = 100}));
    FAIL() << "0.05 mm voxels of a sphere of 50 mm do not fit into 100 MB";
  } catch (const Error& error) {
    const std::string what = error.what();
    ASSERT_NE(what.find("voxels of 0.05 mm need"), std::string::npos) << what;
    fits_mm = std::stod(what.substr(what.rfind("voxels of ") + 10));
  }
  EXPECT_GT(fits_mm, 0.2);
  const Mesh mesh =
      fuse_views(views, small_camera_model(), {.voxel_mm = fits_mm, .max_memory_mb = 100});
  EXPECT_GT(mesh.triangles.size(), 10000U);
}

TEST(FuseViews, RemovesSmallComponents) {
  const Shape scene = testing::both(testing::sphere(30.0), testing::sphere(4.0, {45.0, 0.0, 0.0}));
  const ViewStore views = snapshots(scene, small_camera_model(), all_around(8, kDistance));
  const auto farthest = [&](std::size_t min_component_triangles) {
    const Mesh mesh = fuse_views(
        views, small_camera_model(), {.min_component_triangles = min_component_triangles});
    float most = 0.0F;
    for (const auto& vertex : mesh.vertices_mm)
      most = std::max(most, vertex.x());
    return most;
  };
  EXPECT_GT(farthest(0), 48.0F);
  EXPECT_LT(farthest(2000), 31.0F);
}

TEST(FuseViews, ReportsTheVoxelSizeItDerived) {
  const ViewStore views =
      snapshots(testing::sphere(50.0), small_camera_model(), all_around(4, kDistance));
  std::vector<std::string> notes;
  frangia::Run run;
  run.on_note = [&](const std::string& note) { notes.push_back(note); };
  static_cast<void>(fuse_views(views, small_camera_model(), {}, run));
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(notes[0].find("sampled every"), std::string::npos) << notes[0];
}

TEST(FuseViews, RefusesViewsWithoutAPoint) {
  ViewStore views;
  views.add({{Image<float>(300, 300, kMissing), Image<float>(300, 300, kMissing)}, {}});
  EXPECT_THROW(static_cast<void>(fuse_views(views, small_camera_model())), Error);
}

}  // namespace
}  // namespace frangia
