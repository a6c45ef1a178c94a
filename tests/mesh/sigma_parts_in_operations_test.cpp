// Every operation that makes new vertices gives them both parts of sigma.
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/mesh/cut_by_plane.h"
#include "frangia/mesh/decimate.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/make_manifold.h"
#include "frangia/mesh/offset_mesh.h"
#include "frangia/mesh/remesh_isotropic.h"
#include "frangia/mesh/smooth.h"
#include "frangia/mesh/stitch.h"

#include "mesh/ball_meshes.h"

namespace frangia {
namespace {

/// A ball with a hole whose noise and systematic part differ by a factor of four.
Mesh measured_ball() {
  Mesh mesh = testing::holed_ball();
  mesh.normals = vertex_normals(mesh);
  mesh.sigma_noise_mm.assign(mesh.vertices_mm.size(), 0.03F);
  mesh.sigma_systematic_mm.assign(mesh.vertices_mm.size(), 0.12F);
  combine_sigma_parts(mesh);
  return mesh;
}

TEST(SigmaParts, ArePassedOnByEveryOperation) {
  const Eigen::Hyperplane<double, 3> plane(Eigen::Vector3d::UnitZ(), 3.0);
  const std::vector<std::pair<std::string, std::function<Mesh(Mesh)>>> operations{
      {"decimate", [](Mesh mesh) { return decimate(std::move(mesh), {.triangles = 300}); }},
      {"fill_holes", [](Mesh mesh) { return fill_holes(std::move(mesh), {}); }},
      {"fill_holes flat",
       [](Mesh mesh) { return fill_holes(std::move(mesh), {.kind = HoleFill::Flat}); }},
      {"cut_by_plane",
       [&](Mesh mesh) { return cut_by_plane(std::move(mesh), plane, {.capped = true}); }},
      {"remesh_isotropic",
       [](Mesh mesh) { return remesh_isotropic(std::move(mesh), {.edge_mm = 3.0}); }},
      {"offset_mesh", [](Mesh mesh) { return offset_mesh(std::move(mesh), 0.5); }},
      {"smooth_taubin",
       [](Mesh mesh) { return smooth_taubin(std::move(mesh), {.iterations = 3}); }},
      {"stitch", [](Mesh mesh) { return stitch(std::move(mesh), 1e-5); }},
      {"make_manifold", [](Mesh mesh) { return make_manifold(std::move(mesh)); }}};
  for (const auto& [name, operation] : operations) {
    const Mesh mesh = operation(measured_ball());
    ASSERT_FALSE(mesh.empty()) << name;
    ASSERT_EQ(mesh.sigma_noise_mm.size(), mesh.vertices_mm.size()) << name;
    ASSERT_EQ(mesh.sigma_systematic_mm.size(), mesh.vertices_mm.size()) << name;
    for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
      if (std::isnan(mesh.sigma_mm[i])) continue;  // a vertex without a measured neighbour
      EXPECT_NEAR(mesh.sigma_noise_mm[i], 0.03F, 1e-4F) << name;
      EXPECT_NEAR(mesh.sigma_systematic_mm[i], 0.12F, 1e-4F) << name;
      EXPECT_NEAR(mesh.sigma_mm[i], std::hypot(0.03F, 0.12F), 1e-4F) << name;
    }
  }
}

TEST(SigmaParts, LimitSmoothingToTheNoise) {
  Mesh mesh = testing::noisy(testing::even_ball(), 0.05);
  mesh.sigma_noise_mm.assign(mesh.vertices_mm.size(), 0.01F);
  mesh.sigma_systematic_mm.assign(mesh.vertices_mm.size(), 1.0F);
  combine_sigma_parts(mesh);
  const Mesh after = smooth_taubin(mesh, {.iterations = 20, .max_sigmas = 3.0});
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i)
    EXPECT_LE((after.vertices_mm[i] - mesh.vertices_mm[i]).norm(), 0.0301F);
}

}  // namespace
}  // namespace frangia
