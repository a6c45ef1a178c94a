#include "frangia/mesh/smooth.h"

#include <cstddef>

#include <gtest/gtest.h>

#include "ball_meshes.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using testing::even_ball;
using testing::noisy;
using testing::rms_from_ball;

TEST(Smooth, HalvesTheNoiseOfASphereWithinThreeSigma) {
  const Mesh mesh = noisy(even_ball(), 0.05);
  for (const Mesh& smooth : {smooth_taubin(mesh), smooth_keeping_edges(mesh)}) {
    EXPECT_LT(rms_from_ball(smooth), 0.5 * rms_from_ball(mesh));
    for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i)
      ASSERT_LE((smooth.vertices_mm[i] - mesh.vertices_mm[i]).norm(), 0.1501F);
  }
}

TEST(Smooth, MarksExactlyTheVerticesDisplacedBeyondTheirSigma) {
  const Mesh mesh = noisy(even_ball(), 0.05);
  const Mesh smooth = smooth_taubin(mesh);
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    const bool is_displaced = (smooth.vertices_mm[i] - mesh.vertices_mm[i]).norm() > 0.05F;
    ASSERT_EQ(smooth.vertex_marks[i] == Mark::Displaced, is_displaced);
  }
}

}  // namespace
}  // namespace frangia
