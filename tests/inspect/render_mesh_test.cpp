#include "frangia/inspect/render_mesh.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/small_picture.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

RenderOptions small() {
  return testing::small_picture(80, 60);
}

bool is_red(const Rgb& color) {
  return color[0] > 1.5 * color[1] && color[0] > 1.5 * color[2];
}

TEST(RenderMesh, FitsThePartIntoThePicture) {
  RenderOptions options = small();
  options.ground = false;
  for (const bool perspective : {true, false}) {
    options.perspective = perspective;
    const Image<Rgb> picture = render_mesh(testing::box({-30, -20, 0}, {30, 20, 90}), options);
    // The rim of the picture is backdrop, and the part's height fills nearly all of the rest.
    const Image<Rgb> flat = render_mesh(testing::box({-50, -50, 0}, {50, 50, 1}), options);
    for (int x = 0; x < 80; ++x) {
      EXPECT_EQ(picture(x, 0), flat(x, 0));
      EXPECT_EQ(picture(x, 59), flat(x, 59));
    }
    int differ = 0;
    for (int x = 0; x < 80; ++x)
      differ += picture(x, 7) != flat(x, 7) ? 1 : 0;
    EXPECT_GT(differ, 0);
  }
}

TEST(RenderMesh, ShowsTheInsideInRedThroughAHole) {
  Mesh open = testing::box({-30, -30, 0}, {30, 30, 60});
  const Image<Rgb> whole = render_mesh(open, small());
  EXPECT_TRUE(std::none_of(whole.pixels().begin(), whole.pixels().end(), is_red));
  // The top is two triangles; without them one looks in from above.
  open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);
  const Image<Rgb> holed = render_mesh(open, small());
  EXPECT_GT(std::count_if(holed.pixels().begin(), holed.pixels().end(), is_red), 50);
}

TEST(RenderMesh, ShowsValuesAsColours) {
  const Mesh mesh = testing::box({-30, -30, 0}, {30, 30, 60});
  RenderOptions options = small();
  options.color_map = ColorMap::Diverging;
  options.value_min = -1.0F;
  options.value_max = 1.0F;
  options.values.assign(8, -1.0F);
  const Rgb blue = render_mesh(mesh, options)(40, 35);
  EXPECT_GT(blue[2], blue[0]);
  options.values.assign(8, 1.0F);
  const Rgb red = render_mesh(mesh, options)(40, 35);
  EXPECT_GT(red[0], red[2]);
}

TEST(RenderMesh, RefusesWhatItCannotShow) {
  const Mesh mesh = testing::box({0, 0, 0}, {1, 1, 1});
  RenderOptions options = small();
  options.values.assign(3, 0.0F);
  EXPECT_THROW(static_cast<void>(render_mesh(Mesh{})), Error);
  EXPECT_THROW(static_cast<void>(render_mesh(mesh, options)), Error);
  options.values.clear();
  options.width_px = 0;
  EXPECT_THROW(static_cast<void>(render_mesh(mesh, options)), Error);
}

}  // namespace
}  // namespace frangia
