// What each format keeps of a mesh in a round trip, and what other programs read in the files.
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "frangia/core/missing.h"
#include "frangia/files/internal/zip_file.h"
#include "frangia/files/read_mesh.h"
#include "frangia/files/write_mesh.h"
#include "frangia/geometry/vertex_data.h"

#include "files/external_readers.h"
#include "files/folder_fixture.h"
#include "files/sample_meshes.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

/// A closed box with every vertex attribute; triangle 3 is displaced, triangle 7 synthesized.
Mesh marked_box() {
  Mesh mesh = testing::box({-1.5F, 2.25F, 0.1F}, {10.7F, 20.0F, 31.0F});
  mesh.normals = vertex_normals(mesh);
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    mesh.sigma_mm.push_back(0.01F + 0.001F * static_cast<float>(i));
    mesh.views.push_back(static_cast<std::uint16_t>(i));
  }
  ensure_marks(mesh);
  mesh.triangle_marks[3] = Mark::Displaced;
  mesh.triangle_marks[7] = Mark::Synthesized;
  return mesh;
}

class EveryFormat : public testing::FolderFixture {
 protected:
  [[nodiscard]] Mesh there_and_back(const std::string& name, const Mesh& mesh) const {
    write_mesh(at(name), mesh);
    return read_mesh(at(name));
  }
};

std::array<std::size_t, 3> counts_of_marks(const Mesh& mesh) {
  std::array<std::size_t, 3> counts{};
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    ++counts.at(static_cast<std::size_t>(mark_of(mesh, i)));
  return counts;
}

TEST_F(EveryFormat, KeepsAClosedSurface) {
  const Mesh mesh = marked_box();
  for (const char* name :
       {"a.dxf", "a.stl", "a.ply", "a.obj", "a.glb", "a.gltf", "a.3mf", "a.off"}) {
    const Mesh back = there_and_back(name, mesh);
    ASSERT_EQ(back.triangles.size(), mesh.triangles.size()) << name;
    EXPECT_EQ(testing::open_edges(back), 0U) << name;
    EXPECT_NEAR(testing::volume_mm3(back), testing::volume_mm3(mesh), 0.01) << name;
    for (const auto& vertex : mesh.vertices_mm) {
      const bool kept = std::any_of(
          back.vertices_mm.begin(), back.vertices_mm.end(), [&](const Eigen::Vector3f& v) {
            return (v - vertex).norm() < 1e-4F;
          });
      EXPECT_TRUE(kept) << name;
    }
  }
}

TEST_F(EveryFormat, WithMarksKeepsThem) {
  const Mesh mesh = marked_box();
  for (const char* name : {"a.dxf", "a.ply", "a.obj", "a.glb", "a.gltf", "a.3mf"})
    EXPECT_EQ(counts_of_marks(there_and_back(name, mesh)), counts_of_marks(mesh)) << name;
}

TEST_F(EveryFormat, NamesTheMarksInTextFiles) {
  for (const char* name : {"a.obj", "a.gltf"}) {
    write_mesh(at(name), marked_box());
    for (const char* mark : {"measured", "displaced", "synthesized"})
      EXPECT_NE(bytes_in(name).find(mark), std::string::npos) << name << " " << mark;
  }
  write_mesh(at("a.dxf"), marked_box());
  for (const char* layer : {"\nSCAN\n", "\nSCAN_DISPLACED\n", "\nSCAN_SYNTHESIZED\n"})
    EXPECT_NE(bytes_in("a.dxf").find(layer), std::string::npos) << layer;
}

TEST_F(EveryFormat, ShowsSynthesizedTrianglesInTheBlueOfPictures) {
  // Linear (0.12, 0.36, 0.72), and the same for a screen with gamma 2.2: 255 x^(1 / 2.2).
  write_mesh(at("a.gltf"), marked_box());
  const auto gltf = nlohmann::json::parse(bytes_in("a.gltf"));
  EXPECT_EQ(gltf["materials"][2]["pbrMetallicRoughness"]["baseColorFactor"],
            (std::vector<double>{0.12, 0.36, 0.72, 1.0}));
  write_mesh(at("a.off"), marked_box());
  EXPECT_NE(bytes_in("a.off").find(" 97 160 220\n"), std::string::npos) << bytes_in("a.off");
  write_mesh(at("a.3mf"), marked_box());
  std::string model;
  EXPECT_TRUE(ZipReader(at("a.3mf")).read("3D/3dmodel.model", [&](std::string_view piece, double) {
    model += piece;
  }));
  EXPECT_NE(model.find("name=\"synthesized\" displaycolor=\"#61A0DC\""), std::string::npos);
  write_mesh(at("a.dxf"), marked_box());
  EXPECT_NE(bytes_in("a.dxf").find("SCAN_SYNTHESIZED\n 70\n0\n 62\n150\n"), std::string::npos);
}

