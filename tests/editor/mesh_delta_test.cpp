#include <cstdint>

#include <gtest/gtest.h>

#include "frangia/editor/edit_history.h"

namespace frangia {
namespace {

/// A state in which every array has values.
EditState full_state(std::size_t vertices) {
  EditState state;
  Mesh& mesh = state.mesh;
  for (std::size_t i = 0; i < vertices; ++i) {
    const auto value = static_cast<float>(i);
    mesh.vertices_mm.emplace_back(value, 0.5F * value, -value);
    mesh.normals.push_back(Eigen::Vector3f::UnitX());
    mesh.sigma_mm.push_back(0.01F * value);
    mesh.sigma_noise_mm.push_back(0.02F * value);
    mesh.sigma_systematic_mm.push_back(0.03F * value);
    mesh.views.push_back(static_cast<decltype(mesh.views)::value_type>(i % 7));
    mesh.vertex_marks.push_back({});
    mesh.colors.push_back({});
    mesh.triangles.push_back({static_cast<std::uint32_t>(i), 0, 1});
    mesh.triangle_marks.push_back({});
    state.selection.push_back(0);
  }
  return state;
}

void expect_both_ways(const EditState& before, const EditState& after) {
  const MeshDelta delta(before, after);
  EditState state = after;
  delta.undo(state);
  EXPECT_TRUE(state == before);
  delta.redo(state);
  EXPECT_TRUE(state == after);
}

TEST(MeshDelta, RestoresEitherStateOfEachArray) {
  const EditState before = full_state(1000);
  EditState after = before;
  after.mesh.vertices_mm[0].x() = 7.0F;
  after.mesh.vertices_mm[999].z() = 8.0F;
  after.mesh.triangles[500] = {3, 2, 1};
  after.mesh.normals[20] = Eigen::Vector3f::UnitZ();
  after.mesh.sigma_mm[1] = 5.0F;
  after.mesh.sigma_noise_mm[2] = 6.0F;
  after.mesh.sigma_systematic_mm[3] = 7.0F;
  after.mesh.views[4] = 9;
  after.selection[5] = 1;
  after.max_sigmas = before.max_sigmas + 1.0;
  expect_both_ways(before, after);
}

TEST(MeshDelta, RestoresArraysOfAnotherLength) {
  const EditState before = full_state(1000);
  EditState after = full_state(700);
  after.mesh.vertices_mm[600].x() = -1.0F;
  expect_both_ways(before, after);
  expect_both_ways(after, before);
  EditState grown = before;
  grown.mesh.vertices_mm.emplace_back(1.0F, 2.0F, 3.0F);
  expect_both_ways(before, grown);
  expect_both_ways(EditState{}, before);
  expect_both_ways(before, EditState{});
}

TEST(MeshDelta, StoresOnlyTheBlocksThatDiffer) {
  const EditState before = full_state(1000);
  EXPECT_EQ(MeshDelta(before, before).bytes(), 0U);
  EditState after = before;
  after.mesh.sigma_mm[100] = 3.0F;  // in the second block of 256 bytes
  EXPECT_EQ(MeshDelta(before, after).bytes(), 2U * 256U);
  after.mesh.sigma_mm[130] = 3.0F;  // in the third
  EXPECT_EQ(MeshDelta(before, after).bytes(), 2U * 512U);
  after.mesh.sigma_mm[999] = 3.0F;  // in the last, of 4000 - 15 * 256 bytes
  EXPECT_EQ(MeshDelta(before, after).bytes(), 2U * (512U + 160U));
  EditState shorter = before;
  shorter.mesh.sigma_mm.resize(990);
  EXPECT_EQ(MeshDelta(before, shorter).bytes(), 10U * sizeof(float))
      << "the common part is left out";
}

}  // namespace
}  // namespace frangia
