#include <cmath>

#include <gtest/gtest.h>

#include "frangia/editor/edit_operation.h"
#include "frangia/editor/internal/select_by_geometry.h"
#include "frangia/geometry/vertex_data.h"

#include "support/error_of.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

using testing::error_of;

Eigen::Vector3d centroid_of(const Mesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (mesh.vertices_mm[a] + mesh.vertices_mm[b] + mesh.vertices_mm[c]).cast<double>() / 3.0;
}

TEST(SelectByOutline, SeesTheNearSideOfASphereWithinACone) {
  const Mesh ball = testing::sphere({0, 0, 0}, 10.0, 60);
  const double eye = 100.0;
  ViewedOutline circle{.eye_mm = {0, 0, eye}, .corners_mm = {}};
  for (int i = 0; i < 720; ++i) {
    const double angle = 2.0 * M_PI * i / 720.0;
    circle.corners_mm.emplace_back(5.0 * std::cos(angle), 5.0 * std::sin(angle), 0.0);
  }
  const Selection visible = select_by_outline(ball, circle, true);
  const Selection through = select_by_outline(ball, circle, false);
  for (std::size_t i = 0; i < visible.size(); ++i) {
    const Eigen::Vector3d p = centroid_of(ball, i);
    const double slope = std::hypot(p.x(), p.y()) / (eye - p.z());
    if (std::abs(slope - 0.05) < 1e-3) continue;  // on the polygon's edge
    EXPECT_EQ(through[i], slope < 0.05 ? 1 : 0);
    EXPECT_EQ(visible[i], slope < 0.05 && p.z() > 0.0 ? 1 : 0);
  }
  EXPECT_GT(count_selected(visible), 100U);
}

TEST(SelectByOutline, LeavesWhatAnotherPartHides) {
  Mesh scene = testing::box({-1, -1, 0}, {1, 1, 1});
  const std::size_t near = scene.triangles.size();
  append_mesh(scene, testing::box({-3, -3, 10}, {3, 3, 11}));
  const ViewedOutline wide{.eye_mm = {0, 0, 50},
                           .corners_mm = {{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}};
  const Selection visible = select_by_outline(scene, wide, true);
  for (std::size_t i = 0; i < near; ++i)
    EXPECT_EQ(visible[i], 0) << i;
  EXPECT_EQ(count_selected(visible), 2U);  // the two triangles of the near box's top
}

TEST(SelectByOutline, LeavesWhatATriangleWithCornersFarFromTheOutlineHides) {
  Mesh scene = testing::box({-1, -1, 0}, {1, 1, 1});
  const ViewedOutline small{
      .eye_mm = {0, 0, 50},
      .corners_mm = {{-0.9, -0.9, 1}, {0.9, -0.9, 1}, {0.9, 0.9, 1}, {-0.9, 0.9, 1}}};
  ASSERT_EQ(count_selected(select_by_outline(scene, small, true)), 2U);
  // It passes below the eye at z = 14.8; one of its corners is behind the eye.
  Mesh sail;
  sail.vertices_mm = {{-50, -20, 10}, {50, -20, 10}, {0, 400, 110}};
  sail.triangles = {{0, 2, 1}};
  append_mesh(scene, sail);
  EXPECT_EQ(count_selected(select_by_outline(scene, small, true)), 0U);
}

TEST(SelectByOutline, KeepsItsAnswerAtTenTimesTheSize) {
  Mesh ball = testing::sphere({3, 1, 2}, 10.0, 30);
  ViewedOutline lasso{.eye_mm = {60, 10, 30}, .corners_mm = {{5, 5, 0}, {5, -5, 2}, {4, -2, 9}}};
  const Selection small = select_by_outline(ball, lasso, true);
  for (auto& vertex : ball.vertices_mm)
    vertex *= 10.0F;
  lasso.eye_mm *= 10.0;
  for (auto& corner : lasso.corners_mm)
    corner *= 10.0;
  EXPECT_EQ(select_by_outline(ball, lasso, true), small);
  EXPECT_GT(count_selected(small), 0U);
}

TEST(SelectByOutline, RefusesAnOutlineAroundTheEye) {
  const Mesh ball = testing::sphere({0, 0, 0}, 1.0, 8);
  const ViewedOutline around{.eye_mm = {0, 0, 0},
                             .corners_mm = {{1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}}};
  EXPECT_NE(error_of([&] { static_cast<void>(select_by_outline(ball, around, true)); }), "");
}

TEST(SelectByOutline, NamesWhatIsWrongWithAValue) {
  const auto refusal = [](const std::string& value) {
    return error_of([&] { check_step({"select-outline", value}); });
  };
  EXPECT_EQ(refusal("0,0,9,1,0,0,0,1,0,0,0,0"), "");
  for (const std::string value : {"", "0,0,9", "0,0,9,1,0,0,0,1,0", "0,0,9,1,0,0,0,1,0,0,0", "x"})
    EXPECT_NE(refusal(value).find("point of view"), std::string::npos) << value;
  std::string endless = "0,0,9";
  for (int i = 0; i < 5000; ++i)
    endless += ",1,2,3";
  EXPECT_NE(refusal(endless).find("4096"), std::string::npos);
}

}  // namespace
}  // namespace frangia
