#include "frangia/files/dxf.h"

#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "files/in_a_folder.h"
#include "files/judges.h"
#include "files/sample_meshes.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::error_of;

constexpr std::array kVariants{DxfVariant::Faces, DxfVariant::Polyface};

class WriteDxf : public testing::InAFolder {
 protected:
  std::filesystem::path write(const Mesh& mesh, DxfVariant variant) const {
    write_dxf(at("part.dxf"), mesh, {variant});
    return at("part.dxf");
  }
  [[nodiscard]] std::string error_writing(const Mesh& mesh) const {
    return error_of([&] { return write(mesh, DxfVariant::Faces); });
  }
};

/// A judge answers with the number of faces and then corners of the box around them, low and high.
void expect_verdict(const Answer& answer, const Mesh& mesh) {
  ASSERT_TRUE(answer.content) << answer.text;
  std::istringstream words(answer.text);
  std::size_t faces = 0;
  words >> faces;
  EXPECT_EQ(faces, mesh.triangles.size());
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector3d high = -low;
  for (const auto& vertex : mesh.vertices_mm) {
    const Eigen::Vector3d written = (vertex.cast<double>() * 1e4).array().round() / 1e4;
    low = low.cwiseMin(written);
    high = high.cwiseMax(written);
  }
  std::size_t boxes = 0;
  for (Eigen::Vector3d a, b; words >> a.x() >> a.y() >> a.z() >> b.x() >> b.y() >> b.z(); ++boxes) {
    EXPECT_LT((a - low).norm() + (b - high).norm(), 1e-9) << answer.text;
  }
  EXPECT_GE(boxes, 1U) << answer.text;
}

TEST_F(WriteDxf, PassesTheAuditOfEzdxfWithAllFacesAndExactExtents) {
  if (!testing::have_ezdxf()) GTEST_SKIP() << "python3-ezdxf is missing; ./run setup installs it";
  const Mesh mesh = testing::measured_sheet(30);
  for (const DxfVariant variant : kVariants)
    expect_verdict(testing::ask_ezdxf(write(mesh, variant)), mesh);
}

TEST_F(WriteDxf, IsReadByLibdimeWithAllFacesAlsoBeyondSixteenBits) {
  if (std::string(FRANGIA_JUDGE_LIBDIME).empty()) {
    GTEST_SKIP() << "libdime-dev is missing; ./run setup installs it, then configure again";
  }
  const Mesh mesh = testing::sheet(200);  // 40 000 vertices, 79 202 triangles
  for (const DxfVariant variant : kVariants)
    expect_verdict(testing::ask_libdime(write(mesh, variant)), mesh);
}

TEST_F(WriteDxf, WritesCoordinatesToATenThousandthAndNoLonger) {
  Mesh mesh;
  mesh.vertices_mm = {{0.00004F, -0.00016F, 12.5F}, {-1.0F, 0.0F, 1234.5F}, {0.1F, 10.01F, 0.0F}};
  mesh.triangles = {{0, 1, 2}};
  const auto path = write(mesh, DxfVariant::Faces);
  const std::string text = bytes_in("part.dxf");
  EXPECT_NE(text.find("  0\n3DFACE\n  8\nSCAN\n"
                      " 10\n0.0\n 20\n-0.0002\n 30\n12.5\n"
                      " 11\n-1.0\n 21\n0.0\n 31\n1234.5\n"
                      " 12\n0.1\n 22\n10.01\n 32\n0.0\n"
                      " 13\n0.1\n 23\n10.01\n 33\n0.0\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("$EXTMIN\n 10\n-1.0\n 20\n-0.0002\n 30\n0.0\n"), std::string::npos);
  EXPECT_NE(text.find("$EXTMAX\n 10\n0.1\n 20\n10.01\n 30\n1234.5\n"), std::string::npos);
}

TEST_F(WriteDxf, LeavesOutWhatIsWrittenAlikeAndKeepsItOutOfTheExtents) {
  Mesh mesh = testing::sheet(4);
  const auto plain = write(mesh, DxfVariant::Faces);
  const std::string expected = bytes_in("part.dxf");
  mesh.vertices_mm.emplace_back(500.0F, 500.0F, 500.0F);
  mesh.vertices_mm.emplace_back(500.00001F, 500.0F, 500.0F);  // another place, but not in the file
  mesh.triangles.push_back({3, 3, 4});
  mesh.triangles.push_back({3, 16, 17});
  const auto more = write(mesh, DxfVariant::Faces);
  EXPECT_EQ(bytes_in("part.dxf"), expected);
}

TEST_F(WriteDxf, RefusesAMeshWithoutAFaceOfAnySize) {
  Mesh mesh = testing::sheet(3);
  for (auto& vertex : mesh.vertices_mm)
    vertex *= 1e-6F;
  EXPECT_NE(error_writing(mesh).find("0.0001 mm"), std::string::npos);
  mesh.triangles.clear();
  EXPECT_NE(error_writing(mesh).find("no triangle"), std::string::npos);
  EXPECT_TRUE(folder_is_empty());
}

TEST_F(WriteDxf, RefusesAVertexOutOfThisWorld) {
  Mesh mesh = testing::sheet(3);
  mesh.vertices_mm[4].x() = 2e9F;
  EXPECT_NE(error_writing(mesh).find("1 000 km"), std::string::npos);
  EXPECT_TRUE(folder_is_empty());
}

}  // namespace
}  // namespace frangia
