#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "frangia/acquisition/internal/capture_devices.h"

#include "support/error_of.h"
#include "support/simulated_capture.h"

namespace frangia {
namespace {

using testing::error_of;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A pattern of each kind that devices show.
std::vector<Pattern> patterns_of_each_kind(const Rig& rig) {
  Pattern fringe{.name = "fringe", .shifts_rad = {0.0, 1.0, 2.0}};
  (rig.projector.is_angular() ? fringe.fringes_per_degree : fringe.period_px) = 10.0;
  return {fringe,
          {.name = "line", .kind = PatternKind::Line},
          {.name = "gray", .kind = PatternKind::Gray, .bits = 3},
          {.name = "ramp", .kind = PatternKind::Ramp, .levels = {0.0, 0.5, 1.0}}};
}

class CheckDevices : public testing::SimulatedCapture {
 protected:
  /// The kinds of patterns that the devices can show.
  [[nodiscard]] std::string shown() {
    const RigDevices devices = open();
    std::string kinds;
    for (const Pattern& pattern : patterns_of_each_kind(plan_.rig)) {
      plan_.patterns = {pattern};
      if (complaint(devices).empty()) kinds += pattern.name + " ";
    }
    return kinds;
  }
  [[nodiscard]] std::string complaint(const RigDevices& devices) const {
    try {
      check_devices(devices, plan_, {});
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Input) << error.what();
      return error.what();
    }
    return {};
  }
};

TEST_F(CheckDevices, RefusesEachKindOfPatternThatTheDevicesCannotShow) {
  EXPECT_EQ(shown(), "fringe line ");
  devices_.erase("line");
  EXPECT_EQ(shown(), "fringe ");
  devices_.erase("fringes");
  EXPECT_EQ(shown(), "");
  use("digital", 4);
  devices_.erase("line");
  EXPECT_EQ(shown(), "fringe gray ramp ");
  devices_.erase("fringes");
  EXPECT_EQ(shown(), "");
}

TEST_F(CheckDevices, RefusesARampOfAnInterferometerBeforeAnyLightIsOn) {
  Pattern ramp{.name = "ramp", .kind = PatternKind::Ramp, .levels = {0.0, 0.5, 1.0}};
  plan_.patterns.insert(plan_.patterns.begin(), ramp);
  RigDevices devices = open();
  const std::string sentence = error_of([&] { static_cast<void>(capture_scan(plan_, devices)); });
  EXPECT_TRUE(contains(sentence, "the pattern \"ramp\" is a grey ramp, which simulated piezo"))
      << sentence;
  EXPECT_FALSE(devices.light->is_on());
  EXPECT_FALSE(std::filesystem::exists(plan_.folder));
}

TEST_F(CheckDevices, RefusesValuesThatTheDevicesCannotShow) {
  const Pattern fringe = plan_.patterns.front();
  const auto expect = [&](const std::string& part, const auto& change) {
    plan_.patterns = {fringe};
    change(plan_.patterns.front());
    const std::string sentence = complaint(open());
    EXPECT_TRUE(contains(sentence, part)) << part << ": " << sentence;
  };
  expect("has no frames", [](Pattern& pattern) { pattern.shifts_rad.clear(); });
  expect("not a finite number", [](Pattern& pattern) { pattern.shifts_rad[1] = std::nan(""); });
  expect("has no fringes_per_degree", [](Pattern& pattern) { pattern.fringes_per_degree = 0.0; });
  expect("the exposure 1e+06 ms is outside the range",
         [](Pattern& pattern) { pattern.exposures_ms = {1e6}; });
  devices_["fringes"] = "driver = \"simulated-piezo\"\nmax_command = 5\ncommand_per_turn = 10\n";
  expect("which simulated piezo cannot show: the phase curve spans", [](Pattern& pattern) {
    pattern.shifts_rad = {0.0, 1.5 * kPi};
  });
  devices_["fringes"] =
      "driver = \"simulated-piezo\"\nmax_command = 12\ncommand_per_turn = 10\n"
      "fringes_per_degree = 3.5\n";
  expect("but simulated piezo shows 3.5",
         [](Pattern& pattern) { pattern.fringes_per_degree = 7.0; });
  use("digital", 4);
  plan_.patterns.front().period_px = 0.0;
  EXPECT_TRUE(contains(complaint(open()), "has no period_px above 0"));
  plan_.patterns = {{.name = "ramp", .kind = PatternKind::Ramp, .levels = {0.0, 2.0}}};
  EXPECT_TRUE(contains(complaint(open()), "has the level 2; levels are from 0 to 1"));
}

}  // namespace
}  // namespace frangia
