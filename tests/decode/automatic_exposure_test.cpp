// A camera that sets its exposure by itself takes each frame at a gain of its own.
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/decode/explain/explain_frames.h"
#include "frangia/decode/explain/judge_frames.h"

#include "support/rendered_frames.h"

namespace frangia {
namespace {

using testing::RenderedFrames;
using testing::RenderedScene;

/// A coarse fringe, of which the image shows two thirds, so that the frames differ in brightness.
constexpr double kOneFringe_px = 240.0;

/// Frames of a coarse pattern that a camera brings to the same mean, and the frames of a finer one,
/// which have the same mean by themselves.
struct ExposedFrames {
  FrameStack coarse;
  FrameStack fine;
  NoiseModel noise;
  std::vector<double> gains;

  ExposedFrames(RenderedScene scene, int steps, double power = 1.0) {
    scene.period_px = kOneFringe_px;
    RenderedFrames frames(scene, steps);
    for (std::vector<double>& light : frames.frames) {
      const double mean =
          std::accumulate(light.begin(), light.end(), 0.0) / static_cast<double>(light.size());
      gains.push_back(std::pow(50.0 / mean, power));
      for (double& one : light)
        one *= gains.back();
    }
    coarse = frames.stack();
    noise = frames.noise();
    scene.period_px = 18.0;
    fine = RenderedFrames(scene, steps).stack();
    fine.pattern.name = "fine";
  }
  [[nodiscard]] FrameExplanation beside_fine() const {
    const std::array references{&fine};
    return explain_frames(coarse, noise, references);
  }
  [[nodiscard]] FrameVerdict verdict() const {
    const std::array references{&fine};
    return judge_frames(coarse, noise, {.has_other_check = true, .references = references});
  }
};

std::vector<RenderedScene> exposed_scenes() {
  return {{.seed = 61}, {.gamma = 1.4, .seed = 62}, {.flicker = 0.01, .seed = 63}};
}

TEST(AutomaticExposure, IsNamed) {
  for (const int steps : {4, 5, 8}) {
    for (const RenderedScene& scene : exposed_scenes()) {
      const ExposedFrames frames(scene, steps);
      const FrameExplanation found = frames.beside_fine();
      EXPECT_TRUE(found.has_fault()) << steps << " seed " << scene.seed;
      EXPECT_EQ(name_of(found.best.cause), "exposure")
          << steps << " seed " << scene.seed << " " << describe(found.explanation);
    }
  }
}

TEST(AutomaticExposure, TellsTheGains) {
  const ExposedFrames frames({.seed = 64}, 6);
  const FrameExplanation found = frames.beside_fine();
  ASSERT_EQ(found.best.gains.size(), frames.gains.size());
  const double scale = found.best.gains[0] / frames.gains[0];
  for (std::size_t k = 0; k < frames.gains.size(); ++k)
    EXPECT_NEAR(found.best.gains[k] / frames.gains[k], scale, 0.02 * scale) << k;
}

TEST(AutomaticExposure, LeavesOutTheView) {
  for (const RenderedScene& scene : exposed_scenes()) {
    const FrameVerdict four = ExposedFrames(scene, 4).verdict();
    EXPECT_EQ(four.action, FrameAction::LeaveOutView) << four.finding;
    EXPECT_NE(four.finding.find("sets its exposure"), std::string::npos) << four.finding;
    const FrameVerdict six = ExposedFrames(scene, 6).verdict();
    EXPECT_EQ(six.action, FrameAction::LeaveOutView) << six.finding;
    EXPECT_NE(six.finding.find("sets its exposure"), std::string::npos) << six.finding;
  }
}

TEST(AutomaticExposure, IsNotBlamedForSoundFrames) {
  for (const int steps : {4, 5, 6, 8}) {
    for (const RenderedScene& scene : exposed_scenes()) {
      const FrameVerdict found = ExposedFrames(scene, steps, 0.0).verdict();
      EXPECT_EQ(found.action, FrameAction::Use) << steps << " " << found.finding;
      EXPECT_EQ(found.finding, "") << steps << " seed " << scene.seed;
    }
  }
}

}  // namespace
}  // namespace frangia
