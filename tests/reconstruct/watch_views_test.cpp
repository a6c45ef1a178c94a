#include "frangia/reconstruct/watch_views.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/pose_faults.h"

namespace frangia {
namespace {

using testing::bracket;
using testing::FaultyScan;

/// What is found at each view of a scan, as it comes.
std::vector<WatchedView> watched(const FaultyScan& scan) {
  ViewWatch watch(scan.stated);
  std::vector<WatchedView> all;
  for (std::size_t view = 0; view < scan.views.size(); ++view) {
    all.push_back(watch.compare(
        view, scan.stated_angles_rad[view], 0, scan.take(bracket(), view).range, scan.pattern));
  }
  return all;
}

TEST(ViewWatch, FindsNothingInASoundScan) {
  FaultyScan scan(8);
  scan.misalign(0.4, 0.002, 0.001);  // as a rig may be off without being at fault
  for (const WatchedView& view : watched(scan))
    EXPECT_EQ(view.finding, "");
}

TEST(ViewWatch, SaysAtOnceThatThePartMoved) {
  FaultyScan scan(8);
  scan.slide(5, Eigen::Vector3d(0.5, 0.3, 0.0));
  const std::vector<WatchedView> all = watched(scan);
  for (std::size_t view = 0; view < all.size(); ++view)
    EXPECT_EQ(all[view].finding.empty(), view != 5) << view << ": " << all[view].finding;
  EXPECT_NE(all[5].finding.find("mm before view 6"), std::string::npos) << all[5].finding;
  // Five views know where a single one is to a quarter of this motion.
  EXPECT_NEAR(all[5].moved_mm, std::hypot(0.5, 0.3), 1.5 * all[5].moved_sigma_mm);
  EXPECT_LT(all[5].moved_sigma_mm, 0.16);
}

TEST(ViewWatch, ComparesNothingAcrossSetups) {
  FaultyScan scan(4);
  scan.slide(2, Eigen::Vector3d(5.0, 3.0, 0.0));
  ViewWatch watch(scan.stated);
  for (std::size_t view = 0; view < scan.views.size(); ++view) {
    const int setup = view < 2 ? 0 : 1;
    const WatchedView found = watch.compare(
        view, scan.stated_angles_rad[view], setup, scan.take(bracket(), view).range, scan.pattern);
    EXPECT_EQ(found.finding, "") << view;
  }
}

}  // namespace
}  // namespace frangia
