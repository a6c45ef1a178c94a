// Damaged and malicious files: each is refused in one sentence, or read as far as it is valid,
// before memory is allocated for the counts it states.
#include <string>
#include <vector>

#include "frangia/files/internal/zip_file.h"
#include "frangia/files/read_mesh.h"
#include "frangia/files/write_mesh.h"

#include "files/folder_fixture.h"
#include "files/sample_meshes.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

using testing::error_of;

class BadFiles : public testing::FolderFixture {
 protected:
  [[nodiscard]] std::string error_reading(const std::string& name, const std::string& bytes) const {
    const auto path = put(name, bytes);
    std::string why = error_of([&] { return read_mesh(path); });
    EXPECT_EQ(why.find(path.string()), 0U) << why;
    EXPECT_EQ(why.find('\n'), std::string::npos) << why;
    return why;
  }
  [[nodiscard]] std::string three_mf(const std::string& model) const {
    ZipWriter zip(at("made.zip"));
    zip.begin("3D/3dmodel.model");
    zip.text(model);
    zip.commit();
    return bytes_in("made.zip");
  }
  static bool says(const std::string& sentence, const std::string& words) {
    return sentence.find(words) != std::string::npos;
  }
};

const std::string kModel =
    R"(<model unit="inch" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">)"
    R"(<resources><object id="1"><mesh><vertices><vertex x="0" y="0" z="0"/>)"
    R"(<vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/></vertices>)"
    R"(<triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh></object>)";

TEST_F(BadFiles, TruncatedAnywhereAreReadInPartOrRefusedInOneSentence) {
  for (const char* name : {"a.dxf",
                           "a.stl",
                           "a.ply",
                           "a.obj",
                           "a.glb",
                           "a.gltf",
                           "a.3mf",
                           "a.off",
                           "a.xyz",
                           "a.pcd"}) {
    write_mesh(at(name), testing::measured_sheet(6));
    const std::string whole = bytes_in(name);
    for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 60) {
      const auto path = put(name, whole.substr(0, length));
      try {
        const Mesh mesh = read_mesh(path);
        EXPECT_LE(mesh.triangles.size(), 50U) << name;
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input) << name;
        EXPECT_EQ(std::string(error.what()).find(path.string()), 0U) << error.what();
      }
    }
  }
}

TEST_F(BadFiles, WithTheExtensionOfAnotherFormatAreRefused) {
  const std::array names{"a.dxf", "a.stl", "a.ply", "a.obj", "a.glb", "a.3mf", "a.off", "a.pcd"};
  std::vector<std::string> contents;
  for (const char* name : names) {
    write_mesh(at(name), testing::sheet(4));
    contents.push_back(bytes_in(name));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto path = put(names.at(i), contents[k]);
      if (i == k || std::string(names.at(i)) == "a.obj") continue;  // OBJ skips unknown lines
      EXPECT_THROW(static_cast<void>(read_mesh(path)), Error) << names.at(i) << names.at(k);
    }
  }
}

TEST_F(BadFiles, ThatStateTooLargeCountsAreRefusedBeforeMemoryIsAllocated) {
  EXPECT_TRUE(says(error_reading("a.off", "OFF\n4000000000 1 0\n0 0 0\n"), "can hold at most"));
  EXPECT_TRUE(says(error_reading("a.off", "OFF\n1 4000000000 0\n0 0 0\n"), "can hold at most"));
  EXPECT_TRUE(says(error_reading("a.pcd",
                                 "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\n"
                                 "HEIGHT 1\nPOINTS 99999999999\nDATA binary\n0123456789ab"),
                   "can hold at most"));
  EXPECT_TRUE(
      says(error_reading("a.gltf",
                         R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":9000000000,)"
                         R"("uri":"data:;base64,AAAA"}]})"),
           "9000000000"));
  EXPECT_TRUE(says(
      error_reading(
          "a.gltf",
          R"({"buffers":[{"byteLength":3,"uri":"data:;base64,AAAA"}],"bufferViews":[{"buffer":0,)"
          R"("byteLength":3}],"accessors":[{"bufferView":0,"componentType":5126,"count":)"
          R"(4611686018427387904,"type":"VEC3"}],"meshes":[{"primitives":[{"attributes":)"
          R"({"POSITION":0}}]}],"nodes":[{"mesh":0}]})"),
      "exceed their buffer"));
}

