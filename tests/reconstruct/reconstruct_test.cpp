#include "frangia/reconstruct/reconstruct.h"

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "frangia/frames/png.h"
#include "frangia/geometry/fit_primitives.h"
#include "frangia/inspect/surface_error.h"

#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

// Limits are about 1.3 times the value that a comment gives as measured. Quantities that should be
// zero and come out far below the noise have a limit above the noise of their last digits instead.

using testing::small_scan;
using testing::TemporaryFolder;

SurfaceError error_of(const Reconstruction& result, const std::string& part) {
  return surface_error(result.mesh, RayScene(make_part(part)));
}

TEST(Reconstruct, MeasuresABustWithADigitalProjector) {
  const TemporaryFolder folder;
  const Scan scan = small_scan(folder.path(), "bust", "digital", 6);
  const Reconstruction result = reconstruct(scan);
  const SurfaceError error = error_of(result, "bust");
  EXPECT_EQ(result.views, 6U);
  EXPECT_GT(result.points, 56000U);  // measured 72495
  EXPECT_LT(error.rms_mm, 0.051);    // measured 0.0396
  EXPECT_LT(error.p99_mm, 0.18);     // measured 0.138
}

TEST(Reconstruct, ResolvesEveryFringeOrderOfThePapersRigByTheLaserSheet) {
  // Half a fringe is 14 mm here: a single view off by one would show.
  struct Limits {
    const char* part;
    double rms_mm;
    double max_mm;
  };
  for (const Limits& limits : {Limits{"shaft", 0.097, 1.54},    // measured 0.0743, 1.18
                               Limits{"bracket", 0.094, 2.55},  // measured 0.0723, 1.96
                               Limits{"blade", 0.23, 2.9}}) {   // measured 0.176, 2.21
    const TemporaryFolder folder;
    const Scan scan = small_scan(folder.path(), limits.part, "angular", 6);
    const SurfaceError error = error_of(reconstruct(scan), limits.part);
    EXPECT_LT(error.rms_mm, limits.rms_mm) << limits.part;
    EXPECT_LT(error.max_mm, limits.max_mm) << limits.part;
  }
}

TEST(Reconstruct, GivesTheSameBytesOnOneThreadAndOnTwo) {
  const TemporaryFolder folder;
  const Scan scan = small_scan(folder.path(), "bracket", "digital", 4);
  std::vector<Mesh> meshes;
  for (const std::size_t threads : {1U, 2U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    meshes.push_back(reconstruct(scan).mesh);
  }
  ASSERT_EQ(meshes[0].vertices_mm.size(), meshes[1].vertices_mm.size());
  EXPECT_EQ(meshes[0].vertices_mm, meshes[1].vertices_mm);
  EXPECT_EQ(meshes[0].triangles, meshes[1].triangles);
  ASSERT_FALSE(meshes[0].sigma_mm.empty());
  EXPECT_FALSE(std::isnan(meshes[0].sigma_mm.front()));
  EXPECT_EQ(meshes[0].sigma_mm, meshes[1].sigma_mm);
}

TEST(Reconstruct, MeasuresAsWellWithTheAxisAndTheAnglesOff) {
  const TemporaryFolder exact;
  const TemporaryFolder off;
  SimulateOptions faults{.samples_per_px = 4};
  faults.axis_offset_mm = 0.5;
  faults.axis_tilt_rad = rad_from_deg(0.3);
  faults.angle_error_rad = rad_from_deg(0.15);
  const Reconstruction wanted =
      reconstruct(small_scan(exact.path(), "bracket", "digital", 6, {.samples_per_px = 4}, 3));
  const Reconstruction found =
      reconstruct(small_scan(off.path(), "bracket", "digital", 6, faults, 3));
  // The ratio is measured as 1.002.
  EXPECT_LT(error_of(found, "bracket").rms_mm, 1.01 * error_of(wanted, "bracket").rms_mm);
  ASSERT_TRUE(found.registration);
  const double axis_sigma_mm = found.registration->axis_sigma_mm;
  EXPECT_LT(axis_sigma_mm, 0.004);
  EXPECT_NEAR(found.registration->axis_moved_mm(), 0.5, 3.0 * axis_sigma_mm);
  // Measured 0.3002 degrees.
  EXPECT_NEAR(found.registration->axis_turned_rad(), rad_from_deg(0.3), rad_from_deg(0.001));
}

TEST(Reconstruct, LeavesTheTurntableTopOut) {
  const TemporaryFolder folder;
  SimulateOptions faults{.samples_per_px = 4};
  faults.turntable_top_radius_mm = 70.0;
  const Scan scan = small_scan(folder.path(), "bracket", "digital", 4, faults, 3);
  const Reconstruction result = reconstruct(scan);
  EXPECT_NEAR(result.turntable_top_height_mm, 0.0, 0.002);  // measured 0.0002
  EXPECT_LT(error_of(result, "bracket").max_mm, 1.54);      // measured 1.18
  ReconstructOptions keep;
  keep.keep_turntable_top = true;
  EXPECT_GT(error_of(reconstruct(scan, keep), "bracket").max_mm, 10.0);
}

TEST(Reconstruct, ClipsBelowAHeightAndBeyondARadius) {
  const TemporaryFolder folder;
  const Scan scan = small_scan(folder.path(), "bracket", "digital", 3);
  ReconstructOptions options;
  options.clip_below_mm = 10.0;
  options.clip_radius_mm = 30.0;
  for (const auto& vertex : reconstruct(scan, options).mesh.vertices_mm) {
    EXPECT_GT(vertex.z(), 9.96F);                // measured 9.971
    EXPECT_LT(vertex.head<2>().norm(), 30.66F);  // measured 30.498
  }
  options.clip_below_mm = 1000.0;
  EXPECT_THROW(static_cast<void>(reconstruct(scan, options)), Error);
}

TEST(Reconstruct, NamesAViewOfAMovedPartAndLeavesItOut) {
  const TemporaryFolder folder;
  const TemporaryFolder moved_folder;
  const Scan scan = small_scan(folder.path(), "bust", "digital", 8, {.samples_per_px = 4}, 3);
  Scan plan = scan;
  plan.folder = moved_folder.path();
  plan.views = {scan.views[3]};
  Mesh moved = make_part("bust");
  const RayScene truth(moved);
  for (Eigen::Vector3f& vertex : moved.vertices_mm)
    vertex += Eigen::Vector3f(4.0F, -3.0F, 0.0F);
  static_cast<void>(simulate_scan(moved, plan, {.samples_per_px = 4}));
  for (const auto& entry : std::filesystem::directory_iterator(moved_folder.path() / "views/3")) {
    std::filesystem::copy_file(entry.path(),
                               folder.path() / "views/3" / entry.path().filename(),
                               std::filesystem::copy_options::overwrite_existing);
  }
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  const Reconstruction result = reconstruct(scan, {}, run);
  ASSERT_EQ(result.view_summaries.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(result.view_summaries[i].left_out, i == 3) << i;
    EXPECT_GT(result.view_summaries[i].points, 0U) << i;
  }
  ASSERT_EQ(warnings.size(), 1U) << ::testing::PrintToString(warnings);
  EXPECT_NE(warnings[0].find("view 3 fits no other view"), std::string::npos) << warnings[0];
  EXPECT_LT(surface_error(result.mesh, truth).rms_mm, 0.069);  // measured 0.0531
}

void darken(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    Frame frame = read_png(entry.path());
    std::visit([](auto& image) { std::fill(image.pixels().begin(), image.pixels().end(), 0); },
               frame);
    write_png(entry.path(), frame);
  }
}

