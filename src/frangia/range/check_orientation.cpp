#include "frangia/range/check_orientation.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/statistics.h"
#include "frangia/range/triangulate.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

constexpr int kMaxStep = 2;  // px between the pixels that are compared, at most
/// Largest expected change between two pixels. A slope of the surface may double it, and beyond
/// half a turn a wrapped change has the wrong sign.
constexpr double kMaxChange_rad = 0.5 * kPi;
constexpr std::size_t kSamples = 5'000;  // of the measured pixels
constexpr std::size_t kMinVotes = 200;   // fewer decide nothing
constexpr double kMajority = 0.8;
constexpr double kExchanged = 3.0;  // change across over change along; expected: below 1
constexpr double kMinSigmas = 3.0;  // of a difference that counts

/// The distance at which the axes of camera and projector cross, or a plausible one.
double working_distance(const Pattern& pattern, const Rig& rig) {
  const double middle = phase_range(pattern, rig.projector).center_rad();
  const double found = intersect_fringe({0.0, 0.0}, middle, pattern, rig.projector).depth_mm;
  const double baseline = rig.projector.position_mm.norm();
  return found > 0.3 * baseline && found < 30.0 * baseline ? found : 3.0 * baseline;
}

std::string what_fits(bool is_exchanged, FringeDirection direction) {
  const bool vertical = direction == FringeDirection::Vertical;
  if (is_exchanged) {
    return vertical ? "the fringes that scan.toml calls vertical run horizontally: direction = "
                      "\"horizontal\" fits"
                    : "the fringes that scan.toml calls horizontal run vertically: direction = "
                      "\"vertical\" fits";
  }
  return vertical
             ? "the phase of the vertical fringes falls where the rig makes it rise: shifts in "
               "the opposite direction fit in all their patterns, or a projector or camera whose "
               "picture is mirrored left to right"
             : "the phase of the horizontal fringes falls where the rig makes it rise: shifts "
               "in the opposite direction fit in all their patterns, or a projector or camera "
               "whose picture is mirrored upside down";
}

/// Changes of the phase between neighbouring pixels, measured and expected.
struct PhaseChanges {
  std::vector<float> along;           ///< rad, in the direction in which more change is expected
  std::vector<float> across;          ///< rad, in the other
  std::vector<float> expected_ratio;  ///< of the expected change across to that along
  std::size_t voting = 0;             ///< changes beyond their noise
  std::size_t rising = 0;             ///< of these, with the expected sign
};

PhaseChanges phase_changes(const AbsolutePhase& phase,
                           const Rig& rig,
                           const Image<Eigen::Vector2f>& rays) {
  const double distance = working_distance(phase.pattern, rig);
  const auto expected_at = [&](int x, int y) {
    const Eigen::Vector2d ray = rays(x, y).cast<double>();
    return phase_at(
        distance * Eigen::Vector3d(ray.x(), ray.y(), 1.0), phase.pattern, rig.projector);
  };
  const auto& phases = phase.phase_rad.pixels();
  const auto measured_pixels =
      std::count_if(phases.begin(), phases.end(), [](float value) { return !std::isnan(value); });
  const int stride = std::max(1,
                              static_cast<int>(std::sqrt(static_cast<double>(measured_pixels) /
                                                         static_cast<double>(kSamples))));
  PhaseChanges out;
  for (int y = 0; y + kMaxStep < rays.height(); y += stride) {
    for (int x = 0; x + kMaxStep < rays.width(); x += stride) {
      const double expected_here = expected_at(x, y);
      const Eigen::Vector2d a_pixel(expected_at(x + 1, y) - expected_here,
                                    expected_at(x, y + 1) - expected_here);
      const double change = a_pixel.cwiseAbs().maxCoeff();
      if (!(change <= kMaxChange_rad)) continue;
      const int step = kMaxStep * change <= kMaxChange_rad ? kMaxStep : 1;
      const Eigen::Vector2d expected = step * a_pixel;
      const double here = phase.phase_rad(x, y);
      const double right = phase.phase_rad(x + step, y);
      const double below = phase.phase_rad(x, y + step);
      const Eigen::Vector2d measured(wrap_rad(right - here), wrap_rad(below - here));
      if (!measured.allFinite()) continue;
      const int main = std::abs(expected.x()) >= std::abs(expected.y()) ? 0 : 1;
      out.along.push_back(static_cast<float>(std::abs(measured(main))));
      out.across.push_back(static_cast<float>(std::abs(measured(1 - main))));
      out.expected_ratio.push_back(
          static_cast<float>(std::abs(expected(1 - main)) / std::abs(expected(main))));
      const double noise = phase.sigma_rad(x, y) * std::numbers::sqrt2;
      if (std::abs(measured(main)) < kMinSigmas * noise) continue;
      ++out.voting;
      if ((measured(main) > 0.0) == (expected(main) > 0.0)) ++out.rising;
    }
  }
  return out;
}

}  // namespace

OrientationCheck check_orientation(const AbsolutePhase& phase,
                                   const Rig& rig,
                                   const Image<Eigen::Vector2f>& rays) {
  require(same_size(phase.phase_rad, rays), "check_orientation: phase and rays differ in size");
  OrientationCheck out;
  PhaseChanges changes = phase_changes(phase, rig, rays);
  if (changes.along.size() < kMinVotes) return out;
  const auto main_change = static_cast<double>(median_in_place(std::span(changes.along)));
  out.across = static_cast<double>(median_in_place(std::span(changes.across))) / main_change;
  out.rising = changes.voting == 0
                   ? 0.0
                   : static_cast<double>(changes.rising) / static_cast<double>(changes.voting);
  const bool is_plain = median_in_place(std::span(changes.expected_ratio)) < 0.5F;
  const bool is_exchanged = is_plain && out.across > kExchanged;
  const bool agree =
      changes.voting >= kMinVotes && (out.rising >= kMajority || out.rising <= 1.0 - kMajority);
  out.decided = is_exchanged || agree;
  out.consistent = !is_exchanged && !(agree && out.rising <= 1.0 - kMajority);
  if (!out.consistent) out.fits = what_fits(is_exchanged, phase.pattern.direction);
  return out;
}

}  // namespace frangia
