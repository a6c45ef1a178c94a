#include "frangia/dataset/capture_times.h"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "frangia/core/durable_log.h"

#include "support/temporary_folder.h"

namespace frangia {
namespace {

TEST(CaptureTimes, AreTheMeansOfTheLastFramesOfEachView) {
  const testing::TemporaryFolder folder;
  Scan scan;
  scan.folder = folder.path();
  scan.views = {{0.0, "views/000"}, {1.0, "views/001"}, {2.0, "views/002"}};
  EXPECT_TRUE(std::isnan(read_capture_times(scan)[0])) << "an imported scan has no manifest";
  std::filesystem::create_directory(folder.path() / "capture");
  DurableLog log(folder.path() / "capture" / "manifest.txt");
  log.append("began 1795734510.250");
  log.append("frame views/000/a-0.png 1c291ca3 1842 attempts=1 scale=1 at=2.000");
  log.append("frame views/000/a-1.png 1c291ca3 1842 attempts=1 scale=1 at=3.000");
  log.append("frame views/001/a-0.png 1c291ca3 1842 attempts=1 scale=1 at=10.000");
  log.append("set views/001/a 0 moved scale=1");
  log.append("frame views/001/a-0.png 1c291ca3 1842 attempts=1 scale=1 at=20.500");
  log.append("frame views/002/a-0.png 1c291ca3 1842 attempts=1 scale=1");
  const std::vector<double> times_s = read_capture_times(scan);
  ASSERT_EQ(times_s.size(), 3U);
  EXPECT_EQ(times_s[0], 2.5);
  EXPECT_EQ(times_s[1], 20.5);
  EXPECT_TRUE(std::isnan(times_s[2])) << "an older capture states none";
}

}  // namespace
}  // namespace frangia