TEST_F(EveryFormat, GltfAndPlyKeepAllVertexAttributesExactly) {
  const Mesh mesh = marked_box();
  for (const char* name : {"a.ply", "a.glb", "a.gltf"}) {
    const Mesh back = there_and_back(name, mesh);
    EXPECT_EQ(back.vertices_mm, mesh.vertices_mm) << name;
    EXPECT_EQ(back.normals, mesh.normals) << name;
    EXPECT_EQ(back.sigma_mm, mesh.sigma_mm) << name;
    EXPECT_EQ(back.views, mesh.views) << name;
    EXPECT_EQ(back.vertex_marks, mesh.vertex_marks) << name;
  }
}

TEST_F(EveryFormat, GltfPlyAndPcdKeepBothPartsOfSigma) {
  Mesh mesh = marked_box();
  mesh.sigma_noise_mm = mesh.sigma_mm;
  for (const float noise : mesh.sigma_noise_mm)
    mesh.sigma_systematic_mm.push_back(3.0F * noise);
  mesh.sigma_systematic_mm[2] = kMissing;
  combine_sigma_parts(mesh);
  for (const char* name : {"a.ply", "a.glb", "a.gltf", "a.pcd"}) {
    const Mesh back = there_and_back(name, mesh);
    ASSERT_EQ(back.sigma_systematic_mm.size(), mesh.vertices_mm.size()) << name;
    EXPECT_EQ(back.sigma_noise_mm, mesh.sigma_noise_mm) << name;
    EXPECT_EQ(back.views,
              std::string_view(name) == "a.pcd" ? std::vector<std::uint16_t>() : mesh.views);
    for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
      if (i == 2) {
        EXPECT_TRUE(std::isnan(back.sigma_mm[i]) && std::isnan(back.sigma_systematic_mm[i]))
            << name;
      } else {
        EXPECT_EQ(back.sigma_mm[i], mesh.sigma_mm[i]) << name;
        EXPECT_EQ(back.sigma_systematic_mm[i], mesh.sigma_systematic_mm[i]) << name;
      }
    }
  }
}

TEST_F(EveryFormat, NamesNoPartsOfSigmaWhereOnlyNoiseIsKnown) {
  for (const char* name : {"a.ply", "a.gltf", "a.pcd"}) {
    write_mesh(at(name), marked_box());
    EXPECT_EQ(bytes_in(name).find("oise"), std::string::npos) << name;
    EXPECT_EQ(bytes_in(name).find("NOISE"), std::string::npos) << name;
    EXPECT_TRUE(read_mesh(at(name)).sigma_noise_mm.empty()) << name;
  }
}

TEST_F(EveryFormat, PlyWithOnePartOfSigmaKeepsTheCombinedValueAlone) {
  const Mesh mesh =
      read_mesh(put("a.ply",
                    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                    "property float z\nproperty float sigma_mm\nproperty float sigma_noise_mm\n"
                    "end_header\n1 2 3 0.5 0.3\n"));
  EXPECT_EQ(mesh.sigma_mm, std::vector<float>(1, 0.5F));
  EXPECT_TRUE(mesh.sigma_noise_mm.empty() && mesh.sigma_systematic_mm.empty());
}

TEST_F(EveryFormat, GltfIsInMetresWithYUp) {
  if (!testing::have_assimp()) GTEST_SKIP() << "assimp is missing; ./run setup installs it";
  write_mesh(at("a.glb"), testing::box({0, 0, 0}, {100, 200, 300}));
  const testing::ReaderAnswer answer = testing::ask("assimp info " + at("a.glb").string());
  EXPECT_NE(answer.text.find("Maximum point      (0.100000 0.300000 0.000000)"), std::string::npos)
      << answer.text;
}

TEST_F(EveryFormat, CloudsKeepTheirPointsAndNormalsExactly) {
  const Mesh mesh = testing::measured_sheet(12);
  for (const char* name : {"a.xyz", "a.pcd", "a.ply"}) {
    const Mesh back = there_and_back(name, mesh);
    EXPECT_EQ(back.vertices_mm, mesh.vertices_mm) << name;
    EXPECT_EQ(back.normals, mesh.normals) << name;
  }
  EXPECT_EQ(there_and_back("a.pcd", mesh).sigma_mm, mesh.sigma_mm);
}

TEST_F(EveryFormat, ThreeMfIsValidToTheConsortiumsOwnReader) {
  if (!testing::have_3mf()) GTEST_SKIP() << "lib3mf is missing; ./run setup installs it";
  write_mesh(at("solid.3mf"), marked_box());
  const testing::ReaderAnswer solid = testing::ask_3mf(at("solid.3mf"));
  EXPECT_TRUE(solid.succeeded && solid.text == "12 1\n") << solid.text;
  write_mesh(at("sheet.3mf"), testing::marked_sheet(30));
  const testing::ReaderAnswer sheet = testing::ask_3mf(at("sheet.3mf"));
  EXPECT_TRUE(sheet.succeeded && sheet.text == "1682 0\n") << sheet.text;
}

