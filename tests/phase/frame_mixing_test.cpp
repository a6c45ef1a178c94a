// Frames that hold a share of the one before them, by closed formulas.
#include "frangia/phase/waveform/frame_mixing.h"

#include <cmath>
#include <cstdint>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

#include "support/rendered_frames.h"

namespace frangia {
namespace {

using testing::RenderedFrames;
using testing::RenderedScene;

/// Three patterns, coarse to fine; `mixed` gives frame k of the view from the light of all frames.
template <typename Mix>
std::vector<FrameStack> view_of(int steps, const RenderedScene& scene, const Mix& mixed) {
  std::vector<RenderedFrames> patterns;
  std::vector<std::vector<double>> light;
  for (const double period_px : {160.0, 54.0, 18.0}) {
    RenderedScene one = scene;
    one.period_px = period_px;
    one.seed += static_cast<unsigned>(period_px);
    patterns.emplace_back(one, steps);
    light.insert(light.end(), patterns.back().frames.begin(), patterns.back().frames.end());
  }
  const auto made = mixed(light);
  std::vector<FrameStack> out;
  for (std::size_t p = 0; p < patterns.size(); ++p) {
    const auto first = made.begin() + static_cast<std::ptrdiff_t>(p) * steps;
    patterns[p].frames.assign(first, first + steps);
    out.push_back(patterns[p].stack());
  }
  return out;
}

using Light = std::vector<std::vector<double>>;

/// Each frame with `share` of the one before it, as it was delivered or as it was shown.
auto mix(double share, bool by_camera) {
  return [=](const Light& shown) {
    Light out = shown;
    for (std::size_t k = 1; k < shown.size(); ++k) {
      const std::vector<double>& before = by_camera ? out[k - 1] : shown[k - 1];
      for (std::size_t i = 0; i < shown[k].size(); ++i)
        out[k][i] = (1.0 - share) * shown[k][i] + share * before[i];
    }
    return out;
  };
}

const auto kAlone = [](const Light& shown) { return shown; };

TEST(FrameMixing, IsFoundAndTakenOut) {
  for (const int steps : {4, 5, 6, 8}) {
    for (const bool by_camera : {true, false}) {
      const std::vector<FrameStack> sound = view_of(steps, {.seed = 3}, kAlone);
      const std::vector<FrameStack> mixed = view_of(steps, {.seed = 3}, mix(0.3, by_camera));
      const auto found = find_frame_mixing(mixed);
      ASSERT_TRUE(found) << steps << " steps";
      EXPECT_NEAR(found->share, 0.3, 0.01) << steps << " steps";
      EXPECT_EQ(found->by_camera, by_camera) << steps << " steps";
      const std::vector<FrameStack> made = without_mixing(mixed, *found);
      double square = 0.0;
      double count = 0.0;
      for (std::size_t p = 0; p < made.size(); ++p) {
        for (std::size_t k = 0; k < made[p].frames.size(); ++k) {
          for (int y = 0; y < 120; y += 3) {
            for (int x = 50; x < 160; x += 3) {
              square += std::pow(
                  counts_at(made[p].frames[k], x, y) - counts_at(sound[p].frames[k], x, y), 2);
              count += 1.0;
            }
          }
        }
      }
      EXPECT_LT(std::sqrt(square / count), 2.0) << steps << " steps";  // noise of both, amplified
    }
  }
}

TEST(FrameMixing, IsFoundFromATenthToAHalf) {
  for (const double share : {0.1, 0.2, 0.4, 0.5}) {
    for (const bool by_camera : {true, false}) {
      const auto found = find_frame_mixing(view_of(4, {.seed = 3}, mix(share, by_camera)));
      ASSERT_TRUE(found) << share << (by_camera ? " by the camera" : " of the light");
      EXPECT_NEAR(found->share, share, 0.01);
      EXPECT_EQ(found->by_camera, by_camera) << share;
    }
  }
}

TEST(FrameMixing, IsNotFoundInOtherFrames) {
  for (const int steps : {4, 6}) {
    for (const RenderedScene& scene : {RenderedScene{.seed = 1},
                                       RenderedScene{.gamma = 2.2, .seed = 2},
                                       RenderedScene{.flicker = 0.05, .seed = 3},
                                       RenderedScene{.binary = true, .seed = 4},
                                       RenderedScene{.light = 15.0, .seed = 5}})
      EXPECT_FALSE(find_frame_mixing(view_of(steps, scene, kAlone))) << scene.seed;
    const auto found_with = [&](const auto& change) {
      return find_frame_mixing(view_of(steps,
                                       {.seed = 6},
                                       [&](Light shown) {
                                         change(shown);
                                         return shown;
                                       }))
          .has_value();
    };
    const auto first = static_cast<std::size_t>(steps);
    EXPECT_FALSE(found_with([&](Light& shown) { shown[first + 1].assign(160 * 120, 6.0); }));
    EXPECT_FALSE(found_with([&](Light& shown) { std::swap(shown[first], shown[first + 1]); }));
    EXPECT_FALSE(found_with([&](Light& shown) {  // the first of each pattern is late
      for (std::size_t k = first; k < shown.size(); k += first)
        shown[k] = shown[k - 1];
    }));
  }
}

}  // namespace
}  // namespace frangia
