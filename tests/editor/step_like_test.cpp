// The selection of what is like a triangle, on a bent sheet.
#include "frangia/editor/step_like.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "frangia/editor/edit_operation.h"

#include "support/error_of.h"

namespace frangia {
namespace {

/// A grid of 2 n by n cells of 1 mm, the left half level, the right half rising by 45 degrees.
Mesh roof(int n = 6) {
  Mesh mesh;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= 2 * n; ++x) {
      mesh.vertices_mm.emplace_back(
          static_cast<float>(x), static_cast<float>(y), static_cast<float>(std::max(0, x - n)));
    }
  }
  const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (2 * n + 1) + x); };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < 2 * n; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return mesh;
}

Selection like(const Mesh& mesh, std::size_t triangle, Likeness likeness) {
  EditState state{.mesh = mesh, .selection = {}};
  const EditStep step = step_like(mesh, triangle, likeness);
  check_step(step);
  edit_operation(step.operation).apply(state, step.value, {});
  return state.selection;
}

TEST(StepLike, TakesWhatFacesTheSameWay) {
  const Mesh mesh = roof();
  for (const std::size_t triangle : {std::size_t{0}, std::size_t{20}}) {
    const Selection found = like(mesh, triangle, Likeness::Normal);
    const bool left = triangle < 12;
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_EQ(found[i] == 1, (i / 2 % 12 < 6) == left) << i;
  }
}

TEST(StepLike, TakesWhatIsCurvedAsMuch) {
  const Mesh mesh = roof();
  const std::size_t at_the_bend = 2 * (12 * 2 + 6);
  const Selection found = like(mesh, at_the_bend, Likeness::Curvature);
  EXPECT_EQ(found[at_the_bend], 1);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::size_t column = i / 2 % 12;
    if (column < 5 || column > 6) {
      EXPECT_EQ(found[i], 0) << i;
    }
  }
  const auto at_the_boundary = [&] {
    Mesh alone;
    alone.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    alone.triangles = {{0, 1, 2}};
    static_cast<void>(step_like(alone, 0, Likeness::Curvature));
  };
  EXPECT_NE(testing::error_of(at_the_boundary).find("boundary"), std::string::npos);
}

TEST(StepLike, TakesWhatIsAsUncertainOrUnknown) {
  Mesh mesh = roof();
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), 0.01F);
  mesh.sigma_mm.back() = 0.05F;
  const std::size_t last = mesh.triangles.size() - 1;
  const Selection worse = like(mesh, last, Likeness::Sigma);
  EXPECT_EQ(worse[last], 1);
  EXPECT_EQ(std::accumulate(worse.begin(), worse.end(), 0), 2) << "the two at the last corner";
  for (const std::uint32_t vertex : mesh.triangles[0])
    mesh.sigma_mm[vertex] = std::numeric_limits<float>::quiet_NaN();
  const Selection unknown = like(mesh, 0, Likeness::Sigma);
  EXPECT_EQ(unknown[0], 1);
  EXPECT_EQ(unknown[last], 0);
  mesh.sigma_mm.clear();
  EXPECT_NE(testing::error_of([&] { static_cast<void>(step_like(mesh, 0, Likeness::Sigma)); }), "");
}

TEST(StepLike, TakesWhatHasTheSameMark) {
  Mesh mesh = roof();
  mesh.triangle_marks.assign(mesh.triangles.size(), Mark::Measured);
  mesh.triangle_marks[3] = mesh.triangle_marks[9] = Mark::Synthesized;
  const Selection found = like(mesh, 9, Likeness::Mark);
  EXPECT_EQ(std::accumulate(found.begin(), found.end(), 0), 2);
  EXPECT_EQ(found[3], 1);
  EXPECT_NE(testing::error_of(
                [&] { static_cast<void>(step_like(mesh, mesh.triangles.size(), Likeness::Mark)); }),
            "");
}

}  // namespace
}  // namespace frangia
