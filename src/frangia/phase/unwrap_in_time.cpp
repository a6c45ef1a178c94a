#include "frangia/phase/unwrap_in_time.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/rig/phase_range.h"

namespace frangia {

namespace {

constexpr std::size_t kChunk = 1 << 16;

/// A phase near the ends of the fringe may have slipped over to the other end by noise: doubtful.
AbsolutePhase from_single_fringe(const WrappedPhase& level,
                                 const Projector& projector,
                                 double sigmas_of_chance) {
  AbsolutePhase out{level.pattern, level.phase_rad, level.sigma_rad, level.fate};
  const double centre = phase_range(level.pattern, projector).centre_rad();
  parallel_chunks(out.fate.pixels().size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (out.fate.pixels()[i] != PixelFate::Measured) continue;
      float& phase = out.phase_rad.pixels()[i];
      float& sigma = out.sigma_rad.pixels()[i];
      const double from_centre = wrap_rad(phase - centre);
      phase = static_cast<float>(centre + from_centre);
      if (kPi - std::abs(from_centre) > sigmas_of_chance * sigma) continue;
      out.fate.pixels()[i] = PixelFate::Doubtful;
      phase = sigma = kMissing;
    }
  });
  return out;
}

/// Mean over the neighbours that agree with the pixel within three sigmas of their difference. A
/// window that is not symmetric would follow the slope of the phase, so both of a pair count or
/// neither.
void smooth_row(const AbsolutePhase& in, int radius, int y, AbsolutePhase& out) {
  const int width = in.phase_rad.width();
  const int height = in.phase_rad.height();
  for (int x = 0; x < width; ++x) {
    const float centre = in.phase_rad(x, y);
    if (std::isnan(centre)) continue;
    const float sigma = in.sigma_rad(x, y);
    double sum = centre;
    int count = 1;
    for (int dy = 0; dy <= radius; ++dy) {
      for (int dx = dy == 0 ? 1 : -radius; dx <= radius; ++dx) {
        if (x + dx < 0 || x + dx >= width || x - dx < 0 || x - dx >= width) continue;
        if (y - dy < 0 || y + dy >= height) continue;
        const float a = in.phase_rad(x + dx, y + dy);
        const float b = in.phase_rad(x - dx, y - dy);
        const float limit = 3.0F * 1.414F * sigma;
        if (!(std::abs(a - centre) < limit && std::abs(b - centre) < limit)) continue;
        sum += a + b;
        count += 2;
      }
    }
    out.phase_rad(x, y) = static_cast<float>(sum / count);
    out.sigma_rad(x, y) = sigma / std::sqrt(static_cast<float>(count));
  }
}

AbsolutePhase smooth(const AbsolutePhase& in, int radius) {
  AbsolutePhase out = in;
  parallel_rows(in.phase_rad.height(), [&](int y) { smooth_row(in, radius, y, out); });
  return out;
}

void lift_row(const AbsolutePhase& coarse, double max_sigma, int y, AbsolutePhase& fine) {
  const double ratio = fine.pattern.fringes_per_unit() / coarse.pattern.fringes_per_unit();
  for (int x = 0; x < fine.phase_rad.width(); ++x) {
    if (fine.fate(x, y) != PixelFate::Measured) continue;
    const double expected = ratio * coarse.phase_rad(x, y);
    const double wrapped = fine.phase_rad(x, y);
    const double sigma = std::hypot(ratio * coarse.sigma_rad(x, y), fine.sigma_rad(x, y));
    if (coarse.fate(x, y) == PixelFate::Measured && sigma <= max_sigma) {
      fine.phase_rad(x, y) =
          static_cast<float>(wrapped + kTurn * std::round((expected - wrapped) / kTurn));
      continue;
    }
    const bool lost_before = coarse.fate(x, y) != PixelFate::Measured;
    fine.fate(x, y) = lost_before ? coarse.fate(x, y) : PixelFate::Doubtful;
    fine.phase_rad(x, y) = kMissing;
    fine.sigma_rad(x, y) = kMissing;
  }
}

}  // namespace

AbsolutePhase lift_in_time(AbsolutePhase absolute,
                           std::span<const WrappedPhase> finer,
                           const TimeUnwrapOptions& options) {
  const double max_sigma = sigma_of_chance(options.max_wrong_order);
  for (const WrappedPhase& level : finer) {
    require(level.pattern.fringes_per_unit() > absolute.pattern.fringes_per_unit(),
            "lift_in_time: the phases must go from coarse to fine");
    require(same_size(level.phase_rad, absolute.phase_rad),
            "lift_in_time: the phases differ in size");
    if (options.smooth_radius_px > 0) absolute = smooth(absolute, options.smooth_radius_px);
    AbsolutePhase lifted{level.pattern, level.phase_rad, level.sigma_rad, level.fate};
    parallel_rows(lifted.phase_rad.height(),
                  [&](int y) { lift_row(absolute, max_sigma, y, lifted); });
    absolute = std::move(lifted);
  }
  return absolute;
}

AbsolutePhase unwrap_in_time(std::span<const WrappedPhase> coarse_to_fine,
                             const Projector& projector,
                             const TimeUnwrapOptions& options) {
  require(!coarse_to_fine.empty(), "unwrap_in_time: no phase given");
  require(is_absolute(coarse_to_fine.front().pattern, projector),
          "unwrap_in_time: the first level must hold one fringe or less over the field");
  const double sigmas = kPi / sigma_of_chance(options.max_wrong_order);
  AbsolutePhase coarsest = from_single_fringe(coarse_to_fine.front(), projector, sigmas);
  return lift_in_time(std::move(coarsest), coarse_to_fine.subspan(1), options);
}

}  // namespace frangia
