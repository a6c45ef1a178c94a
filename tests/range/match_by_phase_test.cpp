#include "frangia/range/match_by_phase.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "range/two_cameras.h"
#include "support/error_of.h"

namespace frangia {
namespace {

using testing::errors_of;
using testing::TwoCameras;

TEST(MatchByPhase, LeavesOutAPhaseThatOccursTwiceOnAnEpipolarLine) {
  TwoCameras scene({.label = true});
  const std::size_t all = errors_of(scene, 0, scene.alone).points;
  // The second half of the second camera repeats the phases of the first half.
  Image<float>& phase = scene.phases[1][0].phase_rad;
  for (int y = 0; y < phase.height(); ++y) {
    for (int x = phase.width() / 2; x < phase.width(); ++x)
      phase(x, y) = phase(x - phase.width() / 2 + 10, y);
  }
  const Image<float> matched = match_by_phase(scene.cameras[0], scene.cameras[1]);
  std::size_t points = 0;
  for (const float depth : matched.pixels())
    points += std::isnan(depth) ? 0U : 1U;
  EXPECT_LT(points, all / 2);
}

TEST(MatchByPhase, RefusesCamerasWithOneCentre) {
  TwoCameras scene({});
  scene.cameras[1].camera_from_rig.translation().setZero();
  EXPECT_NE(testing::error_of([&] {
              static_cast<void>(match_by_phase(scene.cameras[0], scene.cameras[1]));
            }).find("same centre"),
            std::string::npos);
}

}  // namespace
}  // namespace frangia
