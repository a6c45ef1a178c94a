// A camera that is not sharp, before a part with dark paint.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/geometry/ray_scene.h"
#include "frangia/inspect/surface_error.h"
#include "frangia/inspect/surface_validity.h"
#include "frangia/reconstruct/reconstruct.h"

#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

TEST(CameraBlur, IsCorrectedAtEdgesOfPaintAndTheRestIsInSigma) {
  const testing::TemporaryFolder folder;
  const Scan scan =
      testing::small_scan(folder.path(),
                          "ball-bar",
                          "digital",
                          1,
                          {.samples_per_px = 16, .camera_blur_px = 0.7, .checker_mm = 8.0});
  const RayScene truth(make_part("ball-bar"));
  std::vector<std::string> notes;
  frangia::Run run;
  run.on_note = [&](const std::string& note) { notes.push_back(note); };
  const Reconstruction corrected = reconstruct(scan, {}, run);
  ReconstructOptions leave;
  leave.decode.undo_blur = false;
  const Reconstruction left = reconstruct(scan, leave);
  EXPECT_LT(surface_error(corrected.mesh, truth).rms_mm,
            0.5 * surface_error(left.mesh, truth).rms_mm);
  EXPECT_LT(surface_validity(corrected.mesh, truth).sigma_ratio, 1.3);
  EXPECT_GT(surface_validity(left.mesh, truth).sigma_ratio, 2.0);
  // The rest lay beyond the border of the part, where only blur shows it.
  EXPECT_GT(100 * corrected.mesh.vertices_mm.size(), 95 * left.mesh.vertices_mm.size());
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find("blur of the camera") != std::string::npos;
  })) << ::testing::PrintToString(notes);
}

TEST(CameraBlur, OfAPartOfFewPixelsIsNoFaultOfTheRig) {
  const testing::TemporaryFolder folder;
  const Scan scan = testing::small_scan(
      folder.path(), "shaft", "digital", 8, {.samples_per_px = 2, .camera_blur_px = 0.5}, 4);
  const RayScene truth(make_part("shaft"));
  const Reconstruction found = reconstruct(scan, {});
  ASSERT_TRUE(found.registration);
  EXPECT_TRUE(found.registration->trustworthy);
  EXPECT_EQ(found.registration->explanation.best, PoseCause::AsStated)
      << found.registration->explanation.text;
  // What is left at the limbs is alike in all views and moves the axis by 0.04 mm.
  EXPECT_LT(surface_validity(found.mesh, truth).sigma_ratio, 1.6);
}

}  // namespace
}  // namespace frangia
