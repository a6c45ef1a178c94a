// The folder of a capture: lock, manifest, plan, and what belongs to the same scan.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include "frangia/acquisition/capture_scan.h"
#include "frangia/acquisition/internal/capture_manifest.h"

#include "support/error_of.h"
#include "support/simulated_capture.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using testing::error_of;
using testing::text_of;
using Bytes = std::map<std::string, std::string>;

class CaptureFolder : public testing::SimulatedCapture {
 protected:
  CaptureFolder() { views(2); }
  [[nodiscard]] std::string complaint() {
    return error_of([&] { static_cast<void>(capture()); });
  }
  [[nodiscard]] std::filesystem::path manifest() const {
    return plan_.folder / "capture/manifest.txt";
  }
  void write_manifest(const std::string& text) const {
    std::ofstream(manifest(), std::ios::binary) << text;
  }
};

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Limits the size of files, like a full disk, from construction to destruction.
class FullDisk {
 public:
  explicit FullDisk(::rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const ::rlimit full{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &full);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  FullDisk(FullDisk&&) = delete;
  FullDisk& operator=(FullDisk&&) = delete;
  ~FullDisk() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  ::rlimit before_{};
};

TEST_F(CaptureFolder, IsRefusedToASecondScanWithFolderAndProcess) {
  const FolderLock lock(plan_.folder);
  const std::string sentence = complaint();
  EXPECT_TRUE(mentions(sentence, plan_.folder.string())) << sentence;
  EXPECT_TRUE(mentions(sentence, fmt::format("process {} on ", ::getpid()))) << sentence;
}

TEST_F(CaptureFolder, HoldsNoLockAndNoTemporaryFileAfterTheScan) {
  static_cast<void>(capture());
  for (const auto& [file, content] : bytes())
    EXPECT_NE(std::filesystem::path(file).filename().string().front(), '.') << file;
}

TEST_F(CaptureFolder, WithAWrongBitInTheManifestNeedsNoFrameAgain) {
  static_cast<void>(capture());
  const Bytes whole = images();
  const std::string text = text_of(manifest());
  for (std::size_t i = 3; i < text.size(); i += text.size() / 12) {
    std::string damaged = text;
    damaged[i] = static_cast<char>(damaged[i] ^ 16);
    write_manifest(damaged);
    EXPECT_EQ(capture().captured, 0U) << "byte " << i;
    EXPECT_TRUE(images() == whole) << "byte " << i;
  }
}

TEST_F(CaptureFolder, RecoversFramesWhoseLinesAreDestroyed) {
  static_cast<void>(capture());
  const Bytes whole = images();
  const std::string text = text_of(manifest());
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin)) {
    std::string damaged = text;
    damaged.replace(begin, end - begin, std::string(end - begin, '\0'));
    write_manifest(damaged);
    EXPECT_EQ(capture().captured, 0U) << text.substr(begin, end - begin);
    EXPECT_TRUE(images() == whole) << text.substr(begin, end - begin);
    begin = end + 1;
  }
  write_manifest(std::string(text.size(), 'x') + "\n");
  EXPECT_EQ(capture().captured, 0U) << "all lines";
  EXPECT_TRUE(images() == whole);
}

TEST_F(CaptureFolder, IsContinuedWithTheChosenExposuresWhateverSingleBitOfTheirLineIsWrong) {
  views(1);
  CaptureOptions options;
  options.camera.exposure_ms = 0.5;
  options.exposure = ExposureChoice::Automatic;
  const CaptureReport whole = capture(options);
  const std::string text = text_of(manifest());
  const std::size_t begin = text.find("exposures ");
  const std::size_t end = text.find('\n', begin);
  for (std::size_t bit = 8 * begin; bit < 8 * (end + 1); ++bit) {
    std::string damaged = text;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    write_manifest(damaged);
    ASSERT_EQ(CaptureManifest(plan_.folder).exposures_ms(), whole.exposures_ms) << "bit " << bit;
  }
  std::string destroyed = text;
  destroyed.replace(begin, end - begin, std::string(end - begin, '\0'));
  write_manifest(destroyed);
  const CaptureReport again = capture(options);
  EXPECT_EQ(again.captured, 0U);
  EXPECT_EQ(again.exposures_ms, whole.exposures_ms);
}

