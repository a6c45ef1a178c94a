// Undo and redo restore any operations on any mesh to the bit.
#include "frangia/editor/edit_history.h"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "frangia/core/error.h"
#include "frangia/core/random.h"
#include "frangia/editor/edit_script.h"
#include "frangia/editor/internal/select_by_geometry.h"
#include "frangia/geometry/selection.h"
#include "frangia/geometry/vertex_data.h"

#include "support/temporary_folder.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

/// A noisy ball with a hole, an island and all vertex data.
Mesh random_mesh(std::uint64_t seed) {
  Mesh mesh = testing::sphere({0, 0, 0}, 10.0, 8 + static_cast<int>(hash(seed, 1) % 5));
  append_mesh(mesh, testing::sphere({25, 0, 0}, 1.0 + uniform_from(hash(seed, 2)), 4));
  for (std::uint64_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    mesh.vertices_mm[i] *= static_cast<float>(1.0 + 0.02 * normal_from(hash(hash(seed, 3), i)));
    mesh.sigma_mm.push_back(static_cast<float>(0.2 * uniform_from(hash(hash(seed, 4), i))));
    mesh.views.push_back(static_cast<std::uint16_t>(hash(hash(seed, 5), i) % 9));
  }
  if (hash(seed, 7) % 2 == 0) {
    ensure_sigma_parts(mesh);
    for (float& systematic : mesh.sigma_systematic_mm)
      systematic = static_cast<float>(0.1 * uniform_from(hash(seed, 8)));
    combine_sigma_parts(mesh);
  }
  mesh.normals = vertex_normals(mesh);
  const float side = hash(seed, 6) % 2 == 0 ? 10.0F : -10.0F;
  return delete_selected(mesh, select_by_ball(mesh, {side, 0, 0}, 3.0));
}

/// One of many operations with a sensible value.
EditStep random_step(std::uint64_t seed) {
  static const std::vector<EditStep> kSteps{
      {"remove-islands", "4mm"},
      {"keep-largest", "1"},
      {"fill-holes-flat", "8mm"},
      {"fill-hole-flat", "0"},
      {"fill-holes", "8mm"},
      {"fill-hole", "0"},
      {"remesh", "2mm"},
      {"remove-self-intersections", ""},
      {"align", "0,0,9,0,9,0,9,0,0"},
      {"remove-spikes", ""},
      {"smooth", "3"},
      {"smooth-keeping-edges", "2"},
      {"max-sigmas", "0"},
      {"decimate-to", "150"},
      {"decimate", "0.3mm"},
      {"offset", "0.1mm"},
      {"cut", "0,0.2,1,-4mm"},
      {"cut-capped", "1,0,0,-3mm"},
      {"mirror", "1,2,3,1"},
      {"orient", ""},
      {"reverse-orientation", ""},
      {"make-manifold", ""},
      {"stitch", "0.01mm"},
      {"select-box", "-5,-5,-5,5,5,20"},
      {"select-normal", "0,0,1,40deg"},
      {"select-views", "3"},
      {"select-ball", "9,0,0,4"},
      {"select-outline", "0,0,90,-5,-5,9,5,-5,9,0,5,9"},
      {"select-outline-through", "90,0,0,9,-5,-5,9,5,-5,9,0,5"},
      {"select-plane", "0,0,1,2"},
      {"select-face", "0,0,9"},
      {"select-component", "1"},
      {"select-loop", "0"},
      {"select-curvature", "0.2"},
      {"select-sigma", "0.1mm"},
      {"select-self-intersections", ""},
      {"shrink", "1"},
      {"select-mark", "synthesized"},
      {"add", ""},
      {"within", ""},
      {"without", ""},
      {"grow", "1"},
      {"invert", ""},
      {"delete", ""},
      {"bridge", "0,1"}};
  return kSteps[seed % kSteps.size()];
}

/// Applies steps; those that do not fit the mesh must leave it unchanged.
void apply_steps(EditHistory& history, const std::vector<std::uint64_t>& seeds) {
  for (const std::uint64_t seed : seeds) {
    const EditState before = history.state();
    try {
      history.apply(random_step(seed));
    } catch (const Error& error) {
      RC_ASSERT(error.kind() == ErrorKind::Input);
      RC_ASSERT(history.state() == before);
    }
  }
}

RC_GTEST_PROP(EditHistory, UndoesAndRedoesAnyOperationsToTheBit, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const auto seeds = *rc::gen::container<std::vector<std::uint64_t>>(
      8, rc::gen::inRange<std::uint64_t>(0, 1'000'000));
  EditHistory history(random_mesh(seed));
  std::vector<EditState> states{history.state()};
  for (const std::uint64_t one : seeds) {
    apply_steps(history, {one});
    if (history.done() == states.size()) states.push_back(history.state());
  }
  for (std::size_t i = states.size(); i-- > 1;) {
    RC_ASSERT(history.state() == states[i]);
    RC_ASSERT(history.undo());
  }
  RC_ASSERT(history.state() == states[0]);
  RC_ASSERT(!history.undo());
  for (std::size_t i = 1; i < states.size(); ++i) {
    RC_ASSERT(history.redo());
    RC_ASSERT(history.state() == states[i]);
  }
  RC_ASSERT(!history.redo());
}