TEST(Reconstruct, LeavesADarkViewOutWithAWarningAndGoesOn) {
  const TemporaryFolder folder;
  const Scan scan = small_scan(folder.path(), "ball-bar", "digital", 4, {}, 4);
  darken(folder.path() / "views/2");
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  const Reconstruction result = reconstruct(scan, {}, run);
  EXPECT_EQ(result.views, 3U);
  ASSERT_EQ(result.view_summaries.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    const ViewSummary& view = result.view_summaries[i];
    EXPECT_EQ(view.name, "views/" + std::to_string(i));
    EXPECT_EQ(view.left_out, i == 2) << i;
    EXPECT_EQ(view.points == 0, i == 2) << i;
    EXPECT_EQ(std::isnan(view.sigma_mm), i == 2) << i;
  }
  EXPECT_FALSE(result.mesh.empty());
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("views/2"), std::string::npos);
}

TEST(Reconstruct, RefusesAScanWithoutALitPixel) {
  const TemporaryFolder folder;
  const Scan scan = small_scan(folder.path(), "plate", "digital", 1, {}, 4);
  darken(folder.path() / "views/0");
  EXPECT_THROW(static_cast<void>(reconstruct(scan)), Error);
}

TEST(Reconstruct, IsRelativeWithAWarningWhenNothingFixesTheFringeOrder) {
  const TemporaryFolder folder;
  Scan scan = small_scan(folder.path(), "bust", "angular", 1, {.samples_per_px = 4}, 3);
  scan.patterns.pop_back();  // the laser sheet
  std::vector<std::string> warnings;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) { warnings.push_back(sentence); };
  const Reconstruction result = reconstruct(scan, {}, run);
  EXPECT_FALSE(result.mesh.empty());
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings[0].find("relative"), std::string::npos);
}

TEST(Reconstruct, StopsWhenAsked) {
  const TemporaryFolder folder;
  const Scan scan = small_scan(folder.path(), "plate", "digital", 1, {}, 4);
  std::stop_source source;
  source.request_stop();
  frangia::Run run;
  run.stop = source.get_token();
  try {
    static_cast<void>(reconstruct(scan, {}, run));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Cancelled);
  }
}

TEST(Reconstruct, MeasuresTheBallBarOfTheSharedScans) {
  const std::filesystem::path shared =
      std::filesystem::path(FRANGIA_SOURCE_DIR) / "../shared/scans/balls";
  if (!std::filesystem::exists(shared)) GTEST_SKIP() << "the shared scans are not on this machine";
  const Reconstruction result = reconstruct(read_scan(shared));
  for (const double y : {-35.0, 35.0}) {
    std::vector<Eigen::Vector3d> near;
    for (const auto& vertex : result.mesh.vertices_mm) {
      const double from_centre = (vertex.cast<double>() - Eigen::Vector3d(0.0, y, 60.0)).norm();
      if (vertex.z() > 47.0F && std::abs(from_centre - 20.0) < 0.5)
        near.emplace_back(vertex.cast<double>());
    }
    const auto sphere = fit_sphere(near);
    EXPECT_NEAR(2.0 * sphere.radius_mm, 40.0, 0.0042);  // measured 39.9968 and 39.9972
    EXPECT_LT(sphere.rms_mm, 0.0156);                   // measured 0.0120 and 0.0114
  }
}

}  // namespace
}  // namespace frangia
