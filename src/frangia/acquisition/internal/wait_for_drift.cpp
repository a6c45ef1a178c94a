#include "frangia/acquisition/internal/wait_for_drift.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <cstddef>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/acquisition/internal/choose_exposures.h"
#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/missing.h"

namespace frangia {
namespace {

/// The fringes of each pixel as a phasor, but for a factor that is the same in all captures.
std::vector<std::complex<double>> phasors_of(const FrameStack& stack) {
  const auto count = stack.frames.size();
  std::complex<double> mean = 0.0;  // of the weights, so that light without fringes cancels
  std::vector<std::complex<double>> weights;
  for (const double shift : stack.pattern.shifts_rad) {
    weights.push_back(std::polar(1.0, -shift));
    mean += weights.back() / static_cast<double>(count);
  }
  std::vector<std::complex<double>> phasors;
  for (std::size_t k = 0; k < count; ++k) {
    std::visit(
        [&](const auto& image) {
          const auto counts = image.pixels();
          phasors.resize(counts.size());
          for (std::size_t i = 0; i < counts.size(); ++i)
            phasors[i] += (weights[k] - mean) * static_cast<double>(counts[i]);
        },
        stack.frames[k]);
  }
  return phasors;
}

int width_of(const FrameStack& stack) {
  return std::visit([](const auto& image) { return image.width(); }, stack.frames.front());
}

/// Sleeps in short steps, so that a stop is noticed.
void sleep(double seconds, const Run& run) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  constexpr std::chrono::milliseconds kStep(100);
  while (Clock::now() < end) {
    run.check();
    std::this_thread::sleep_for(std::min<std::chrono::duration<double>>(kStep, end - Clock::now()));
  }
}

}  // namespace

double fringe_motion_rad(const FrameStack& before, const FrameStack& after) {
  require(before.frames.size() == after.frames.size() &&
              before.frames.size() == before.pattern.shifts_rad.size() && !before.frames.empty(),
          "fringe_motion_rad: the captures have different frames");
  const auto one = phasors_of(before);
  const auto other = phasors_of(after);
  require(one.size() == other.size(), "fringe_motion_rad: the frames differ in size");
  constexpr std::size_t kFields = 8;
  const auto width = static_cast<std::size_t>(width_of(before));
  const std::size_t height = one.size() / width;
  std::vector<std::complex<double>> fields(kFields * kFields);
  double brightest = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const std::size_t x = i % width;
    const std::size_t y = i / width;
    // The phase of a product is the difference of the phases, weighted by the light of both.
    const std::complex<double> product = other[i] * std::conj(one[i]);
    std::complex<double>& field = fields[(kFields * y / height) * kFields + kFields * x / width];
    field += product;
    brightest = std::max(brightest, std::abs(field));
  }
  constexpr double kLit = 0.02;  // of the brightest field; others are background
  double sum = 0.0;
  std::size_t count = 0;
  for (const std::complex<double>& field : fields) {
    if (!(std::abs(field) > kLit * brightest)) continue;
    sum += std::pow(std::arg(field), 2);
    ++count;
  }
  return count == 0 ? static_cast<double>(kMissing) : std::sqrt(sum / static_cast<double>(count));
}

double fringe_distance_mm(const Pattern& pattern, const Rig& rig) {
  require(
      rig.turntable.has_value(),
      "`wait_for_drift` needs the distance of the part, which the [turntable] of rig.toml gives");
  const Projector& projector = rig.projector;
  const double distance_mm = (rig.turntable->point_mm - projector.position_mm).norm();
  if (const auto* pinhole = std::get_if<PinholeModel>(&projector.model)) {
    const double focal_px = pattern.direction == FringeDirection::Horizontal
                                ? pinhole->focal_px.y()
                                : pinhole->focal_px.x();
    return pattern.period_px / focal_px * distance_mm;
  }
  return rad_from_deg(1.0 / pattern.fringes_per_degree) * distance_mm;
}

double wait_for_drift(const Scan& plan,
                      CaptureDevices& devices,
                      const CaptureOptions& options,
                      double exposure_ms,
                      const Run& run) {
  constexpr int kStill = 2;  // looks in a row: one alone may be where a drift turns round
  run.stage("drift");
  const auto begin = std::chrono::steady_clock::now();
  const auto look = [&] {
    return capture_finest(plan.patterns, plan.rig, 0, devices, exposure_ms);
  };
  FrameStack before = look();
  auto looked = std::chrono::steady_clock::now();
  const double distance_mm = fringe_distance_mm(before.pattern, plan.rig);
  double moved_mm = static_cast<double>(kMissing);
  for (int still = 0; still < kStill;) {
    sleep(options.drift_interval_s, run);
    run.check();
    FrameStack after = look();
    const std::chrono::duration<double> between = std::chrono::steady_clock::now() - looked;
    looked = std::chrono::steady_clock::now();
    moved_mm = distance_mm * fringe_motion_rad(before, after) / kTwoPi;
    before = std::move(after);
    if (std::isnan(moved_mm)) {
      throw Error(
          ErrorKind::Device,
          "no fringes are seen, so that their drift cannot be measured: check the light and "
          "the exposure, or leave out `wait_for_drift`");
    }
    run.note(fmt::format(
        "the fringes moved by {:.4f} mm at the part within {:.1f} s", moved_mm, between.count()));
    still = moved_mm < options.drift_limit_mm ? still + 1 : 0;
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
    if (still < kStill && waited.count() > options.drift_patience_s) {
      throw Error(
          ErrorKind::Device,
          fmt::format("the fringes still move by {:.4f} mm at the part within {:.1f} s after "
                      "{:.0f} s: let the rig warm up, look for what moves, or allow more by "
                      "`wait_for_drift`",
                      moved_mm,
                      between.count(),
                      waited.count()));
    }
  }
  return moved_mm;
}

}  // namespace frangia