TEST_F(CaptureFolder, DoesNotRecoverAFrameThatIsDamagedItself) {
  static_cast<void>(capture());
  const std::string text = text_of(manifest());
  write_manifest(std::string(text.size(), 'x') + "\n");
  const auto frame = plan_.folder / "views/001/fringe-2.png";
  std::string png = text_of(frame);
  png[png.size() / 2] = static_cast<char>(png[png.size() / 2] ^ 1);
  std::ofstream(frame, std::ios::binary) << png;
  EXPECT_EQ(capture().captured, 1U);
}

TEST_F(CaptureFolder, DoesNotRecoverFramesOfARejectedSet) {
  devices_["camera"] += "faults = [\"motion 1 fringe\"]\n";
  static_cast<void>(capture());
  const Bytes whole = images();
  // As if the power had failed right after the rejection: its frames are still in their places.
  std::string text = text_of(manifest());
  const std::string rejection = "set views/001/fringe 0 moved";
  const std::size_t line = text.find(rejection);
  ASSERT_NE(line, std::string::npos) << text;
  text.resize(text.find('\n', line) + 1);
  text[2] = text[3] = 'x';  // and an earlier line is destroyed
  write_manifest(text);
  const auto view = plan_.folder / "views/001";
  for (const int frame : {0, 1, 2, 3})
    std::filesystem::rename(view / fmt::format("rejected/0-fringe-{}.png", frame),
                            view / fmt::format("fringe-{}.png", frame));
  std::filesystem::remove(view / "line-0.png");
  devices_["camera"] = "driver = \"simulated\"\npart = \"plate\"\n";
  EXPECT_EQ(capture().captured, 5U);
  EXPECT_TRUE(images() == whole);
}

TEST_F(CaptureFolder, IsResumedAfterADiskThatFilledWhileThePlanWasStored) {
  static_cast<void>(capture());
  const Bytes whole = images();
  for (const ::rlim_t bytes : {0U, 10U, 100U, 300U, 700U}) {
    std::filesystem::remove_all(plan_.folder);
    {
      RigDevices devices = open();
      const FullDisk disk(bytes);
      const std::string sentence =
          error_of([&] { static_cast<void>(capture_scan(plan_, devices)); });
      EXPECT_TRUE(mentions(sentence, "free some space")) << bytes << ": " << sentence;
    }
    EXPECT_EQ(complaint(), "") << bytes;
    EXPECT_TRUE(images() == whole) << bytes;
  }
}

TEST_F(CaptureFolder, IsNotContinuedThroughALink) {
  const auto outside = plan_.folder.parent_path() / "outside";
  static_cast<void>(capture());
  for (const char* link : {"views", "views/000", "capture", "capture/manifest.txt"}) {
    const auto place = plan_.folder / link;
    std::filesystem::remove(plan_.folder / "scan.toml");
    std::filesystem::remove_all(outside);
    std::filesystem::rename(place, outside);
    std::filesystem::create_symlink(outside, place);
    const std::string sentence = complaint();
    EXPECT_TRUE(mentions(sentence, place.string() + ": is a link to " + outside.string()))
        << link << ": " << sentence;
    std::filesystem::remove(place);
    std::filesystem::rename(outside, place);
  }
  EXPECT_EQ(complaint(), "");
}

TEST_F(CaptureFolder, IsTheSameScanUnderAnotherName) {
  static_cast<void>(capture());
  std::filesystem::rename(plan_.folder, folder_.path() / "renamed");
  plan_.folder = folder_.path() / "renamed/";
  plan_.name = "renamed";
  EXPECT_EQ(capture().resumed, 10U);
  EXPECT_EQ(read_scan(plan_.folder).name, "renamed");
}

