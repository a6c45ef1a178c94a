#include "frangia/inspect/edit_picture.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "frangia/editor/internal/select_by_geometry.h"
#include "frangia/geometry/selection.h"
#include "frangia/mesh/fill_holes.h"

#include "support/small_picture.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

RenderOptions square() {
  return testing::small_picture(80, 80);
}

/// More blue than red, unlike the magenta of the inside.
bool is_violet(const Rgb& color) {
  return color[2] > 1.4 * color[1] && color[0] > 1.2 * color[1] && color[2] > color[0];
}
bool is_blue(const Rgb& color) {
  return color[2] > 1.3 * color[0];
}

/// The number of pixels in the left or the right half that satisfy a predicate.
template <typename Is>
int count_in(const Image<Rgb>& picture, bool right, const Is& is) {
  int count = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = right ? picture.width() / 2 : 0; x < picture.width() / (right ? 1 : 2); ++x)
      count += is(picture(x, y)) ? 1 : 0;
  }
  return count;
}

TEST(EditPicture, ShowsRemovedTrianglesInVioletEvenAtTheBack) {
  const Mesh before = testing::sphere(Eigen::Vector3d::Zero(), 20.0, 30);
  for (const Eigen::Vector3d& place : {Eigen::Vector3d(20, 0, 0), Eigen::Vector3d(-20, 0, 0)}) {
    EditState after;
    after.mesh = delete_selected(before, select_by_ball(before, place, 9.0));
    const Image<Rgb> picture =
        edit_picture(before, after, edit_preview(before, after.mesh), square());
    EXPECT_GT(count_in(picture, false, is_violet), 200);
    EXPECT_EQ(count_in(picture, true, is_violet), 0);
  }
}

TEST(EditPicture, ShowsSynthesizedInBlueAndSelectedInViolet) {
  const Mesh whole = testing::sphere(Eigen::Vector3d::Zero(), 20.0, 30);
  const Mesh before = delete_selected(whole, select_by_ball(whole, {0, 20, 0}, 9.0));
  EditState after;
  after.mesh = fill_holes(before);
  const EditPreview preview = edit_preview(before, after.mesh);
  EXPECT_GT(count_in(edit_picture(before, after, preview, square()), true, is_blue), 200);
  after.selection = select_by_ball(after.mesh, {0, 20, 0}, 9.0);
  const Image<Rgb> picture = edit_picture(before, after, preview, square());
  EXPECT_GT(count_in(picture, true, is_violet), 200);
  EXPECT_EQ(count_in(picture, false, is_violet), 0);
}

}  // namespace
}  // namespace frangia
