#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/dataset/import_frames.h"
#include "frangia/frames/png.h"
#include "frangia/rig/paper_rig.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia::testing {

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A folder of images, the options that import them, and a place for the scan.
class ImportFixture : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path images() const { return folder_.path() / "images"; }
  [[nodiscard]] std::filesystem::path target() const { return folder_.path() / "out" / "scan"; }
  void SetUp() override {
    std::filesystem::create_directories(images());
    std::filesystem::create_directories(target().parent_path());
    options_.period_px = {{"", 20.0}};
    options_.names = "{pattern}_{frame:02}.png";
  }
  /// A rig with a projector of pixels, whose camera has as many pixels as `write` writes.
  [[nodiscard]] static Rig rig_of_images(int width_px = 8, int height_px = 6) {
    Rig rig = make_paper_rig({});
    rig.projector.model = PinholeModel{.width_px = 1280,
                                       .height_px = 800,
                                       .focal_px = {1900.0, 1900.0},
                                       .principal_point_px = {640.0, 400.0}};
    rig.reference().model.width_px = width_px;
    rig.reference().model.height_px = height_px;
    return rig;
  }
  /// A PNG whose pixels hold `value`.
  template <typename T = std::uint8_t>
  void write(const std::string& name, int value, int width = 8, int height = 6) const {
    write_png(images() / name, Frame(Image<T>(width, height, static_cast<T>(value))));
  }
  void write_fringes(const std::string& pattern, int frames = 4) const {
    for (int k = 0; k < frames; ++k)
      write(fmt::format("{}_{:02}.png", pattern, k), 10 * k + static_cast<int>(pattern.size()));
  }
  /// The scan in the target folder.
  Scan import() const {
    static_cast<void>(import_frames(plan_import(images(), options_), target()));
    return read_scan(target(), {}, RigContent::StartValues);
  }
  /// The sentence of the error. Nothing may be left of the scan.
  std::string complaint() const {
    std::string error = error_of([&] { import_frames(plan_import(images(), options_), target()); });
    EXPECT_TRUE(std::filesystem::is_empty(target().parent_path())) << error;
    return error;
  }
  void expect_complaint(const std::string& part) const {
    const std::string error = complaint();
    EXPECT_NE(error.find(part), std::string::npos) << error;
  }
  ImportOptions options_;

 private:
  TemporaryFolder folder_;
};

}  // namespace frangia::testing
