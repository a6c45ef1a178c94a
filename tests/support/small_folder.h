#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "frangia/frames/png.h"
#include "frangia/rig/paper_rig.h"
#include "frangia/rig/write_rig.h"

#include "support/temporary_folder.h"

namespace frangia::testing {

inline const std::string kScan = R"(format = "frangia-scan"
version = 1
name = "wall"
[[pattern]]
name = "fringe"
kind = "fringe"
fringes_per_degree = 1.0
shifts_deg = [0, 90, 180, 270]
[[pattern]]
name = "line"
kind = "line"
[[view]]
angle_deg = 45.0
folder = "views/000"
)";

/// A scan folder of 12 x 10 pixels whose every frame is grey.
class SmallFolder {
 public:
  SmallFolder() {
    Rig rig = make_paper_rig({.columns = 12, .rows = 10});
    rig.turntable = Turntable{.point_mm = {0.0, 0.0, 490.0}};
    write_rig(path() / "rig.toml", rig);
    write_text("scan.toml", kScan);
    std::filesystem::create_directories(view());
    for (const char* name : {"fringe-0", "fringe-1", "fringe-2", "fringe-3", "line-0"})
      write_png(view() / (std::string(name) + ".png"), Frame(Image<std::uint8_t>(12, 10, 80)));
  }
  [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }
  [[nodiscard]] std::filesystem::path view() const { return path() / "views/000"; }
  void write_text(const std::string& name, const std::string& text) const {
    std::ofstream(path() / name) << text;
  }
  void replace(const std::string& file, const std::string& from, const std::string& to) const {
    std::ifstream in(path() / file);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write_text(file, text.replace(at, from.size(), to));
  }

 private:
  TemporaryFolder folder_;
};

inline void expect_names(const std::string& sentence, const std::string& what) {
  EXPECT_NE(sentence.find(what), std::string::npos) << sentence;
}

}  // namespace frangia::testing