TEST_F(BadFiles, WithIndicesOutOfRangeAreRefused) {
  EXPECT_TRUE(says(error_reading("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), "'3'"));
  EXPECT_TRUE(says(error_reading("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"), "'-1'"));
  std::string model = kModel;
  model.replace(model.find(R"(v3="2")"), 6, R"(v3="7")");
  EXPECT_TRUE(says(error_reading("a.3mf", three_mf(model)), "vertex 7"));
}

TEST_F(BadFiles, WithInvalidNumbersAreRefused) {
  EXPECT_TRUE(says(error_reading("a.xyz", "1 2 3\n1 2 nan\n"), "nan"));
  EXPECT_TRUE(says(error_reading("a.xyz", "1 2 3\n1 two 3\n"), "line 2: 'two'"));
  EXPECT_TRUE(says(error_reading("a.xyz", "1 2\n"), "2 numbers"));
  EXPECT_TRUE(says(error_reading("a.off", "OFF\n3 1 0\n0 0 inf\n1 0 0\n0 1 0\n3 0 1 2\n"), "inf"));
  std::string model = kModel;
  model.replace(model.find(R"(x="1")"), 5, R"(x="?")");
  EXPECT_TRUE(says(error_reading("a.3mf", three_mf(model)), "'?'"));
}

TEST_F(BadFiles, ThatContainThemselvesAreRefused) {
  const std::string close = "</resources><build><item objectid=\"2\"/></build></model>";
  const std::string loop =
      R"(<object id="2"><components><component objectid="2"/></components></object>)";
  EXPECT_TRUE(says(error_reading("a.3mf", three_mf(kModel + loop + close)), "contains itself"));
  EXPECT_TRUE(
      says(error_reading("a.gltf", R"({"scenes":[{"nodes":[0]}],"nodes":[{"children":[0]}]})"),
           "its own descendant"));
}

TEST_F(BadFiles, AsZipBombsAreRefusedByTheirExpandedSize) {
  {
    ZipWriter zip(at("bomb.3mf"));
    zip.begin("3D/3dmodel.model");
    const std::string blanks(1 << 20, ' ');
    for (int i = 0; i < 300; ++i)
      zip.text(blanks);
    zip.commit();
  }
  EXPECT_LT(bytes_in("bomb.3mf").size(), 2'000'000U);
  const std::string why = error_of([&] { return read_mesh(at("bomb.3mf")); });
  EXPECT_TRUE(says(why, "it is refused")) << why;
}

TEST_F(BadFiles, ThatDeclareEntitiesAreRefused) {
  EXPECT_TRUE(says(error_reading("a.3mf",
                                 three_mf("<!DOCTYPE m [<!ENTITY a \"aaaa\"><!ENTITY b "
                                          "\"&a;&a;&a;&a;\">]><model>&b;</model>")),
                   "document type"));
}

TEST_F(BadFiles, WithAHundredPartsAreReadCompletely) {
  std::string model = kModel + "</resources><build>";
  for (int i = 0; i < 100; ++i) {
    model +=
        R"(<item objectid="1" transform="1 0 0 0 1 0 0 0 1 )" + std::to_string(3 * i) + " 0 0\"/>";
  }
  const Mesh mesh = read_mesh(put("parts.3mf", three_mf(model + "</build></model>")));
  EXPECT_EQ(mesh.triangles.size(), 100U);
  EXPECT_FLOAT_EQ(mesh.vertices_mm.back().x(), 297.0F * 25.4F);
}

TEST_F(BadFiles, ThatAreEmptyAreRefusedByEveryReader) {
  for (const char* name : {"a.dxf", "a.ply", "a.stl", "a.glb", "a.gltf", "a.3mf", "a.off", "a.pcd"})
    static_cast<void>(error_reading(name, ""));
}

}  // namespace
}  // namespace frangia
