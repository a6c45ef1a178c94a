#include "frangia/service/capture_settings.h"

#include <fstream>

#include <gtest/gtest.h>

#include "frangia/simulate/rig_presets.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::error_of;

TEST(CaptureSettings, AreReadAsTheyWereWritten) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "capture.json";
  EXPECT_TRUE(read_capture_settings(file) == CaptureSettings{});
  CaptureSettings settings;
  settings.camera = {.exposure_ms = 3.5, .gain_db = 6.0, .black_level_counts = 2.0};
  settings.exposures_ms = {2.0, 8.0};
  settings.shifts = 8;
  settings.algorithm = "least-squares";
  write_capture_settings(file, settings);
  EXPECT_TRUE(read_capture_settings(file) == settings);
  for (const Pattern& pattern : patterns_of(settings, rig_preset("digital"))) {
    EXPECT_EQ(pattern.frame_count(), 8);
    EXPECT_EQ(pattern.exposures_ms, settings.exposures_ms);
  }
}

TEST(CaptureSettings, OfEarlierVersionsHaveOneExposure) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "capture.json";
  std::ofstream(file) << R"({"exposure_ms": 7, "gain_db": 0, "black_level_counts": 0, "shifts": 4,
                             "algorithm": "auto"})";
  const CaptureSettings settings = read_capture_settings(file);
  EXPECT_EQ(settings.camera.exposure_ms, 7.0);
  EXPECT_TRUE(settings.exposures_ms.empty());
}

TEST(CaptureSettings, NameTheFileThatIsDamaged) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "capture.json";
  for (const char* text :
       {"{",
        "[]",
        "{}",
        R"({"exposure_ms": -1, "gain_db": 0, "black_level_counts": 0, "shifts": 4,
                            "algorithm": "auto"})",
        R"({"exposure_ms": 1, "gain_db": 0, "black_level_counts": 0, "shifts": 4,
            "algorithm": "nobody's"})",
        R"({"exposure_ms": 1, "gain_db": 0, "black_level_counts": 0, "shifts": 4,
            "algorithm": "auto", "exposures_ms": [1, -2]})",
        R"({"exposure_ms": 1, "gain_db": 0, "black_level_counts": 0, "shifts": 4,
            "algorithm": "auto", "exposures_ms": [1, 2, 3, 4, 5, 6, 7]})"}) {
    std::ofstream(file) << text;
    const std::string error = error_of([&] { static_cast<void>(read_capture_settings(file)); });
    EXPECT_NE(error.find("capture.json"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace frangia
