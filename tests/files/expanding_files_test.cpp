// Small files that name their parts many times: each is refused with the memory that it needs, or
// read without repeating what it names.
#include <cstdint>
#include <cstring>
#include <string>

#include <fmt/format.h>
#include <sys/resource.h>

#include "frangia/files/internal/zip_file.h"
#include "frangia/files/range_scan.h"
#include "frangia/files/read_mesh.h"

#include "files/folder_fixture.h"
#include "files/sample_meshes.h"

namespace frangia {
namespace {

using testing::error_of;

double peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// `count` times `part`, separated by commas.
std::string listed(const std::string& part, int count) {
  std::string list;
  for (int i = 0; i < count; ++i)
    list += (i == 0 ? "" : ",") + part;
  return list;
}

class ExpandingFiles : public testing::FolderFixture {
 protected:
  /// A .gltf of one triangle per three of `vertices`, whose buffer is the file a.bin.
  [[nodiscard]] std::filesystem::path put_gltf(int buffers,
                                               int primitives,
                                               int nodes,
                                               std::uint32_t vertices) const {
    static_cast<void>(put("a.bin", std::string(std::size_t{12} * vertices, '\0')));
    const std::string buffer = fmt::format(R"({{"uri":"a.bin","byteLength":{}}})", 12 * vertices);
    const std::string view = fmt::format(R"({{"buffer":0,"byteLength":{}}})", 12 * vertices);
    const std::string accessor = fmt::format(
        R"({{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3"}})", vertices);
    std::string children;
    for (int i = 0; i < nodes; ++i)
      children += fmt::format("{}{}", i == 0 ? "" : ",", i);
    return put("a.gltf",
               fmt::format(R"({{"scenes":[{{"nodes":[{}]}}],"nodes":[{}],)"
                           R"("meshes":[{{"primitives":[{}]}}],"buffers":[{}],)"
                           R"("bufferViews":[{}],"accessors":[{}]}})",
                           children,
                           listed(R"({"mesh":0})", nodes),
                           listed(R"({"attributes":{"POSITION":0}})", primitives),
                           listed(buffer, buffers),
                           view,
                           accessor));
  }
  [[nodiscard]] std::filesystem::path put_3mf(const std::string& resources,
                                              const std::string& items) const {
    ZipWriter zip(at("a.3mf"));
    zip.begin("3D/3dmodel.model");
    zip.text(
        R"(<model xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>)"
        R"(<object id="1"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>)"
        R"(<vertex x="0" y="1" z="0"/></vertices><triangles><triangle v1="0" v2="1" v3="2"/>)"
        R"(</triangles></mesh></object>)");
    zip.text(resources + "</resources><build>" + items + "</build></model>");
    zip.commit();
    return at("a.3mf");
  }
};

void expect_refused(const std::string& why) {
  EXPECT_NE(why.find("set `allow_memory` to "), std::string::npos) << why;
  EXPECT_NE(why.find(" GB of memory"), std::string::npos) << why;
}

TEST_F(ExpandingFiles, GltfThatNamesAFileManyTimesReadsItOnce) {
  const double before = peak_memory_bytes();
  const auto path = put_gltf(20'000, 1, 1, 30'000);
  EXPECT_EQ(read_mesh(path).triangles.size(), 10'000U);
  EXPECT_LT(peak_memory_bytes() - before, 200e6);
}

TEST_F(ExpandingFiles, GltfThatRepeatsAPrimitiveIsRefusedWithTheMemoryThatItNeeds) {
  expect_refused(error_of([&] { return read_mesh(put_gltf(1, 3'000, 1, 30'000)); }));
}

TEST_F(ExpandingFiles, GltfThatRepeatsAMeshIsRefusedUntilTheMemoryIsAllowed) {
  const auto path = put_gltf(1, 1, 30'000, 1'200);
  expect_refused(error_of([&] { return read_mesh(path); }));
  ReadOptions options;
  options.allow_memory_bytes = 8'000'000'000;
  EXPECT_EQ(read_mesh(path, {}, options).triangles.size(), 12'000'000U);
}

TEST_F(ExpandingFiles, GltfWithNumbersThatAreNoIndexIsRefused) {
  const auto path = put_gltf(1, 1, 1, 3);
  const std::string good = bytes_in("a.gltf");
  for (const char* wrong : {"-1", "1e300", "0.5", "-1e300", "true", "null"}) {
    for (const char* key : {R"("count":)", R"("byteLength":)", R"("bufferView":)", R"("mesh":)"}) {
      std::string text = good;
      const std::size_t begin = text.find(key) + std::strlen(key);
      text.replace(begin, text.find_first_of(",}", begin) - begin, wrong);
      static_cast<void>(put("a.gltf", text));
      const std::string why = error_of([&] { return read_mesh(path); });
      EXPECT_NE(why.find("not a valid count or index"), std::string::npos) << why;
    }
  }
}

TEST_F(ExpandingFiles, GltfWithDeepJsonIsRefused) {
  const auto path = put("a.gltf", R"({"nodes":)" + std::string(1'000'000, '['));
  EXPECT_NE(error_of([&] { return read_mesh(path); }).find("nested"), std::string::npos);
}

TEST_F(ExpandingFiles, ComponentsOf3mfThatDoubleAtEachLevelAreRefusedWithTheMemoryThatTheyNeed) {
  std::string objects;
  for (int id = 2; id < 60; ++id) {
    objects += fmt::format(
        R"(<object id="{0}"><components><component objectid="{1}"/><component objectid="{1}"/></components></object>)",
        id,
        id - 1);
  }
  const std::string why =
      error_of([&] { return read_mesh(put_3mf(objects, R"(<item objectid="59"/>)")); });
  EXPECT_NE(why.find("over 1000 TB of memory"), std::string::npos) << why;
  expect_refused(error_of([&] { return read_mesh(put_3mf(objects, R"(<item objectid="25"/>)")); }));
  EXPECT_EQ(read_mesh(put_3mf(objects, R"(<item objectid="11"/>)")).triangles.size(), 1024U);
}

TEST_F(ExpandingFiles, ManyItemsOf3mfAreRefusedWhileTheyAreParsed) {
  std::string items;
  for (int i = 0; i < 2'500'000; ++i)
    items += R"(<item objectid="1"/>)";
  const auto path = put_3mf("", items);
  EXPECT_LT(std::filesystem::file_size(path), 1'000'000U);
  expect_refused(error_of([&] { return read_mesh(path); }));
}

TEST_F(ExpandingFiles, AnElementOf3mfWithoutEndIsRefused) {
  const std::string why = error_of([&] {
    return read_mesh(put_3mf("", R"(<item objectid="1" name=")" + std::string(20'000'000, 'a')));
  });
  EXPECT_NE(why.find("an element of more than"), std::string::npos) << why;
}

TEST_F(ExpandingFiles, AConfThatListsAScanManyTimesIsRefused) {
  std::string points =
      "ply\nformat ascii 1.0\nelement vertex 3000\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n";
  for (int i = 0; i < 3000; ++i)
    points += fmt::format("{} {} 0\n", i % 60, i / 60);
  static_cast<void>(put("a.ply", points));
  std::string lines;
  for (int i = 0; i < 2'000; ++i)
    lines += "bmesh a.ply 0 0 0 0 0 0 1\n";
  const auto path = put("a.conf", lines);
  const std::string why = error_of([&] { return read_posed_scans(path); });
  expect_refused(why);
}

}  // namespace
}  // namespace frangia
