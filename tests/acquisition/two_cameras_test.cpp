#include "frangia/acquisition/capture_scan.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/dataset/scan_folder.h"

#include "support/error_of.h"
#include "support/simulated_capture.h"

namespace frangia {
namespace {

class CaptureTwoCameras : public testing::SimulatedCapture {
 protected:
  CaptureTwoCameras() {
    use("binocular", 8);
    CameraModel& model = plan_.rig.cameras.at(1).camera.model;
    model.width_px = 100;
    model.height_px = 80;
    model.focal_px /= 8.0;
    model.principal_point_px /= 8.0;
    plan_.rig.cameras.at(1).camera.noise = plan_.rig.reference().noise;
    devices_["camera-left"] = "driver = \"simulated\"\npart = \"plate\"\n";
    views(2);
  }
};

TEST_F(CaptureTwoCameras, WritesTheFramesOfEachCamera) {
  const CaptureReport report = capture();
  EXPECT_TRUE(report.skipped.empty());
  const Scan scan = read_scan(plan_.folder);
  ASSERT_EQ(scan.rig.cameras.size(), 2U);
  const auto reference = read_frames(scan, 1);
  const auto left = read_frames(scan_of_camera(scan, 1), 1);
  ASSERT_EQ(reference.size(), left.size());
  EXPECT_EQ(width_of(left.front().frames.front()), 100);
  EXPECT_EQ(report.captured, images().size());
  // A later session finds all of them.
  EXPECT_EQ(capture().captured, 0U);
}

TEST_F(CaptureTwoCameras, ContinueWithTheSameBytesAfterAnInterruption) {
  static_cast<void>(capture());
  const auto wanted = images();
  plan_.folder = folder_.path() / "interrupted";
  stop_at_ = 0.4;
  EXPECT_NE(testing::error_of([&] { static_cast<void>(capture()); }), "");
  stop_at_ = 2.0;
  stop_ = {};
  EXPECT_GT(capture().captured, 0U);
  EXPECT_EQ(images(), wanted);
}

TEST_F(CaptureTwoCameras, NameTheDeviceThatIsMissingOrUnknown) {
  const auto complaint = [&] { return testing::error_of([&] { static_cast<void>(capture()); }); };
  devices_["camera-right"] = devices_["camera-left"];
  EXPECT_NE(complaint().find("a camera \"right\" that [[more_cameras]] does not have"),
            std::string::npos)
      << complaint();
  devices_.erase("camera-right");
  devices_.erase("camera-left");
  EXPECT_NE(complaint().find("[devices.camera-left]"), std::string::npos) << complaint();
}

}  // namespace
}  // namespace frangia
