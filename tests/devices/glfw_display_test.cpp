#include "frangia/devices/internal/glfw_display.h"

#include <gtest/gtest.h>

#ifdef FRANGIA_WITH_GLFW

#include <cmath>
#include <stop_token>
#include <thread>
#include <utility>

#include <dlfcn.h>

#include "support/error_of.h"
#include "support/run_program.h"
#include "support/soon.h"
#include "support/temporary_folder.h"
#include "support/test_screen.h"
#include "support/wait_until.h"

#ifdef __SANITIZE_ADDRESS__
// The leak sanitizer would report memory that a graphics driver keeps until it is unloaded.
extern "C" int dlclose(void* /*library*/) noexcept {
  return 0;
}
#endif

namespace frangia {
namespace {

using testing::error_of;
using testing::soon;
using testing::TestScreen;

/// An image in which all neighbouring pixels differ.
Image<float> checked(const DisplayInfo& info) {
  Image<float> light(info.width_px, info.height_px);
  for (int y = 0; y < info.height_px; ++y) {
    for (int x = 0; x < info.width_px; ++x)
      light(x, y) = static_cast<float>((7 * x + 13 * y) % 256) / 255.0F;
  }
  return light;
}

int wrong_pixels(const Image<std::uint8_t>& seen, const Image<float>& shown, int left) {
  int wrong = 0;
  for (int y = 0; y < shown.height(); ++y) {
    for (int x = 0; x < shown.width(); ++x)
      wrong += seen(left + x, y) != std::lround(255.0F * shown(x, y)) ? 1 : 0;
  }
  return wrong;
}

std::vector<std::string> xvfb() {
  return {"Xvfb", "-screen", "0", "320x240x24"};
}

TEST(GlfwDisplay, ShowsEveryPixelAtItsRequestedLevel) {
  const TestScreen screen(xvfb());
  if (!screen.runs()) GTEST_SKIP() << "install xvfb";
  const testing::TemporaryFolder folder;
  const auto display = open_glfw_display({.delay_s = 0.0});
  ASSERT_EQ(display->info().width_px, 320);
  const Image<float> picture = checked(display->info());
  display->show(picture, soon());
  EXPECT_EQ(wrong_pixels(screen.read_back(folder.path()), picture, 0), 0);
  display->show_dark(soon());
  EXPECT_EQ(wrong_pixels(screen.read_back(folder.path()), Image<float>(320, 240, 0.0F), 0), 0);
  EXPECT_NE(error_of([&] { display->show(Image<float>(10, 10), soon()); }).find("does not fit"),
            std::string::npos);
}

TEST(GlfwDisplay, CompensatesTheResponseOfTheProjector) {
  const TestScreen screen(xvfb());
  if (!screen.runs()) GTEST_SKIP() << "install xvfb";
  const testing::TemporaryFolder folder;
  GlfwSettings settings;
  settings.delay_s = 0.0;
  std::vector<double> levels;
  std::vector<double> light;
  for (int i = 0; i <= 64; ++i) {
    levels.push_back(i / 64.0);
    light.push_back(std::pow(i / 64.0, 2.2));
  }
  settings.response = make_response_curve(levels, light);
  const auto display = open_glfw_display(settings);
  display->show(Image<float>(320, 240, 0.5F), soon());
  const Image<std::uint8_t> seen = screen.read_back(folder.path());
  EXPECT_NEAR(seen(160, 120), 255.0 * std::pow(0.5, 1.0 / 2.2), 1.0);
}

/// The command of an X server for two monitors, 800 x 600 and 640 x 480 pixels.
std::vector<std::string> two_monitors(const std::filesystem::path& folder) {
  const auto config = folder / "dummy.conf";
  std::ofstream(config) << "Section \"Device\"\nIdentifier \"c\"\nDriver \"dummy\"\nEndSection\n"
                           "Section \"Screen\"\nIdentifier \"s\"\nDevice \"c\"\nDefaultDepth 24\n"
                           "SubSection \"Display\"\nDepth 24\nVirtual 1440 600\nEndSubSection\n"
                           "EndSection\nSection \"ServerFlags\"\nOption \"AutoAddDevices\" "
                           "\"false\"\nOption \"DontVTSwitch\" \"true\"\nEndSection\n";
  return {"Xorg",
          "-config",
          config.string(),
          "-logfile",
          (folder / "log").string(),
          "-novtswitch",
          "-sharevts"};
}

/// Puts the second monitor right of the first one. Returns whether both are there.
bool stand_side_by_side(const TestScreen& screen) {
  const std::string beside =
      "xrandr --addmode DUMMY1 640x480 && "
      "xrandr --output DUMMY1 --mode 640x480 --right-of DUMMY0 && xrandr";
  return screen.runs() && testing::run_shell(beside).exit_code == 0;
}

constexpr const char* kTwoMonitorsNeed =
    "needs root and xserver-xorg-core, xserver-xorg-video-dummy, x11-xserver-utils";

TEST(GlfwDisplay, UsesTheChosenOneOfTwoMonitorsOnly) {
  const testing::TemporaryFolder folder;
  const TestScreen screen(two_monitors(folder.path()));
  if (!stand_side_by_side(screen)) GTEST_SKIP() << kTwoMonitorsNeed;
  const auto found = find_glfw_monitors();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[1].settings, "driver = \"monitor\"\nmonitor = \"DUMMY1\"\n");
  GlfwSettings settings{.monitor = "DUMMY1", .delay_s = 0.0};
  const auto display = open_glfw_display(settings);
  ASSERT_EQ(display->info().width_px, 640);
  const Image<float> picture = checked(display->info());
  display->show(picture, soon());
  const Image<std::uint8_t> seen = screen.read_back(folder.path());
  ASSERT_GE(seen.width(), 1440);
  EXPECT_EQ(wrong_pixels(seen, picture, 800), 0);
  EXPECT_EQ(seen(400, 300), 0) << "the other monitor is unchanged";
}

TEST(GlfwDisplay, ShowsOnEachMonitorItsNumber) {
  const testing::TemporaryFolder folder;
  const TestScreen screen(two_monitors(folder.path()));
  if (!stand_side_by_side(screen)) GTEST_SKIP() << kTwoMonitorsNeed;
  std::stop_source stop;
  std::jthread shows([&] {
    // It ends when it is stopped, which is no failure here.
    static_cast<void>(error_of(
        [&] { identify_glfw_monitors(Deadline::in(testing::kPatience_s, stop.get_token())); }));
  });
  /// Whether a point of a digit is lit, which is half as high as its monitor and half as wide as
  /// high; from 0 to 1 each way.
  const auto lit = [&](int left, int width, int height, double u, double v) {
    const Image<std::uint8_t> seen = screen.read_back(folder.path());
    const double tall = 0.5 * height;
    return seen(left + static_cast<int>(0.5 * width + 0.5 * tall * (u - 0.5)),
                static_cast<int>(0.5 * height + tall * (v - 0.5))) > 128;
  };
  const auto first = [&](double u, double v) { return lit(0, 800, 600, u, v); };
  const auto second = [&](double u, double v) { return lit(800, 640, 480, u, v); };
  EXPECT_TRUE(testing::wait_until([&] { return second(0.95, 0.25); }));  // the last to be shown
  // 0 has all segments but the middle one, 1 those at the right.
  for (const auto& [u, v] : {std::pair(0.05, 0.25), {0.05, 0.75}, {0.5, 0.03}, {0.5, 0.97}}) {
    EXPECT_TRUE(first(u, v)) << u << ", " << v;
    EXPECT_FALSE(second(u, v)) << u << ", " << v;
  }
  EXPECT_TRUE(first(0.95, 0.75) && second(0.95, 0.75));
  EXPECT_FALSE(first(0.5, 0.5) || second(0.5, 0.5));
  stop.request_stop();
  shows.join();
  EXPECT_FALSE(first(0.95, 0.75) || second(0.95, 0.75)) << "the numbers stay";
}

TEST(GlfwDisplay, NamesAMissingMonitorAndTheExistingOnes) {
  {
    const TestScreen screen(xvfb());
    if (!screen.runs()) GTEST_SKIP() << "install xvfb";
    const std::string sentence =
        error_of([] { static_cast<void>(open_glfw_display({.monitor = "projector"})); });
    EXPECT_NE(sentence.find("it does not exist; the monitors are: monitor 0 "), std::string::npos)
        << sentence;
  }
  EXPECT_NE(error_of([] { static_cast<void>(open_glfw_display({})); }).find("no screen found"),
            std::string::npos);
}

}  // namespace
}  // namespace frangia

#endif
