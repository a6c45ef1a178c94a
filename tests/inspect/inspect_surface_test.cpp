#include "frangia/inspect/inspect_surface.h"

#include <array>
#include <cstdint>

#include <gtest/gtest.h>

#include "files/sample_meshes.h"
#include "support/error_of.h"

namespace frangia {
namespace {

TEST(InspectSurface, GivesNoVerdictOverAMeshBesideTheReference) {
  const Mesh nominal = testing::sheet(8);
  const RayScene reference(nominal);
  const auto refusal_at = [&](float shift_mm) {
    Mesh moved = nominal;
    for (auto& vertex : moved.vertices_mm)
      vertex.z() += shift_mm;
    return testing::error_of([&] { static_cast<void>(inspect_surface(moved, reference)); });
  };
  EXPECT_NO_THROW(static_cast<void>(inspect_surface(nominal, reference)));
  EXPECT_NE(refusal_at(1000.0F).find("beside the reference, so that nothing of it can be compared"),
            std::string::npos);
}

TEST(InspectSurface, GivesNoVerdictOverASmallMeshInsideOfTheReference) {
  const auto cube = [](float half_mm) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
      mesh.vertices_mm.push_back(half_mm * Eigen::Vector3f((i & 1) != 0 ? 1.0F : -1.0F,
                                                           (i & 2) != 0 ? 1.0F : -1.0F,
                                                           (i & 4) != 0 ? 1.0F : -1.0F));
    constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& [a, b, c, d] : kFaces) {
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
    return mesh;
  };
  const RayScene reference(cube(10.0F));
  const auto inspect = [&](float half_mm) {
    static_cast<void>(inspect_surface(cube(half_mm), reference));
  };
  const std::string refusal = testing::error_of([&] { inspect(1.0F); });
  EXPECT_NE(refusal.find("no point of the mesh lies within 9 mm of the reference"),
            std::string::npos)
      << refusal;
  EXPECT_NO_THROW(inspect(9.0F)) << "an allowance of machining is a deviation";
  EXPECT_NO_THROW(inspect(11.0F));
}

}  // namespace
}  // namespace frangia
