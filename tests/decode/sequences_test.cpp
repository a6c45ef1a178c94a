// Scans of every sequence and at several exposures, from the simulated rig through the folder on
// disk to the mesh.
#include <string>

#include <gtest/gtest.h>

#include "frangia/inspect/surface_error.h"
#include "frangia/reconstruct/reconstruct.h"

#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::TemporaryFolder;

/// Error of a ball bar's mesh, scanned with these patterns, read back from its folder.
struct Measured {
  SurfaceError error;
  std::size_t points = 0;
};
Measured measure(const PatternPlan& patterns, SimulateOptions options = {}) {
  const TemporaryFolder folder;
  Scan plan;
  plan.folder = folder.path();
  plan.rig = testing::small_rig("digital");
  plan.patterns = default_patterns(plan.rig, patterns);
  for (int i = 0; i < 2; ++i)
    plan.views.push_back({kTwoPi * i / 2, "views/" + std::to_string(i)});
  options.samples_per_px = 4;
  static_cast<void>(simulate_scan(make_part("ball-bar"), plan, options));
  const Scan scan = read_scan(folder.path());
  for (std::size_t i = 0; i < plan.patterns.size(); ++i) {
    EXPECT_EQ(scan.patterns[i].kind, plan.patterns[i].kind);
    EXPECT_EQ(scan.patterns[i].frame_count(), plan.patterns[i].frame_count());
    EXPECT_EQ(scan.patterns[i].exposures_ms, plan.patterns[i].exposures_ms);
  }
  const Reconstruction result = reconstruct(scan);
  return {surface_error(result.mesh, RayScene(make_part("ball-bar"))), result.points};
}

TEST(Sequences, EachMeasuresTheSamePart) {
  for (const char* name : {"doubling", "negative-exponential", "heterodyne", "gray"}) {
    const Measured found = measure({.sequence = name});
    EXPECT_GT(found.points, 30000U) << name;
    EXPECT_LT(found.error.rms_mm, 0.1) << name;
  }
}

TEST(Sequences, GrayCodeNeedsNoInvertedFrames) {
  const Measured found = measure({.sequence = "gray", .inverted = false});
  EXPECT_GT(found.points, 30000U);
  EXPECT_LT(found.error.rms_mm, 0.1);
}

TEST(Sequences, ASecondExposureRecoversAPartTooBrightForTheFirst) {
  const SimulateOptions shiny{.exposure = 3.0};
  const Measured one = measure({.sequence = "gray"}, shiny);
  const Measured two = measure({.sequence = "gray", .exposures_ms = {8.0, 2.0}}, shiny);
  EXPECT_GT(two.points, 1.5 * static_cast<double>(one.points));
  EXPECT_LT(two.error.rms_mm, 0.1);
}

}  // namespace
}  // namespace frangia