RC_GTEST_PROP(EditHistory, ReplaysItsStepsToTheSameBytes, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const auto seeds = *rc::gen::container<std::vector<std::uint64_t>>(
      6, rc::gen::inRange<std::uint64_t>(0, 1'000'000));
  EditHistory history(random_mesh(seed));
  apply_steps(history, seeds);
  const testing::TemporaryFolder folder;
  write_edit_script(folder.path() / "h.json", {history.steps(), history.done()});
  const EditScript script = read_edit_script(folder.path() / "h.json");
  RC_ASSERT(script.steps == history.steps());
  EditHistory again(random_mesh(seed));
  for (const EditStep& step : script.steps)
    again.apply(step);
  RC_ASSERT(again.state() == history.state());
}

TEST(EditHistory, IsTestedWithEveryOperation) {
  for (const EditOperation& operation : edit_operations()) {
    bool tested = false;
    for (std::uint64_t seed = 0; seed < 100; ++seed)
      tested = tested || random_step(seed).operation == operation.name;
    EXPECT_TRUE(tested) << operation.name;
  }
}

/// Meshes with the faults of damaged files and other programs.
std::vector<Mesh> broken_meshes() {
  Mesh flat;  // collinear vertices
  flat.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}};
  flat.triangles = {{0, 1, 2}, {0, 0, 1}, {0, 3, 1}};
  Mesh book = random_mesh(1);  // several triangles at one edge, one of them twice
  const auto first = static_cast<std::uint32_t>(book.vertices_mm.size());
  book.sigma_mm = {};
  book.views = {};
  book.normals = {};
  for (const float x : {0.0F, 5.0F, -5.0F, 0.0F, 0.0F}) {
    const auto i = static_cast<std::uint32_t>(book.vertices_mm.size()) - first;
    book.vertices_mm.emplace_back(x, i < 3 ? 1.0F : -1.0F, i == 0 ? 30.0F : 20.0F);
    if (i >= 2) book.triangles.push_back({first, first + 1, first + i});
  }
  book.triangles.push_back(book.triangles.back());
  book.triangles.push_back({first + 2, first + 1, first});
  Mesh dot;
  dot.vertices_mm = {{0, 0, 0}};
  Mesh parts;
  for (int i = 0; i < 100; ++i) {
    append_mesh(parts,
                testing::box({2.0F * static_cast<float>(i), 0, 0},
                             {2.0F * static_cast<float>(i) + 1.0F, 1, 1}));
  }
  return {Mesh(), dot, flat, book, parts};
}

TEST(EditOperations, MakeValidMeshesOfBrokenOnesOrRefuseThem) {
  for (const Mesh& mesh : broken_meshes()) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      const EditStep step = random_step(seed);
      if (seed > 0 && step == random_step(0)) break;
      EditState state{.mesh = mesh, .selection = Selection(mesh.triangles.size(), 1)};
      try {
        apply_step(state, step);
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input) << step.operation;
        continue;
      }
      const auto count = state.mesh.vertices_mm.size();
      for (const auto& triangle : state.mesh.triangles) {
        for (const std::uint32_t vertex : triangle)
          ASSERT_LT(vertex, count) << step.operation;
      }
      for (const auto& vertex : state.mesh.vertices_mm)
        ASSERT_TRUE(vertex.allFinite()) << step.operation;
    }
  }
}

TEST(EditHistory, DropsUndoneStepsWhenAnotherStepFollows) {
  EditHistory history(random_mesh(1));
  history.apply({"offset", "0.1mm"});
  history.apply({"orient", ""});
  EXPECT_TRUE(history.undo());
  history.apply({"reverse-orientation", ""});
  EXPECT_FALSE(history.redo());
  EXPECT_EQ(history.steps().size(), 2U);
  EXPECT_EQ(history.steps()[1].operation, "reverse-orientation");
}

TEST(EditHistory, WorksOutTheNextStateAndKeepsThePresentOne) {
  EditHistory history(random_mesh(1));
  history.apply({"offset", "0.1mm"});
  history.apply({"orient", ""});
  EXPECT_TRUE(history.undo());
  const EditState before = history.state();
  const EditHistory next = history.applied({"reverse-orientation", ""});
  const EditHistory redone = history.redone();
  const EditHistory undone = history.undone();
  EXPECT_TRUE(history.state() == before);
  EXPECT_EQ(history.steps().size(), 2U) << "the undone step can be done again";
  EXPECT_EQ(next.steps()[1].operation, "reverse-orientation");
  EXPECT_EQ(redone.done(), 2U);
  EXPECT_EQ(undone.done(), 0U);
  history.apply({"reverse-orientation", ""});
  EXPECT_TRUE(history.state() == next.state());
}

TEST(EditHistory, StoresOnlyWhatChanged) {
  EditHistory history(testing::sphere({0, 0, 0}, 10.0, 60));
  history.apply({"select-ball", "10,0,0,1"});
  history.apply({"smooth", "1"});
  const std::size_t all = history.mesh().vertices_mm.size() * 12;
  EXPECT_LT(history.bytes(), all);
}

}  // namespace
}  // namespace frangia