TEST_F(CaptureFolder, IsTheSameScanOnceTheAxisOfItsTurntableIsFound) {
  const Turntable axis = plan_.rig.turntable.value();
  write_rig(folder_.path() / "true-rig.toml", plan_.rig);  // how the simulated table turns
  devices_["camera"] += "true_rig = \"true-rig.toml\"\n";
  plan_.rig.turntable.reset();
  static_cast<void>(capture());
  plan_.rig.turntable = axis;
  EXPECT_EQ(capture().resumed, 10U);
  EXPECT_TRUE(read_scan(plan_.folder).rig.turntable.has_value());
  // From now on it is that of this scan.
  plan_.rig.turntable->point_mm.x() += 1.0;
  EXPECT_TRUE(mentions(complaint(), "[turntable]: point_mm")) << complaint();
}

TEST_F(CaptureFolder, OfAnotherPartDeviceOrPlanIsRefusedWithTheDifference) {
  static_cast<void>(capture());
  devices_["camera"] = "driver = \"simulated\"\npart = \"ball-bar\"\n";
  EXPECT_TRUE(mentions(complaint(), "[camera]: part = plate")) << complaint();
  EXPECT_TRUE(mentions(complaint(), "[camera]: part = ball-bar")) << complaint();
  use("angular", 4);
  views(2);
  devices_["turntable"] = "driver = \"simulated\"\nbacklash_deg = 0.7\n";
  EXPECT_TRUE(mentions(complaint(), "[turntable]: backlash_deg = 0.7")) << complaint();
  use("angular", 4);
  views(2);
  plan_.views[1].angle_rad = rad_from_deg(90.0);
  EXPECT_TRUE(mentions(complaint(), "[[view]] 2: angle_deg = 180")) << complaint();
  EXPECT_TRUE(mentions(complaint(), "[[view]] 2: angle_deg = 90")) << complaint();
}

TEST_F(CaptureFolder, IsTheSameScanWhenADeviceHasAnotherSpeedOrLimit) {
  static_cast<void>(capture());
  devices_["turntable"] += "speed_deg_per_s = 1000\nmax_deg = 500\nhome_time_s = 90\n";
  EXPECT_EQ(complaint(), "");
}

TEST_F(CaptureFolder, ReplacesADamagedCopyOfThePlan) {
  static_cast<void>(capture());
  for (const auto* name : {"scan.toml", "rig.toml", "options.txt", "devices.txt"}) {
    const auto file = plan_.folder / "capture" / name;
    const std::string text = text_of(file);
    std::ofstream(file) << text.substr(0, text.size() / 2);
    EXPECT_EQ(complaint(), "") << name;
    EXPECT_EQ(text_of(file), text) << name;
  }
}

TEST_F(CaptureFolder, LosesTheTemporaryFilesOfAKilledSessionAndNoOthers) {
  static_cast<void>(capture());
  const auto leave = [&](const std::string& name) { std::ofstream(plan_.folder / name) << "x"; };
  leave("views/000/.fringe-0.png.frangia-00c0ffee00c0ffee.tmp");
  leave("capture/.scan.toml.frangia-00c0ffee00c0ffee.tmp");
  leave("views/000/.mine.tmp");
  static_cast<void>(capture());
  EXPECT_FALSE(std::filesystem::exists(plan_.folder /
                                       "views/000/.fringe-0.png.frangia-00c0ffee00c0ffee.tmp"));
  EXPECT_FALSE(
      std::filesystem::exists(plan_.folder / "capture/.scan.toml.frangia-00c0ffee00c0ffee.tmp"));
  EXPECT_TRUE(std::filesystem::exists(plan_.folder / "views/000/.mine.tmp"));
}

TEST_F(CaptureFolder, WithFilesOfAnotherKindIsRefusedAndKept) {
  std::filesystem::create_directories(plan_.folder / "capture.new");
  std::ofstream(plan_.folder / "letter.txt") << "x";
  EXPECT_TRUE(mentions(complaint(), "is not empty"));
  EXPECT_TRUE(std::filesystem::exists(plan_.folder / "capture.new"));
  EXPECT_EQ(text_of(plan_.folder / "letter.txt"), "x");
}

}  // namespace
}  // namespace frangia
