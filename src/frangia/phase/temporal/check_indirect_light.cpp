#include "frangia/phase/temporal/check_indirect_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"

namespace frangia {
namespace {

constexpr int kWindowRadius = 2;
constexpr int kWindowPixels = (2 * kWindowRadius + 1) * (2 * kWindowRadius + 1);

/// Mean residual of a window and its variance by noise; NaN at steps and missing pixels.
struct WindowResidual {
  double mean = kMissing;
  double variance = 0.0;
};

WindowResidual residual_around(
    const WrappedPhase& map, const AbsolutePhase& phase, double ratio, int x, int y) {
  constexpr double kStep_rad = 4.0;  // across half a window: 2 rad a pixel
  const double center = phase.phase_rad(x, y);
  WindowResidual out{0.0, 0.0};
  for (int dy = -kWindowRadius; dy <= kWindowRadius; ++dy) {
    for (int dx = -kWindowRadius; dx <= kWindowRadius; ++dx) {
      const int u = x + dx;
      const int v = y + dy;
      const double absolute = phase.phase_rad(u, v);
      const double wrapped = map.phase_rad(u, v);
      if (!(std::abs(absolute - center) < kStep_rad) || std::isnan(wrapped)) return {};
      const double own = map.sigma_rad(u, v);
      const double finest = ratio * static_cast<double>(phase.sigma_rad(u, v));
      out.mean += wrap_rad(wrapped - ratio * absolute) / kWindowPixels;
      out.variance += (own * own + finest * finest) / kWindowPixels / kWindowPixels;
      if (map.systematic_rad.empty()) continue;
      // Known errors of a pattern are alike in the whole window.
      const double known = map.systematic_rad(u, v);
      out.variance += known * known / kWindowPixels;
    }
  }
  return out;
}

/// Square of the disagreement at each pixel beyond its noise; NaN where it cannot be decided.
Image<float> disagreement_of(const WrappedPhase& map, const AbsolutePhase& phase) {
  constexpr double kSignificant = 16.0;  // squared standard deviations
  const double ratio = map.pattern.fringes_per_unit() / phase.pattern.fringes_per_unit();
  Image<float> out(map.phase_rad.width(), map.phase_rad.height(), kMissing);
  parallel_rows(out.height(), [&](int y) {
    if (y < kWindowRadius || y >= out.height() - kWindowRadius) return;
    for (int x = kWindowRadius; x < out.width() - kWindowRadius; ++x) {
      if (phase.status(x, y) != PixelStatus::Measured) continue;
      const WindowResidual found = residual_around(map, phase, ratio, x, y);
      if (std::isnan(found.mean)) continue;
      const double square = found.mean * found.mean;
      out(x, y) = square > kSignificant * found.variance
                      ? static_cast<float>(square - found.variance)
                      : 0.0F;
    }
  });
  return out;
}

/// The largest systematic error that is known of any pattern: harmonics, flicker, steps.
double largest_known(std::span<const WrappedPhase> maps) {
  double largest = 0.0;
  for (const WrappedPhase& map : maps) {
    for (const float known : map.systematic_rad.pixels())
      if (known > largest) largest = static_cast<double>(known);
  }
  return largest;
}

double median_modulation(const WrappedPhase& map) {
  std::vector<float> values;
  constexpr std::size_t kSamples = 20'000;
  const std::size_t stride = map.status.pixels().size() / kSamples + 1;
  for (std::size_t i = 0; i < map.status.pixels().size(); i += stride) {
    if (map.status.pixels()[i] == PixelStatus::Measured)
      values.push_back(map.modulation_counts.pixels()[i]);
  }
  return values.empty() ? 0.0 : static_cast<double>(median_in_place(std::span(values)));
}

/// How a pattern disagrees with the finest one beyond the noise.
struct Disagreement {
  double affected = 0.0;  ///< share of the pixels that decide it
  double rms_rad = 0.0;   ///< over these
};

/// Compares a pattern with the finest one, and raises `square` to the squares of what they disagree
/// by, in phases of the finest one.
Disagreement compare(const WrappedPhase& map, const AbsolutePhase& phase, Image<float>& square) {
  const double ratio = map.pattern.fringes_per_unit() / phase.pattern.fringes_per_unit();
  const Image<float> disagreement = disagreement_of(map, phase);
  double decided = 0.0;
  double affected = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < square.pixels().size(); ++i) {
    const auto found = static_cast<double>(disagreement.pixels()[i]);
    if (std::isnan(found)) continue;
    decided += 1.0;
    if (found == 0.0) continue;
    affected += 1.0;
    sum += found;
    float& all = square.pixels()[i];
    all = std::max(all, static_cast<float>(found * ratio));
  }
  if (affected == 0.0) return {};
  return {affected / decided, std::sqrt(sum / affected)};
}

/// Adds squares to the systematic part of a phase.
void add_systematic(const Image<float>& square, AbsolutePhase& phase) {
  phase.differing_share = 0.0F;  // indirect light is much alike in neighbouring views
  if (phase.systematic_rad.empty())
    phase.systematic_rad = Image<float>(square.width(), square.height(), 0.0F);
  for (std::size_t i = 0; i < square.pixels().size(); ++i) {
    float& systematic = phase.systematic_rad.pixels()[i];
    const float known = std::isnan(systematic) ? 0.0F : systematic;
    const bool measured = !std::isnan(phase.phase_rad.pixels()[i]);
    systematic = measured ? std::sqrt(known * known + square.pixels()[i]) : kMissing;
  }
}

}  // namespace

IndirectLightCheck check_indirect_light(std::span<const WrappedPhase> coarse_to_fine,
                                        AbsolutePhase& phase) {
  constexpr double kFound = 0.01;
  constexpr double kMaterial_rad = 0.004;  // a third of the noise of bright 8-bit frames
  IndirectLightCheck out;
  if (coarse_to_fine.size() < 2) return out;
  // Harmonics and flicker of one pattern show those of the others, which may be too small to be
  // found in their own frames.
  constexpr double kKnown = 2.0;
  const double material_rad = std::max(kMaterial_rad, kKnown * largest_known(coarse_to_fine));
  const double coarse = median_modulation(coarse_to_fine.front());
  if (coarse > 0.0) out.modulation_ratio = median_modulation(coarse_to_fine.back()) / coarse;
  Image<float> square(phase.phase_rad.width(), phase.phase_rad.height(), 0.0F);
  for (const WrappedPhase& map : coarse_to_fine.first(coarse_to_fine.size() - 1)) {
    const Disagreement one = compare(map, phase, square);
    if (one.affected < kFound || one.rms_rad < material_rad) continue;
    if (one.rms_rad < out.disagreement_rad) continue;
    out.found = true;
    out.affected = one.affected;
    out.disagreement_rad = one.rms_rad;
    out.pattern = map.pattern.name;
  }
  if (out.found) add_systematic(square, phase);
  return out;
}

std::string describe(const IndirectLightCheck& check) {
  return fmt::format(
      "pattern \"{}\" disagrees with the finest one by {:.3f} rad at {:.0f} % of the pixels, "
      "beyond their "
      "noise: indirect light (a concave part that lights itself, or scattering below the "
      "surface; the finest fringes have {:.0f} % of the modulation of the coarsest); it is counted "
      "in sigma; project only fine fringes, as a plan for indirect light proposes",
      check.pattern,
      check.disagreement_rad,
      100.0 * check.affected,
      100.0 * check.modulation_ratio);
}

}  // namespace frangia
