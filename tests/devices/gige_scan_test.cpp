// Scans through GigE Vision with Aravis' fake camera, which shows the simulated rig.
#include <gtest/gtest.h>

#ifdef FRANGIA_WITH_ARAVIS

#include <cstdio>
#include <cstring>

#include <fmt/format.h>

#include "frangia/acquisition/capture_scan.h"
#include "frangia/devices/internal/aravis_driver.h"
#include "frangia/inspect/surface_error.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/rig/write_rig.h"
#include "frangia/simulate/internal/simulated_devices.h"
#include "frangia/simulate/simulated_drivers.h"

#include "support/fake_gige_camera.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::FakeExposure;
using testing::FakeGigeCamera;

class GigeScan : public ::testing::Test {
 protected:
  GigeScan() : fake_("FRANGIA2", folder_.path(), [this](const auto& e, auto* p) { paint(e, p); }) {
    plan_.rig = testing::small_rig("angular");
    plan_.rig.reference().noise = NoiseModel::from_camera(78.4, 8.0);
    plan_.patterns = default_patterns(plan_.rig);
    plan_.name = "gige";
    plan_.folder = folder_.path() / "scan";
    for (int i = 0; i < 6; ++i)
      plan_.views.push_back({kTwoPi * i / 6, "views/" + std::to_string(i)});
    DeviceSettings part("rig.toml", "camera", {{"part", std::string("ball-bar")}});
    static_cast<void>(open_simulated_camera(part, plan_.rig, bench_));
  }

  /// The present image of the simulated rig, with different noise in each exposure.
  void paint(const FakeExposure& exposure, std::uint8_t* pixels) {
    bench_->camera.exposure_ms = 1e-3 * exposure.exposure_us;
    const Frame frame = camera_.capture(*bench_, {0, "gige", ++exposures_, 0, 0});
    const auto& image = std::get<Image<std::uint8_t>>(frame);
    ASSERT_EQ(image.width(), exposure.width_px);
    std::memcpy(pixels, image.pixels().data(), image.pixels().size());
  }

  [[nodiscard]] RigDevices open() {
    std::vector<Driver> drivers = simulated_drivers(bench_);
    drivers.push_back(aravis_driver());
    const auto file = folder_.path() / "rig.toml";
    write_rig(file, plan_.rig);
    std::ofstream(file, std::ios::app)
        << "\n[devices.camera]\ndriver = \"aravis\"\nid = \"127.0.0.1\"\n"
        << "region_px = [0, 0, 256, 256]\n[devices.fringes]\ndriver = \"simulated-piezo\"\n"
        << "command_per_turn = 10\ngain_error = 0.05\nhysteresis = 0.8\n"
        << "[devices.light]\ndriver = \"simulated\"\n[devices.line]\ndriver = \"simulated\"\n"
        << "[devices.turntable]\ndriver = \"simulated\"\n";
    return open_devices(file, plan_.rig, drivers, Deadline::in(10.0));
  }
  [[nodiscard]] static double p95_of(const std::filesystem::path& folder) {
    return surface_error(reconstruct(read_scan(folder)).mesh, RayScene(make_ball_bar())).p95_mm;
  }

  testing::TemporaryFolder folder_;
  std::shared_ptr<SimulatedBench> bench_ = std::make_shared<SimulatedBench>();
  BenchCamera camera_;
  int exposures_ = 0;
  Scan plan_;
  FakeGigeCamera fake_;
};

TEST_F(GigeScan, WithLostPacketsIsCompleteAndAsAccurateAsARenderedScan) {
  fake_.set_packet_loss(0.005);
  RigDevices devices = open();
  const CaptureReport report = capture_scan(plan_, devices);
  EXPECT_EQ(report.captured, 30U);
  EXPECT_TRUE(report.skipped.empty());
  EXPECT_GT(report.frame_retries, 0U);
  Scan rendered = plan_;
  rendered.folder = folder_.path() / "rendered";
  static_cast<void>(simulate_scan(make_ball_bar(), rendered));
  const double captured_mm = p95_of(plan_.folder);
  const double rendered_mm = p95_of(rendered.folder);
  EXPECT_LT(captured_mm, 1.15 * rendered_mm + 0.002);
  fmt::print(
      "FIGURE {{\"retries\": {}, \"frames\": {}, \"captured_mm\": {:.4f}, \"rendered_mm\": "
      "{:.4f}}}\n",
      report.frame_retries,
      report.captured,
      captured_mm,
      rendered_mm);
}

}  // namespace
}  // namespace frangia

#endif
