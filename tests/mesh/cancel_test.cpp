// Every operation ends with Error(Cancelled) when its Run is stopped.
#include <functional>
#include <stop_token>
#include <utility>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/mesh/bridge_loops.h"
#include "frangia/mesh/cut_by_plane.h"
#include "frangia/mesh/decimate.h"
#include "frangia/mesh/fill_holes.h"
#include "frangia/mesh/internal/unite_bodies.h"
#include "frangia/mesh/make_manifold.h"
#include "frangia/mesh/mesh_findings.h"
#include "frangia/mesh/offset_mesh.h"
#include "frangia/mesh/orient.h"
#include "frangia/mesh/remesh_isotropic.h"
#include "frangia/mesh/remove_spikes.h"
#include "frangia/mesh/self_intersections.h"
#include "frangia/mesh/smooth.h"
#include "frangia/mesh/stitch.h"

#include "ball_meshes.h"

namespace frangia {
namespace {

TEST(Cancel, EndsEveryOperation) {
  std::stop_source source;
  source.request_stop();
  frangia::Run run;
  run.stop = source.get_token();
  const Mesh mesh = testing::holed_ball();
  const Mesh two_holes =
      delete_selected(mesh, select_by_ball(mesh, {-testing::kBallRadius, 0.0, 0.0}, 5.0));
  const Eigen::Hyperplane<double, 3> plane(Eigen::Vector3d::UnitZ(), 0.0);
  const std::vector<std::pair<const char*, std::function<void()>>> operations{
      {"bridge", [&] { static_cast<void>(bridge_loops(two_holes, 0, 1, run)); }},
      {"cut", [&] { static_cast<void>(cut_by_plane(mesh, plane, {.capped = true}, run)); }},
      {"decimate to", [&] { static_cast<void>(decimate(mesh, {.triangles = 100}, run)); }},
      {"decimate", [&] { static_cast<void>(decimate(mesh, {.tolerance_mm = 0.1}, run)); }},
      {"fill", [&] { static_cast<void>(fill_holes(mesh, {}, run)); }},
      {"fill flat", [&] { static_cast<void>(fill_holes(mesh, {.kind = HoleFill::Flat}, run)); }},
      {"make manifold", [&] { static_cast<void>(make_manifold(mesh, run)); }},
      {"findings", [&] { static_cast<void>(mesh_findings(mesh, run)); }},
      {"offset", [&] { static_cast<void>(offset_mesh(mesh, 1.0, run)); }},
      {"orient", [&] { static_cast<void>(orient(mesh, run)); }},
      {"remesh", [&] { static_cast<void>(remesh_isotropic(mesh, {}, run)); }},
      {"intersections", [&] { static_cast<void>(remove_self_intersections(mesh, run)); }},
      {"spikes", [&] { static_cast<void>(remove_spikes(mesh, {}, run)); }},
      {"smooth", [&] { static_cast<void>(smooth_taubin(mesh, {}, run)); }},
      {"keep edges", [&] { static_cast<void>(smooth_keeping_edges(mesh, {}, run)); }},
      {"stitch", [&] { static_cast<void>(stitch(mesh, 0.1, run)); }},
      {"unite", [&] { static_cast<void>(unite_bodies(testing::ball(), testing::ball(), run)); }}};
  for (const auto& [name, operation] : operations) {
    try {
      operation();
      ADD_FAILURE() << name << " ignored the request to stop";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Cancelled) << name << ": " << error.what();
    }
  }
}

TEST(RemeshIsotropic, RefusesTooManyTrianglesAndNamesALengthThatFits) {
  const Mesh mesh = testing::ball();  // 5024 mm2
  EXPECT_NEAR(estimate_remeshed_triangles(mesh, 1.0), 11'600.0, 120.0);
  try {
    static_cast<void>(remesh_isotropic(mesh, {.edge_mm = 0.001}));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Input);
    const std::string message = error.what();
    EXPECT_NE(message.find("million triangles, more than 10 million"), std::string::npos)
        << message;
    EXPECT_NE(message.find("edges of 0.035 mm or longer"), std::string::npos) << message;
  }
}

TEST(Decimate, RefusesToRunWithoutACountOrATolerance) {
  EXPECT_THROW(static_cast<void>(decimate(testing::ball(), {})), Error);
}

}  // namespace
}  // namespace frangia
