#include "frangia/acquisition/capture_scan.h"

#include <algorithm>
#include <csignal>

#include <sys/resource.h>

#include "frangia/dataset/capture_times.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/inspect/surface_error.h"
#include "frangia/reconstruct/reconstruct.h"

#include "support/error_of.h"
#include "support/simulated_capture.h"

namespace frangia {
namespace {

using testing::error_of;

class CaptureScan : public testing::SimulatedCapture {
 protected:
  [[nodiscard]] std::string complaint(const CaptureOptions& options = {}) {
    return error_of([&] { static_cast<void>(capture(options)); });
  }
};

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(CaptureScan, WritesAScanThatReadsBackWithAnAssessmentOfEachView) {
  const CaptureReport report = capture();
  EXPECT_EQ(report.captured, 15U);
  EXPECT_TRUE(report.skipped.empty());
  ASSERT_EQ(notes_.size(), 4U);  // and the piezo's steps
  EXPECT_TRUE(holds(notes_[2], "view 2 of 3 at 120 degrees: good: contrast 0.")) << notes_[2];
  EXPECT_GT(report.device_s, 0.0);
  const Scan scan = read_scan(plan_.folder);
  EXPECT_EQ(scan.views.size(), 3U);
  EXPECT_EQ(read_frames(scan, 2).size(), 2U);
}

TEST_F(CaptureScan, AssessesAViewOfGrayCodeAlone) {
  use("digital", 4);
  plan_.patterns = default_patterns(plan_.rig, {.sequence = "gray-alone", .fringes = 64.0});
  static_cast<void>(capture());
  const auto assessed = std::find_if(
      notes_.begin(), notes_.end(), [](const auto& note) { return holds(note, "view 1 of 3"); });
  ASSERT_NE(assessed, notes_.end());
  EXPECT_TRUE(holds(*assessed, ": good: ")) << *assessed;
  EXPECT_FALSE(holds(*assessed, "contrast")) << *assessed;
}

/// The scan that was captured and one that was rendered, of the same part: what 95 % of the mesh is
/// within of the truth. At so few pixels a scrap may be off by a fringe, which no RMS forgives.
struct Accuracy {
  double captured_mm = 0.0;
  double rendered_mm = 0.0;
};

Accuracy accuracy_of(const Scan& plan, const std::filesystem::path& rendered) {
  Scan other = plan;
  other.folder = rendered;
  const Mesh part = make_ball_bar();
  static_cast<void>(simulate_scan(part, other, {}));
  const auto p95 = [&](const std::filesystem::path& folder) {
    return surface_error(reconstruct(read_scan(folder)).mesh, RayScene(part)).p95_mm;
  };
  return {p95(plan.folder), p95(rendered)};
}

TEST_F(CaptureScan, OfAnInterferometerIsAsAccurateAsARenderedScan) {
  use("angular", 2);
  devices_["camera"] = "driver = \"simulated\"\npart = \"ball-bar\"\n";
  devices_["fringes"] += "gain_error = 0.05\nhysteresis = 0.8\n";
  views(6);
  static_cast<void>(capture());
  const Accuracy accuracy = accuracy_of(plan_, folder_.path() / "rendered");
  EXPECT_LT(accuracy.captured_mm, 1.15 * accuracy.rendered_mm + 0.002);
  EXPECT_LT(accuracy.captured_mm, 0.25);
}

TEST_F(CaptureScan, OfADigitalProjectorIsAsAccurateAsARenderedScan) {
  use("digital", 4);
  devices_["camera"] = "driver = \"simulated\"\npart = \"ball-bar\"\n";
  views(4);
  static_cast<void>(capture());
  const Accuracy accuracy = accuracy_of(plan_, folder_.path() / "rendered");
  EXPECT_LT(accuracy.captured_mm, 1.15 * accuracy.rendered_mm + 0.002);
  EXPECT_LT(accuracy.captured_mm, 0.1);
}

TEST_F(CaptureScan, InterruptedGoesOnToTheSameBytes) {
  views(2);
  devices_["fringes"] += "gain_error = 0.05\nhysteresis = 1.0\njitter_deg = 0.2\n";
  static_cast<void>(capture());
  const auto whole = bytes();
  for (const double stop_at : {0.05, 0.45, 0.65}) {
    std::filesystem::remove_all(plan_.folder);
    stop_ = std::stop_source();
    stop_at_ = stop_at;
    EXPECT_TRUE(holds(complaint(), "stopped by the user"));
    EXPECT_FALSE(std::filesystem::exists(plan_.folder / "scan.toml"));
    stop_ = std::stop_source();
    stop_at_ = 2.0;
    EXPECT_GT(capture().resumed, 0U) << stop_at;
    EXPECT_TRUE(bytes() == whole) << stop_at;
  }
}

TEST_F(CaptureScan, DamagedFrameIsTakenAgain) {
  static_cast<void>(capture());
  const auto whole = bytes();
  std::filesystem::resize_file(plan_.folder / "views/001/fringe-2.png", 100);
  EXPECT_EQ(capture().captured, 1U);
  EXPECT_TRUE(bytes().at("views/001/fringe-2.png") == whole.at("views/001/fringe-2.png"));
}

TEST_F(CaptureScan, FullDiskKeepsWhatWasCapturedAndGoesOnLater) {
  static_cast<void>(capture());
  const auto whole = bytes();
  std::filesystem::remove_all(plan_.folder);
  std::signal(SIGXFSZ, SIG_IGN);
  ::rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  stop_at_ = 0.5;
  at_the_stop_ = [&] {  // from now on no file may grow beyond this
    const ::rlimit full{1000, before.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &full);
  };
  const std::string sentence = complaint();
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_TRUE(holds(sentence, "free some space")) << sentence;
  EXPECT_FALSE(std::filesystem::exists(plan_.folder / "scan.toml"));
  EXPECT_TRUE(std::filesystem::exists(plan_.folder / "views/001/fringe-0.png"));
  stop_at_ = 2.0;
  EXPECT_GE(capture().resumed, 5U);
  EXPECT_TRUE(bytes().at("views/002/fringe-3.png") == whole.at("views/002/fringe-3.png"));
}

TEST_F(CaptureScan, IncompleteFramesAreTakenAgainAndCounted) {
  devices_["camera"] += "faults = [\"incomplete 1 fringe 1\", \"incomplete 1 fringe 2\"]\n";
  const CaptureReport report = capture();
  EXPECT_EQ(report.frame_retries, 2U);
  EXPECT_TRUE(report.skipped.empty());
  EXPECT_EQ(capture().frame_retries, 2U) << "also reported by a session that had nothing to do";
}

TEST_F(CaptureScan, LostFrameHasItsViewTakenAgain) {
  devices_["camera"] += "faults = [\"lost 1 fringe 2\"]\n";
  const CaptureReport report = capture();
  EXPECT_TRUE(report.skipped.empty());
  EXPECT_EQ(report.captured, 15U);
  EXPECT_EQ(report.resumed, 0U) << "frames from before the fault are of this session";
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_TRUE(
      holds(warnings_.front(), "view 2 is captured again: simulated camera: no frame came"));
}

TEST_F(CaptureScan, StuckTableIsTriedAgainThenTheViewIsSkippedAndNamed) {
  devices_["turntable"] += "faults = [\"alarm 120\", \"stuck 240 always\"]\n";
  const CaptureReport report = capture();
  ASSERT_EQ(report.skipped.size(), 1U);
  EXPECT_TRUE(holds(report.skipped.front().sentence(),
                    "view 3 at 240 degrees: simulated turntable: did not reach 240 degrees"));
  EXPECT_EQ(read_scan(plan_.folder).views.size(), 2U);
  use("angular", 4);  // freed: the same command takes what is missing
  EXPECT_EQ(capture().captured, 5U);
  EXPECT_EQ(read_scan(plan_.folder).views.size(), 3U);
}

TEST_F(CaptureScan, UnpluggedCameraEndsTheScanWhichGoesOnLater) {
  devices_["camera"] += "faults = [\"unplugged 1 fringe 2\"]\n";
  EXPECT_TRUE(holds(complaint(), "simulated camera: is unplugged"));
  EXPECT_TRUE(std::filesystem::exists(plan_.folder / "views/001/fringe-1.png"));
  use("angular", 4);
  EXPECT_EQ(capture().captured, 8U);
}

TEST_F(CaptureScan, LightIsOffAndTheTableDisabledHoweverItEnds) {
  for (const auto* fault : {"", "faults = [\"unplugged 1\"]\n"}) {
    use("angular", 4);
    devices_["camera"] += fault;
    RigDevices devices = open();
    static_cast<void>(error_of([&] { static_cast<void>(capture_scan(plan_, devices)); }));
    EXPECT_FALSE(devices.light->is_on());
    EXPECT_FALSE(devices.laser_sheet->is_on());
    EXPECT_FALSE(devices.turntable->angle_rad());
    EXPECT_TRUE(holds(error_of([&] { devices.turntable->move_to(0.1, Deadline::in(1.0)); }),
                      "is not enabled"));
    std::filesystem::remove_all(plan_.folder);
  }
}

TEST_F(CaptureScan, SetThatShowsMotionIsTakenAgainAndItsFramesKept) {
  devices_["camera"] += "faults = [\"motion 1 fringe\"]\n";
  const CaptureReport report = capture();
  EXPECT_EQ(report.set_retakes, 1U);
  EXPECT_TRUE(std::filesystem::exists(plan_.folder / "views/001/rejected/0-fringe-3.png"));
  EXPECT_TRUE(std::filesystem::exists(plan_.folder / "views/001/fringe-3.png"));
}

TEST_F(CaptureScan, StatesWhenEachViewWasTakenAcrossSessions) {
  stop_at_ = 0.6;
  EXPECT_ANY_THROW(static_cast<void>(capture()));
  stop_ = std::stop_source();
  stop_at_ = 2.0;
  static_cast<void>(capture());
  const Scan scan = read_scan(plan_.folder);
  const std::vector<double> times_s = read_capture_times(scan);
  ASSERT_EQ(times_s.size(), scan.views.size());
  EXPECT_GE(times_s.front(), 0.0);
  for (std::size_t i = 1; i < times_s.size(); ++i)
    EXPECT_GT(times_s[i], times_s[i - 1]);
}

TEST_F(CaptureScan, StepsOfThePiezoAreCorrectedAfterTheFirstSet) {
  devices_["fringes"] += "gain_error = 0.05\n";
  static_cast<void>(capture());
  const std::string manifest = bytes().at("capture/manifest.txt");
  const std::size_t scale = manifest.find("set views/000/fringe 0 good scale=0.95");
  EXPECT_NE(scale, std::string::npos) << manifest;
}

TEST_F(CaptureScan, AutomaticExposureUsesTheCameraWithoutSaturating) {
  CaptureOptions options;
  options.camera.exposure_ms = 0.5;
  options.exposure = ExposureChoice::Automatic;
  const CaptureReport report = capture(options);
  ASSERT_EQ(report.exposures_ms.size(), 1U);
  EXPECT_GT(report.exposures_ms.front(), 9.0);  // at 10 ms the brightest is at 80 % of white
  EXPECT_LT(report.exposures_ms.front(), 16.0);
}

TEST_F(CaptureScan, BracketTakesAShinyPartAtSeveralExposuresAndADullOneAtFew) {
  views(1);
  devices_["camera"] = "driver = \"simulated\"\npart = \"ball-bar\"\n";
  CaptureOptions options;
  options.exposure = ExposureChoice::Bracketed;
  const std::size_t dull = capture(options).exposures_ms.size();
  std::filesystem::remove_all(plan_.folder);
  devices_["camera"] += "gloss = 60\nshininess = 30\n";
  const CaptureReport report = capture(options);
  EXPECT_GT(report.exposures_ms.size(), dull);
  const Scan scan = read_scan(plan_.folder);
  EXPECT_EQ(scan.patterns.front().exposures_ms, report.exposures_ms);
  EXPECT_EQ(read_frames(scan, 0).size(), report.exposures_ms.size() + 1);  // and the line
}

TEST_F(CaptureScan, FolderOfFramesIsReplayed) {
  static_cast<void>(capture());
  const auto first = bytes();
  devices_["camera"] = "driver = \"folder\"\nfolder = \"" + plan_.folder.string() + "\"\n";
  plan_.folder = folder_.path() / "again";
  static_cast<void>(capture());
  EXPECT_TRUE(bytes().at("views/002/fringe-0.png") == first.at("views/002/fringe-0.png"));
}

TEST_F(CaptureScan, BadPlanIsOneSentence) {
  devices_["turntable"] += "min_deg = 0\nmax_deg = 200\n";
  EXPECT_TRUE(holds(complaint(), "the view at 240 degrees is outside its limits, 0 to 200"));
  EXPECT_FALSE(std::filesystem::exists(plan_.folder)) << "nothing was begun";
  use("angular", 4);
  static_cast<void>(capture());
  plan_.patterns.front().shifts_rad.pop_back();
  EXPECT_TRUE(holds(complaint(), "holds another scan"));
  devices_.erase("fringes");
  EXPECT_TRUE(holds(complaint(), "[devices.fringes]"));
}

TEST_F(CaptureScan, CameraOfAnotherSizeThanTheRigIsRefused) {
  static_cast<void>(capture());
  devices_["camera"] = "driver = \"folder\"\nfolder = \"" + plan_.folder.string() + "\"\n";
  plan_.rig.reference().model.width_px += 2;
  EXPECT_TRUE(holds(complaint(), "camera.size_px is not the 128 x 128 pixels"));
}

}  // namespace
}  // namespace frangia
