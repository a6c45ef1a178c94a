// Frames of another depth than those that the rig was calibrated with.
#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frangia/core/run.h"
#include "frangia/dataset/import_frames.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"

#include "dataset/import_fixture.h"

namespace frangia {
namespace {

using ImportDepth = testing::ImportFixture;

TEST_F(ImportDepth, LeavesOutTheNoiseThatTheRigStatesForFramesOfAnotherDepth) {
  Rig rig = rig_of_images();
  rig.reference().white_level = 255;
  rig.reference().noise = NoiseModel::from_camera(78.0, 8.0);
  options_.rig = images().parent_path() / "rig.toml";
  write_rig(options_.rig, rig);
  for (int k = 0; k < 4; ++k)
    write<std::uint16_t>(fmt::format("a_{:02}.png", k), 1000 * k + 500);
  std::string warned;
  frangia::Run seen;  // not that of the fixture
  seen.on_warning = [&](const std::string& text) { warned += text; };
  static_cast<void>(import_frames(plan_import(images(), options_), target(), seen));
  const Rig imported = read_rig(target() / "rig.toml");
  EXPECT_EQ(imported.reference().white_level, 4095);
  EXPECT_FALSE(imported.reference().noise);
  EXPECT_NE(warned.find("white level of 255 counts, and these have 4095"), std::string::npos)
      << warned;
}

}  // namespace
}  // namespace frangia