// PrusaSlicer 2.5 refuses a build item of type "surface" ("invalid object id").
TEST_F(EveryFormat, ThreeMfBuildsAModelEvenWhenOpen) {
  for (const Mesh& mesh : {marked_box(), testing::marked_sheet(30)}) {
    write_mesh(at("a.3mf"), mesh);
    std::string model;
    EXPECT_TRUE(ZipReader(at("a.3mf"))
                    .read("3D/3dmodel.model",
                          [&](std::string_view piece, double /*done*/) { model += piece; }));
    EXPECT_NE(model.find("<object id=\"2\" type=\"model\""), std::string::npos);
    EXPECT_EQ(model.find("surface"), std::string::npos);
    EXPECT_EQ(counts_of_marks(read_mesh(at("a.3mf"))), counts_of_marks(mesh));
  }
}

TEST_F(EveryFormat, ReadsWhatAssimpWrites) {
  if (!testing::have_assimp()) GTEST_SKIP() << "assimp is missing; ./run setup installs it";
  write_mesh(at("a.ply"), testing::sheet(20));
  for (const char* name : {"b.stl", "b.obj", "b.glb", "b.gltf", "b.ply"}) {
    const testing::ReaderAnswer answer =
        testing::ask("assimp export " + at("a.ply").string() + " " + at(name).string());
    ASSERT_TRUE(answer.succeeded) << answer.text;
    EXPECT_EQ(read_mesh(at(name)).triangles.size(), 2U * 19 * 19) << name;
  }
}

TEST_F(EveryFormat, StlIsClosedToAdmesh) {
  if (!testing::have_admesh()) GTEST_SKIP() << "admesh is missing; ./run setup installs it";
  for (const bool ascii : {false, true}) {
    write_mesh(at("a.stl"), marked_box(), {.stl = {.ascii = ascii}});
    const testing::ReaderAnswer answer = testing::ask("admesh -e " + at("a.stl").string());
    EXPECT_NE(answer.text.find("Total disconnected facets        :     0"), std::string::npos)
        << answer.text;
    EXPECT_NE(answer.text.find("Number of facets                 :    12"), std::string::npos)
        << answer.text;
  }
}

TEST_F(EveryFormat, OpenStlIsReadByAdmeshWithAllFacets) {
  if (!testing::have_admesh()) GTEST_SKIP() << "admesh is missing; ./run setup installs it";
  for (const bool ascii : {false, true}) {
    write_mesh(at("a.stl"), testing::marked_sheet(30), {.stl = {.ascii = ascii}});
    const testing::ReaderAnswer answer = testing::ask("admesh -e -c " + at("a.stl").string());
    EXPECT_NE(answer.text.find("Number of facets                 :  1682"), std::string::npos)
        << answer.text;
  }
}

TEST_F(EveryFormat, XyzIsReadByNumPyAndPcdByPcl) {
  if (!testing::have_numpy()) GTEST_SKIP() << "python3-numpy is missing; ./run setup installs it";
  const Mesh mesh = testing::measured_sheet(12);
  write_mesh(at("a.xyz"), mesh);
  write_mesh(at("a.pcd"), mesh);
  const auto python = [](const std::string& program) {
    return testing::ask("/usr/bin/python3 -c '" + program + "'").text;
  };
  EXPECT_EQ(python("import numpy; print(numpy.loadtxt(\"" + at("a.xyz").string() + "\").shape)"),
            "(144, 6)\n");
  if (testing::have_pcl()) {
    EXPECT_EQ(python("import pcl; print(pcl.load(\"" + at("a.pcd").string() + "\").size)"),
              "144\n");
  }
}

TEST_F(EveryFormat, ReadsOrganizedCloudsOfPclWithoutTheirMissingPoints) {
  const auto path = put("a.pcd",
                        "# .PCD v.7\nVERSION .7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\n"
                        "COUNT 1 1 1 1\nWIDTH 2\nHEIGHT 2\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\n"
                        "DATA ascii\n1 2 3 0\nnan nan nan 0\n4 5 6 1\n7 8 9 1\n");
  const Mesh cloud = read_mesh(path);
  ASSERT_EQ(cloud.vertices_mm.size(), 3U);
  EXPECT_EQ(cloud.vertices_mm[2], Eigen::Vector3f(7, 8, 9));
}

TEST_F(EveryFormat, ReadsOffWithColoursPolygonsAndComments) {
  const auto path = put("a.off",
                        "COFF # corners\n5 2 0\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n"
                        "1 1 0 0 0 0 0\n0 1 0 0 0 0 0\n# the tip\n0 0 1 0 0 0 0\n"
                        "4 0 1 2 3 255 0 0\n3 0 1 4\n");
  EXPECT_EQ(read_mesh(path).triangles.size(), 3U);
}

TEST_F(EveryFormat, IsWrittenWithTheSameBytesAgain) {
  for (const char* extension : {".dxf", ".stl", ".ply", ".obj", ".glb", ".gltf", ".3mf", ".off"}) {
    write_mesh(at(std::string("a") + extension), marked_box());
    write_mesh(at(std::string("b") + extension), marked_box());
    EXPECT_EQ(bytes_in(std::string("a") + extension), bytes_in(std::string("b") + extension))
        << extension;
  }
}

}  // namespace
}  // namespace frangia
