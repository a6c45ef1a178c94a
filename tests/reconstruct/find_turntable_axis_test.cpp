// The axis of the turntable from the scan of a part.
#include "frangia/reconstruct/find_turntable_axis.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

double distance_mm(const Turntable& one, const Turntable& other) {
  const Eigen::Vector3d apart = one.point_mm - other.point_mm;
  return (apart - apart.dot(other.axis) * other.axis).norm();
}

TEST(FindTurntableAxis, NeedsNoStart) {
  const testing::TemporaryFolder folder;
  Scan scan = testing::small_scan(folder.path() / "scan", "bust", "digital", 8, {}, 3);
  const Turntable truth = *scan.rig.turntable;
  scan.rig.turntable.reset();
  const AxisOfPart found = find_turntable_axis(scan);
  EXPECT_TRUE(found.left_out.empty());
  EXPECT_EQ(found.views, 8U);
  const double turned_rad = std::acos(std::min(1.0, found.table.axis.dot(truth.axis)));
  EXPECT_LT(turned_rad, rad_from_deg(0.02));
  EXPECT_LT(turned_rad, 4.0 * found.table.axis_sigma_rad);
  EXPECT_LT(distance_mm(found.table, truth), 0.02);
  EXPECT_LT(distance_mm(found.table, truth), 4.0 * found.table.point_sigma_mm);
}

TEST(FindTurntableAxis, SaysThatARoundPartDoesNotShowIt) {
  const testing::TemporaryFolder folder;
  const Scan scan = testing::small_scan(folder.path() / "scan", "shaft", "digital", 6, {}, 4);
  try {
    const AxisOfPart found = find_turntable_axis(scan);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Numeric) << error.what();
    EXPECT_NE(std::string(error.what()).find("does not show the axis"), std::string::npos)
        << error.what();
  }
}

TEST(FindTurntableAxis, NeedsThreeAngles) {
  const testing::TemporaryFolder folder;
  const Scan scan = testing::small_scan(folder.path() / "scan", "bust", "digital", 2, {}, 4);
  try {
    static_cast<void>(find_turntable_axis(scan));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Input);
    EXPECT_NE(std::string(error.what()).find("2 different angles"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace frangia
