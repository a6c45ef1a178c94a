// A piezo with errors: the estimated errors, and the phase error that remains after correction.
#include <array>
#include <cmath>
#include <complex>

#include <fmt/format.h>

#include "frangia/acquisition/sweep_piezo.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/phase/algorithm/fit_algorithm.h"
#include "frangia/phase/wrap/wrap_phase.h"
#include "frangia/simulate/internal/light_sample.h"
#include "frangia/simulate/internal/simulated_bench.h"

#include "support/simulated_capture.h"

namespace frangia {
namespace {

class StepControl : public testing::SimulatedCapture {
 protected:
  /// RMS of a set's phase about the truth, but for its mean, over the noise limit sqrt(2 / N).
  [[nodiscard]] double error_over_limit(std::size_t view, const std::string& algorithm) const {
    const Scan scan = read_scan(plan_.folder);
    const FrameStack stack = read_frames(scan, view).front();
    const NoiseModel noise = *scan.rig.reference().noise;
    const WrappedPhase map =
        wrap_phase(stack, fit_algorithm(algorithm, stack, noise).algorithm, noise);
    const auto scene = make_simulated_scene(make_plate(), plan_.rig, std::array{SimulatedView{}});
    const Eigen::Isometry3d pose = scene.rig.rig_from_object(scan.views[view].angle_rad);
    std::complex<double> mean = 0.0;
    std::vector<double> errors;
    double limit2 = 0.0;
    for (int y = 0; y < map.phase_rad.height(); ++y) {
      for (int x = 0; x < map.phase_rad.width(); ++x) {
        if (std::isnan(map.phase_rad(x, y))) continue;
        const LightSample sample = sample_light(scene, pose, scene.rays(x, y).cast<double>());
        const double truth = kTwoPi * stack.pattern.fringes_per_degree * sample.u;
        errors.push_back(static_cast<double>(map.phase_rad(x, y)) - truth);
        mean += std::polar(1.0, errors.back());
        const double variance = noise.variance(static_cast<double>(map.mean_counts(x, y)));
        limit2 += 2.0 / static_cast<double>(stack.frames.size()) * variance /
                  std::pow(static_cast<double>(map.modulation_counts(x, y)), 2);
      }
    }
    double sum2 = 0.0;
    for (const double error : errors)
      sum2 += std::pow(std::arg(std::polar(1.0, error) / mean), 2);
    EXPECT_GT(errors.size(), 500U);
    return std::sqrt(sum2 / limit2);
  }
};

TEST_F(StepControl, PiezoFivePercentOffWithJitterIsWithinAFifthOfTheNoiseLimitOnceCorrected) {
  use("angular", 2);
  devices_["fringes"] += "gain_error = 0.05\njitter_deg = 1\n";
  plan_.patterns.resize(1);
  plan_.rig.laser_sheet.reset();
  plan_.patterns.front().shifts_rad.clear();
  for (int i = 0; i < 8; ++i)
    plan_.patterns.front().shifts_rad.push_back(kTwoPi * i / 8);
  views(4);
  CaptureOptions uncontrolled;
  uncontrolled.control_steps = false;
  static_cast<void>(capture(uncontrolled));
  const double first = error_over_limit(0, "least-squares");
  std::filesystem::remove_all(plan_.folder);
  static_cast<void>(capture());
  double corrected = 0.0;
  double plain = 0.0;
  for (std::size_t view = 1; view < 4; ++view) {
    corrected = std::max(corrected, error_over_limit(view, "aia"));
    plain = std::max(plain, error_over_limit(view, "least-squares"));
  }
  EXPECT_LT(corrected, 1.2);
  EXPECT_GT(first, 1.2) << "else there was nothing to correct";
  fmt::print("FIGURE {{\"first\": {:.3f}, \"corrected\": {:.3f}, \"corrected_plain\": {:.3f}}}\n",
             first,
             corrected,
             plain);
}

TEST_F(StepControl, SweepFindsTheCurveOfABentPiezo) {
  use("angular", 4);
  devices_["fringes"] += "gain_error = 0.06\nnonlinearity = 0.05\n";
  RigDevices devices = open();
  const PiezoSweep sweep = sweep_piezo(devices, plan_.rig, {.steps = 13});
  ASSERT_EQ(sweep.curve.commands.size(), 13U);
  EXPECT_FALSE(devices.light->is_on());
  double worst_rad = 0.0;
  for (std::size_t i = 0; i < sweep.curve.commands.size(); ++i) {
    const double command = sweep.curve.commands[i];
    const double truth = 1.06 * kTwoPi * command / 10.0 * (1.0 + 0.05 * command / 12.0);
    worst_rad = std::max(worst_rad, std::abs(sweep.curve.phases_rad[i] - truth));
  }
  EXPECT_LT(worst_rad, 0.01);
  EXPECT_LT(sweep.residual_ratio, 1.5);
}

}  // namespace
}  // namespace frangia
