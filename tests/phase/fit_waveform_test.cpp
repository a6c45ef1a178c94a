#include "frangia/phase/fit_waveform.h"

#include <cmath>
#include <ctime>
#include <iostream>

#include <gtest/gtest.h>

#include "support/display_fringes.h"
#include "support/synthetic_fringes.h"

namespace frangia {
namespace {

using testing::display_frames;
using testing::DisplayScene;
using testing::equal_shifts;
using testing::gamma_harmonic;

NoiseModel noise_of(const DisplayScene& scene) {
  return {.floor_counts2 = scene.noise_counts * scene.noise_counts + 1.0 / 12.0};
}

WaveformFit fit(const DisplayScene& scene, int frames) {
  const std::vector<double> shifts = equal_shifts(frames, kTwoPi / frames);
  return fit_waveform(display_frames(scene, shifts), shifts, noise_of(scene));
}

TEST(Explore, Print) {
  for (const double gamma : {1.0, 1.8, 2.2}) {
    for (const int frames : {3, 4, 5, 6, 8, 12}) {
      DisplayScene scene{.gamma = gamma};
      const std::vector<double> shifts = equal_shifts(frames, kTwoPi / frames);
      const FrameStack stack = display_frames(scene, shifts);
      const std::clock_t start = std::clock();
      const WaveformFit found = fit_waveform(stack, shifts, noise_of(scene));
      std::cout << "gamma " << gamma << " N " << frames << " t "
                << 1e3 * double(std::clock() - start) / CLOCKS_PER_SEC << " flick "
                << found.flicker() << ' ' << found.flicker_error_rad;
      for (std::size_t i = 0; i < found.sigma.size(); ++i)
        std::cout << " h" << i + 2 << ' ' << found.waveform.harmonics[i] << " +- " << found.sigma[i]
                  << " (" << gamma_harmonic(gamma, int(i) + 2) << ")";
      std::cout << '\n';
    }
  }
  for (const int frames : {3, 4, 5, 6, 8, 12}) {
    DisplayScene scene;
    for (int k = 0; k < frames; ++k)
      scene.gains.push_back(0.02 * std::sin(2.3 * k * k + 1.0));
    const WaveformFit found = fit(scene, frames);
    std::cout << "flicker N " << frames << " flick " << found.flicker() << ' '
              << found.flicker_error_rad;
    for (std::size_t i = 0; i < found.sigma.size(); ++i)
      std::cout << " h" << i + 2 << ' ' << found.waveform.harmonics[i] << " +- " << found.sigma[i];
    std::cout << '\n';
    for (std::size_t k = 0; k < found.gains.size(); ++k)
      std::cout << found.gains[k] << " (" << scene.gains[k] << ") ";
    std::cout << '\n';
  }
}

}  // namespace
}  // namespace frangia
