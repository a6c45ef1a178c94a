// The folders of other programs, rebuilt from simulated frames of their sequences: import takes
// each of them in one command, without changing a pixel.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/dataset/import_layout.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/files/read_mesh.h"
#include "frangia/frames/png.h"

#include "support/run_program.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::run_program;
using testing::TemporaryFolder;

/// A layout, the number of its images, and the number of the first.
struct LayoutCase {
  const char* layout;
  std::size_t images;
  int first;
  const char* names;  ///< of the files, which are PNG here
};

void PrintTo(const LayoutCase& layout, std::ostream* out) {
  *out << layout.layout;
}

class ImportLayouts : public ::testing::TestWithParam<LayoutCase> {
 protected:
  [[nodiscard]] std::filesystem::path at(const std::string& name) const {
    return folder_.path() / name;
  }
  /// A simulated capture of the layout's patterns by a small rig.
  [[nodiscard]] Scan simulated(const ImportLayout& layout) const {
    Scan plan;
    plan.folder = at("made");
    plan.name = "made";
    plan.rig = rig();
    plan.patterns = layout.patterns;
    plan.views.push_back({0.0, "views/000"});
    return simulate_scan(make_part("plate"), plan, {.samples_per_px = 1});
  }
  [[nodiscard]] static Rig rig() {
    Rig rig = testing::small_rig("digital");
    CameraModel& camera = rig.reference().model;
    camera.width_px /= 2;
    camera.height_px /= 2;
    camera.focal_px *= 0.5;
    camera.principal_point_px = 0.5 * (camera.principal_point_px.array() + 0.5) - 0.5;
    return rig;
  }
  /// Copies the frames to the names that the other program gives them.
  void write_folder(const ImportLayout& layout, const Scan& scan) const {
    std::filesystem::create_directory(at("images"));
    int number = GetParam().first;
    for (const auto& image : layout.images) {
      const auto path =
          at("images") / fmt::format(fmt::runtime(GetParam().names), fmt::arg("frame", number++));
      if (image) {
        const Pattern& pattern = layout.patterns[image->first];
        std::filesystem::copy_file(
            scan.folder / "views/000" / frame_file_name(pattern, static_cast<int>(image->second)),
            path);
      } else {
        const CameraModel& camera = scan.rig.reference().model;
        write_png(path, Frame(Image<std::uint8_t>(camera.width_px, camera.height_px, 3)));
      }
    }
  }

 private:
  TemporaryFolder folder_;
};

TEST_P(ImportLayouts, TakeInAFolderOfTheirProgramInOneCommand) {
  const Rig with_projector = rig();
  const auto& model = std::get<PinholeModel>(with_projector.projector.model);
  const KnownLayout* const known = find_layout(GetParam().layout);
  ASSERT_NE(known, nullptr);
  const ImportLayout layout =
      make_layout(*known, GetParam().images, {model.width_px, model.height_px});
  const Scan made = simulated(layout);
  write_folder(layout, made);
  const Answer answer = run_program(fmt::format("import {} -o {} --layout {} --names '{}' --rig {}",
                                                at("images").string(),
                                                at("scan").string(),
                                                GetParam().layout,
                                                GetParam().names,
                                                (made.folder / "rig.toml").string()));
  ASSERT_EQ(answer.exit_code, 0) << answer.output;
  const Scan scan = read_scan(at("scan"));
  const auto expected = read_frames(made, 0);
  const auto found = read_frames(scan, 0);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].pattern.offset_px, expected[i].pattern.offset_px);
    for (std::size_t k = 0; k < found[i].frames.size(); ++k) {
      const auto& a = std::get<Image<std::uint8_t>>(found[i].frames[k]);
      const auto& b = std::get<Image<std::uint8_t>>(expected[i].frames[k]);
      EXPECT_TRUE(std::ranges::equal(a.pixels(), b.pixels())) << i << ' ' << k;
    }
  }
}

/// A rig of 1280 x 800 projector pixels and twice the camera's pixels of the others: 2 projector
/// pixels to a pixel.
TEST(ImportLayoutsOfGrayCode, GiveColumnsAndACloud) {
  const TemporaryFolder folder;
  const auto at = [&](const char* name) { return folder.path() / name; };
  Scan plan;
  plan.folder = at("made");
  plan.name = "made";
  plan.rig = testing::small_rig("digital");
  const auto& model = std::get<PinholeModel>(plan.rig.projector.model);
  const ImportLayout layout =
      make_layout(*find_layout("scan3d-capture"), 42, {model.width_px, model.height_px});
  plan.patterns = layout.patterns;
  plan.views.push_back({0.0, "views/000"});
  const Scan made = simulate_scan(make_part("plate"), plan, {.samples_per_px = 4});
  std::filesystem::create_directory(at("images"));
  int number = 1;
  for (const auto& image : layout.images) {
    std::filesystem::copy_file(
        made.folder / "views/000" /
            frame_file_name(layout.patterns[image->first], static_cast<int>(image->second)),
        at("images") / fmt::format("cam_{:02}.png", number++));
  }
  const Answer imported =
      run_program(fmt::format("import {} -o {} --layout scan3d-capture --rig {}",
                              at("images").string(),
                              at("scan").string(),
                              (made.folder / "rig.toml").string()));
  ASSERT_EQ(imported.exit_code, 0) << imported.output;
  const Answer decoded =
      run_program(fmt::format("decode {} -o {}", at("scan").string(), at("stages").string()));
  ASSERT_EQ(decoded.exit_code, 0) << decoded.output;
  EXPECT_TRUE(std::filesystem::exists(at("stages") / "columns.tiff"));
  EXPECT_TRUE(std::filesystem::exists(at("stages") / "rows.tiff"));
  const Answer cloud = run_program(
      fmt::format("reconstruct {} -o {}", at("scan").string(), at("cloud.ply").string()));
  ASSERT_EQ(cloud.exit_code, 0) << cloud.output;
  const Mesh mesh = read_mesh(at("cloud.ply"));
  EXPECT_GT(mesh.vertices_mm.size(), 2000U);
  EXPECT_EQ(mesh.colors.size(), mesh.vertices_mm.size()) << "from the white frame";
}

// The digital rig projects 1280 x 800 pixels: eleven and ten bits.
INSTANTIATE_TEST_SUITE_P(
    Known,
    ImportLayouts,
    ::testing::Values(LayoutCase{"opencv-gray-code", 44, 1, "pattern_cam1_im{frame}.png"},
                      LayoutCase{"scan3d-capture", 42, 1, "cam_{frame:02}.png"},
                      LayoutCase{"3dunderworld", 44, 0, "{frame:04}.png"},
                      LayoutCase{"slstudio-gray-code", 18, 0, "frameSeq_{frame}.png"},
                      LayoutCase{"slstudio-phase-shift-3", 3, 0, "frameSeq_{frame}.png"},
                      LayoutCase{"slstudio-phase-shift-2x3", 6, 0, "frameSeq_{frame}.png"}));

}  // namespace
}  // namespace frangia
