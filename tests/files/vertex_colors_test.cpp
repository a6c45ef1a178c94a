// The colors of vertices in files: round trips, and what other programs read and write.
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "frangia/files/read_mesh.h"
#include "frangia/files/write_mesh.h"

#include "files/external_readers.h"
#include "files/folder_fixture.h"
#include "support/test_meshes.h"

namespace frangia::vertex_colors {
namespace {

using testing::ask;
using testing::ReaderAnswer;

/// A box whose corners have the colors of the corners of the color cube, but for one.
Mesh colored_box() {
  Mesh mesh = testing::box(Eigen::Vector3f(0.0F, 0.0F, 0.0F), Eigen::Vector3f(10.0F, 20.0F, 30.0F));
  for (unsigned i = 0; i < 8; ++i) {
    const auto channel = [&](unsigned bit) {
      return static_cast<std::uint8_t>((i & bit) != 0 ? 255 : 0);
    };
    mesh.colors.push_back({channel(1), channel(2), channel(4)});
  }
  mesh.colors[5] = {200, 100, 7};
  return mesh;
}

class VertexColors : public testing::FolderFixture {
 protected:
  /// The colors that assimp finds, one line a vertex, in the order of its own vertices.
  [[nodiscard]] std::vector<std::array<double, 3>> assimp_colors(const std::string& name) const {
    const auto dump = at(name + ".assxml");
    const ReaderAnswer answer = ask("assimp dump " + at(name).string() + " " + dump.string());
    EXPECT_TRUE(answer.succeeded) << answer.text;
    const std::string text = bytes_in(name + ".assxml");
    std::vector<std::array<double, 3>> colors;
    const std::size_t begin = text.find("<Colors ");
    if (begin == std::string::npos) return colors;
    std::istringstream lines(text.substr(text.find('\n', begin)));
    std::array<double, 3> color{};
    double alpha = 0.0;
    while (lines >> color[0] >> color[1] >> color[2] >> alpha)
      colors.push_back(color);
    return colors;
  }
  /// Whether each color of the box is among those found.
  static void expect_all(const std::vector<std::array<double, 3>>& found,
                         double (*screen)(double),
                         const std::string& name,
                         double tolerance = 0.6) {
    for (const VertexColor& color : colored_box().colors) {
      const bool is_there = std::any_of(found.begin(), found.end(), [&](const auto& one) {
        double off = 0.0;
        for (std::size_t i = 0; i < 3; ++i)
          off = std::max(off, std::abs(255.0 * screen(one.at(i)) - color.at(i)));
        return off < tolerance;
      });
      EXPECT_TRUE(is_there) << name << ": " << int{color[0]} << ' ' << int{color[1]} << ' '
                            << int{color[2]};
    }
  }
};

double as_it_is(double value) {
  return value;
}

/// IEC 61966-2-1.
double srgb(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

TEST_F(VertexColors, SurviveARoundTripExactly) {
  const Mesh mesh = colored_box();
  for (const char* name : {"a.ply", "a.obj", "a.glb", "a.gltf", "a.3mf", "a.pcd"}) {
    write_mesh(at(name), mesh);
    EXPECT_EQ(read_mesh(at(name)).colors, mesh.colors) << name;
  }
}

TEST_F(VertexColors, AreAbsentInFilesOfMeshesWithoutThem) {
  Mesh mesh = colored_box();
  mesh.colors.clear();
  for (const char* name : {"a.ply", "a.obj", "a.glb", "a.3mf", "a.pcd"}) {
    write_mesh(at(name), mesh);
    EXPECT_TRUE(read_mesh(at(name)).colors.empty()) << name;
    for (const char* word : {"uchar red", "COLOR_0", "colorgroup", " rgb"})
      EXPECT_EQ(bytes_in(name).find(word), std::string::npos) << name;
  }
}

TEST_F(VertexColors, AreReadByAssimp) {
  if (!testing::have_assimp()) GTEST_SKIP() << "assimp is not installed";
  for (const char* name : {"a.ply", "a.obj"}) {
    write_mesh(at(name), colored_box());
    expect_all(assimp_colors(name), as_it_is, name);
  }
  // The colors of glTF are linear.
  write_mesh(at("a.glb"), colored_box());
  expect_all(assimp_colors("a.glb"), srgb, "a.glb");
}

TEST_F(VertexColors, OfAssimpAreRead) {
  if (!testing::have_assimp()) GTEST_SKIP() << "assimp is not installed";
  write_mesh(at("a.ply"), colored_box());
  for (const char* name : {"b.ply", "b.obj", "b.glb"}) {
    const ReaderAnswer answer =
        ask("assimp export " + at("a.ply").string() + " " + at(name).string());
    ASSERT_TRUE(answer.succeeded) << answer.text;
    std::vector<std::array<double, 3>> found;
    for (const VertexColor& color : read_mesh(at(name)).colors)
      found.push_back({color[0] / 255.0, color[1] / 255.0, color[2] / 255.0});
    if (std::string(name) == "b.glb") {  // assimp does not convert the values to linear ones
      for (auto& color : found) {
        for (double& value : color)
          value = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
      }
    }
    // assimp truncates to bytes in PLY, and linear light is rounded to screen values in glTF.
    ASSERT_GE(found.size(), 8U) << name;
    expect_all(found, as_it_is, name, 1.5);
  }
}

TEST_F(VertexColors, AreReadByTheReaderOfThe3mfConsortium) {
  if (!testing::have_3mf()) GTEST_SKIP() << "lib3mf is not installed";
  Mesh mesh = colored_box();
  mesh.triangle_marks.assign(mesh.triangles.size(), Mark::Measured);
  mesh.triangle_marks[3] = Mark::Synthesized;
  write_mesh(at("a.3mf"), mesh);
  const ReaderAnswer answer =
      ask("/usr/bin/python3 " FRANGIA_SOURCE_DIR "/tests/files/check_3mf_colors.py " +
          at("a.3mf").string());
  ASSERT_TRUE(answer.succeeded) << answer.text;
  std::string expected;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (i == 3) {
      expected += "none\n";
      continue;
    }
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (const std::uint8_t channel : mesh.colors[mesh.triangles[i].at(corner)])
        expected += std::to_string(channel) + " ";
    }
    expected.back() = '\n';
  }
  EXPECT_EQ(answer.text, expected);
  EXPECT_TRUE(testing::ask_3mf(at("a.3mf")).succeeded) << "lib3mf warns";
}

TEST_F(VertexColors, OfOtherProgramsAreReadInTheirTypes) {
  const auto at_float_ply =
      put("float.ply",
          "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
          "float z\nproperty float red\nproperty float green\nproperty float blue\nend_header\n"
          "1 2 3 1 0.5 1.01\n");
  EXPECT_EQ(read_mesh(at_float_ply).colors, (std::vector<VertexColor>{{255, 128, 255}}));
  const auto at_diffuse_ply =
      put("diffuse.ply",
          "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
          "float z\nproperty uchar diffuse_red\nproperty uchar diffuse_green\nproperty uchar "
          "diffuse_blue\nend_header\n1 2 3 10 20 30\n");
  EXPECT_EQ(read_mesh(at_diffuse_ply).colors, (std::vector<VertexColor>{{10, 20, 30}}));
  const auto at_weight_obj = put("weight.obj", "v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n");
  EXPECT_TRUE(read_mesh(at_weight_obj).colors.empty());
  const auto at_some_obj = put("some.obj", "v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n");
  EXPECT_TRUE(read_mesh(at_some_obj).colors.empty()) << "not of all vertices";
  // PCL stores the bytes of the color as those of a float.
  const auto at_pcl_pcd =
      put("pcl.pcd",
          "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
          "WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n0 0 0 4.808e+06\n");
  EXPECT_EQ(read_mesh(at_pcl_pcd).colors, (std::vector<VertexColor>{{146, 186, 128}}));
}

}  // namespace
}  // namespace frangia::vertex_colors
