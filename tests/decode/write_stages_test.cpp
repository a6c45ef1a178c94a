#include "frangia/decode/write_stages.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "frangia/dataset/read_frames.h"
#include "frangia/range/triangulate.h"

#include "support/small_scan.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using testing::text_of;

TEST(WriteStages, WritesEveryFileThatItNamesAndAPageThatShowsEachPictureWithItsCaption) {
  const testing::TemporaryFolder folder;
  const Scan scan = testing::small_scan(folder.path() / "scan", "bracket", "angular", 1, {}, 4);
  const auto rays = rays_of(scan.rig.reference().model);
  DecodeOptions options;
  options.spatial.keep_growth_order = true;
  DecodedView decoded = decode_view(read_frames(scan, 0), scan.rig, rays, options);
  const RangeGrid range = triangulate(decoded.directions.front().phase, scan.rig, rays);
  const auto files = write_stages(decoded, range, folder.path() / "stages");
  const std::string page = text_of(folder.path() / "stages/index.html");
  for (const StageFile& file : files) {
    EXPECT_GT(std::filesystem::file_size(folder.path() / "stages" / file.name), 100U) << file.name;
    EXPECT_FALSE(file.caption.empty()) << file.name;
    if (std::filesystem::path(file.name).extension() != ".png") continue;
    EXPECT_NE(page.find("src=\"" + file.name), std::string::npos) << file.name;
    EXPECT_NE(page.find(file.caption), std::string::npos) << file.caption;
  }
  for (const char* name : {"fringe-residues.png", "growth.png", "regions.png", "fringes.png"}) {
    EXPECT_TRUE(std::any_of(files.begin(), files.end(), [&](const StageFile& file) {
      return file.name == name;
    })) << name;
  }
}

TEST(WriteStages, SaysWhenTheFolderCannotBeMade) {
  const testing::TemporaryFolder folder;
  std::ofstream(folder.path() / "taken") << "a file";
  EXPECT_THROW(write_stages({}, {}, folder.path() / "taken"), Error);
}

}  // namespace
}  // namespace frangia
