#include "frangia/inspect/inspect_surface.h"

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

}  // namespace
}  // namespace frangia
