#include "frangia/inspect/render_mesh.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/inspect/internal/shading.h"

#include "support/small_picture.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

RenderOptions small() {
  return testing::small_picture(80, 60);
}

bool is_magenta(const Rgb& color) {
  return color[0] > 1.5 * color[1] && color[2] > 1.5 * color[1];
}

/// The angle between two colors in linear light, which does not depend on their brightness.
double chromaticity_angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return deg_from_rad(std::acos(std::min(1.0, a.normalized().dot(b.normalized()))));
}

TEST(RenderMesh, FitsThePartIntoThePicture) {
  RenderOptions options = small();
  options.ground = false;
  for (const bool perspective : {true, false}) {
    options.perspective = perspective;
    const Image<Rgb> picture = render_mesh(testing::box({-30, -20, 0}, {30, 20, 90}), options);
    // The top and bottom rows show the background; the part fills nearly all of the rest.
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

TEST(RenderMesh, ShowsTheInsideInAColorOfNoMap) {
  for (const ColorMap map : {ColorMap::Gray, ColorMap::Viridis, ColorMap::Diverging}) {
    for (int i = 0; i <= 1000; ++i) {
      const Eigen::Vector3d color =
          color_of(map, static_cast<float>(i) / 1000.0F).cast<double>().array().pow(2.2);
      if (color.norm() == 0.0) continue;
      EXPECT_GT(chromaticity_angle_deg(inside_color(), color), 20.0) << i;
    }
  }
}

TEST(RenderMesh, ShowsTheInsideThroughAHole) {
  Mesh open = testing::box({-30, -30, 0}, {30, 30, 60});
  const Image<Rgb> whole = render_mesh(open, small());
  EXPECT_TRUE(std::none_of(whole.pixels().begin(), whole.pixels().end(), is_magenta));
  // Without the two triangles of the top, the inside is visible from above.
  open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);
  const Image<Rgb> holed = render_mesh(open, small());
  EXPECT_GT(std::count_if(holed.pixels().begin(), holed.pixels().end(), is_magenta), 50);
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

std::vector<std::string> meanings(const Mesh& mesh, const RenderOptions& options) {
  std::vector<std::string> found;
  for (const LegendEntry& entry : surface_legend(mesh, options).entries)
    found.push_back(entry.meaning);
  return found;
}

TEST(RenderMesh, ExplainsTheColorsThatOccurInItsLegend) {
  using Meanings = std::vector<std::string>;
  Mesh mesh = testing::box({-30, -30, 0}, {30, 30, 60});
  RenderOptions options;
  EXPECT_EQ(meanings(mesh, options), Meanings());
  options.show_marks = true;
  mesh.triangle_marks.assign(mesh.triangles.size(), Mark::Measured);
  mesh.triangle_marks[4] = Mark::Synthesized;
  EXPECT_EQ(meanings(mesh, options), (Meanings{"measured", "synthesized"}));
  options.highlighted.assign(mesh.triangles.size(), 0);
  options.highlighted[1] = 1;
  EXPECT_EQ(meanings(mesh, options), (Meanings{"measured", "synthesized", "selected"}));
  options = {};
  options.values.assign(8, 0.5F);
  EXPECT_EQ(surface_legend(mesh, options).scales.size(), 1U);
  options.values[3] = kMissing;
  mesh.triangles.pop_back();
  EXPECT_EQ(meanings(mesh, options), (Meanings{"no value", "inside"}));
}

TEST(RenderMesh, AddsTheLegendBesideThePicture) {
  const Mesh mesh = testing::box({-30, -30, 0}, {30, 30, 60});
  RenderOptions options = small();
  options.values.assign(8, 0.5F);
  options.value_label = "deviation, mm";
  const Image<Rgb> bare = render_mesh(mesh, options);
  options.legend = true;
  const Image<Rgb> both = render_mesh(mesh, options);
  EXPECT_EQ(both.height(), bare.height());
  EXPECT_GT(both.width(), bare.width());
  for (int y = 0; y < bare.height(); ++y) {
    for (int x = 0; x < bare.width(); ++x)
      ASSERT_EQ(both(x, y), bare(x, y));
  }
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
