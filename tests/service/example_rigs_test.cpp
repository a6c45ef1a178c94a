#include "frangia/service/example_rigs.h"

#include <gtest/gtest.h>

#include "frangia/devices/device_settings.h"
#include "frangia/rig/read_rig.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

namespace frangia {
namespace {

TEST(ExampleRigs, AreTheFilesOfTheFolderExamples) {
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(FRANGIA_SOURCE_DIR) + "/examples"))
    files += entry.path().extension() == ".toml" ? 1U : 0U;
  EXPECT_EQ(example_rigs().size(), files);
  for (const ExampleRig& example : example_rigs()) {
    EXPECT_EQ(
        example.text,
        testing::text_of(std::string(FRANGIA_SOURCE_DIR) + "/examples/" + example.name + ".toml"));
    EXPECT_GT(description_of(example).size(), 20U) << example.name;
    EXPECT_EQ(description_of(example).find('#'), std::string::npos);
  }
}

TEST(ExampleRigs, StandAloneInAProject) {
  const testing::TemporaryFolder folder;
  for (const ExampleRig& example : example_rigs()) {
    const auto own = folder.path() / example.name;
    std::filesystem::create_directory(own);
    write_example_rig(own / "rig.toml", example.name);
    static_cast<void>(read_rig(own / "rig.toml", {}, RigContent::StartValues));
    for (DeviceSettings& device : read_device_settings(own / "rig.toml")) {
      if (!device.has("true_rig")) continue;
      EXPECT_EQ(device.path("true_rig"), own / "true-rig.toml") << example.name;
      static_cast<void>(read_rig(own / "true-rig.toml"));
    }
  }
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "simulated-maker" / "true-rig.toml"));
  EXPECT_NE(testing::error_of([&] {
              write_example_rig(folder.path() / "rig.toml", "../lab-piezo");
            }).find("lab-piezo, "),
            std::string::npos);
}

}  // namespace
}  // namespace frangia
