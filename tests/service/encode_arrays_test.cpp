#include "frangia/service/encode_arrays.h"

#include <cstring>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/test_meshes.h"

namespace frangia {
namespace {

/// An array of a packed text.
template <typename T>
std::vector<T> array_in(const std::string& packed, const std::string& name) {
  std::uint32_t length = 0;
  std::memcpy(&length, packed.data(), sizeof length);
  const auto header = nlohmann::json::parse(packed.substr(sizeof length, length));
  for (const auto& array : header.at("arrays")) {
    if (array.at("name") != name) continue;
    EXPECT_EQ(array.at("offset").get<std::size_t>() % 4, 0U) << name;
    std::vector<T> values(array.at("length").get<std::size_t>());
    const auto offset = array.at("offset").get<std::size_t>();
    EXPECT_LE(offset + values.size() * sizeof(T), packed.size()) << name;
    if (!values.empty())
      std::memcpy(values.data(), packed.data() + offset, values.size() * sizeof(T));
    return values;
  }
  return {};
}

TEST(EncodeMesh, KeepsEveryArrayToTheBit) {
  Mesh mesh = testing::box({0, 0, 0}, {1, 2, 3});
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    mesh.sigma_mm.push_back(0.25F * static_cast<float>(i));
    mesh.views.push_back(static_cast<std::uint16_t>(i));
  }
  mesh.triangle_marks.assign(mesh.triangles.size(), Mark::Measured);
  mesh.triangle_marks[3] = Mark::Synthesized;
  const std::string packed = encode_mesh(mesh, 7);
  const auto positions = array_in<float>(packed, "positions");
  ASSERT_EQ(positions.size(), 3 * mesh.vertices_mm.size());
  EXPECT_EQ(std::memcmp(positions.data(), mesh.vertices_mm.data(), positions.size() * 4), 0);
  const auto triangles = array_in<std::uint32_t>(packed, "triangles");
  ASSERT_EQ(triangles.size(), 3 * mesh.triangles.size());
  EXPECT_EQ(std::memcmp(triangles.data(), mesh.triangles.data(), triangles.size() * 4), 0);
  EXPECT_EQ(array_in<float>(packed, "sigma_mm"), mesh.sigma_mm);
  EXPECT_EQ(array_in<std::uint16_t>(packed, "views"), mesh.views);
  EXPECT_EQ(array_in<std::uint8_t>(packed, "marks")[3], 2);
  EXPECT_EQ(array_in<float>(packed, "normals").size(), positions.size());
  EXPECT_NE(packed.find(R"("values":{"revision":7})"), std::string::npos);
}

TEST(EncodeMesh, PacksAnEmptyMesh) {
  EXPECT_TRUE(array_in<std::uint32_t>(encode_mesh({}, 1), "triangles").empty());
}

TEST(EncodeSelection, IsOneFlagForEachTriangle) {
  const Selection selection{1, 0, 0, 1, 1};
  EXPECT_EQ(array_in<std::uint8_t>(encode_selection(selection, 2), "selected"), selection);
}

TEST(EncodePoints, KeepsAtMostTheNumberAsked) {
  PointCloud cloud;
  for (int i = 0; i < 1000; ++i) {
    cloud.points_mm.emplace_back(static_cast<float>(i), 0.0F, 0.0F);
    cloud.sigma_mm.push_back(0.1F);
  }
  EXPECT_EQ(array_in<float>(encode_points(cloud, 1000), "positions").size(), 3000U);
  const auto fewer = array_in<float>(encode_points(cloud, 300), "positions");
  EXPECT_LE(fewer.size(), 900U);
  EXPECT_GE(fewer.size(), 600U);
}

}  // namespace
}  // namespace frangia
