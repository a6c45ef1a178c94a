#include "frangia/phase/unwrap_temporally.h"

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

/// Near the ends of the single fringe, noise may wrap the phase to the other end; such pixels are
/// uncertain.
AbsolutePhase from_single_fringe(const WrappedPhase& level,
                                 const Projector& projector,
                                 double min_sigmas) {
  AbsolutePhase out{level.pattern, level.phase_rad, level.sigma_rad, level.status};
  const double center = phase_range(level.pattern, projector).center_rad();
  parallel_chunks(out.status.pixels().size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (out.status.pixels()[i] != PixelStatus::Measured) continue;
      float& phase = out.phase_rad.pixels()[i];
      float& sigma = out.sigma_rad.pixels()[i];
      const double from_center = wrap_rad(phase - center);
      phase = static_cast<float>(center + from_center);
      if (kPi - std::abs(from_center) > min_sigmas * sigma) continue;
      out.status.pixels()[i] = PixelStatus::UncertainOrder;
      phase = sigma = kMissing;
    }
  });
  return out;
}

/// Mean over the neighbours that agree within three sigmas of their difference. Opposite neighbours
/// count in pairs, because an asymmetric window would be biased by the slope of the phase.
void smooth_row(const AbsolutePhase& in, int radius, int y, AbsolutePhase& out) {
  const int width = in.phase_rad.width();
  const int height = in.phase_rad.height();
  for (int x = 0; x < width; ++x) {
    const float center = in.phase_rad(x, y);
    if (std::isnan(center)) continue;
    const float sigma = in.sigma_rad(x, y);
    double sum = center;
    int count = 1;
    for (int dy = 0; dy <= radius; ++dy) {
      for (int dx = dy == 0 ? 1 : -radius; dx <= radius; ++dx) {
        if (x + dx < 0 || x + dx >= width || x - dx < 0 || x - dx >= width) continue;
        if (y - dy < 0 || y + dy >= height) continue;
        const float a = in.phase_rad(x + dx, y + dy);
        const float b = in.phase_rad(x - dx, y - dy);
        const float limit = 3.0F * 1.414F * sigma;
        if (!(std::abs(a - center) < limit && std::abs(b - center) < limit)) continue;
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

void unwrap_row(const AbsolutePhase& coarse, double max_sigma, int y, AbsolutePhase& fine) {
  const double ratio = fine.pattern.fringes_per_unit() / coarse.pattern.fringes_per_unit();
  for (int x = 0; x < fine.phase_rad.width(); ++x) {
    if (fine.status(x, y) != PixelStatus::Measured) continue;
    const double expected = ratio * coarse.phase_rad(x, y);
    const double wrapped = fine.phase_rad(x, y);
    const double sigma = std::hypot(ratio * coarse.sigma_rad(x, y), fine.sigma_rad(x, y));
    if (coarse.status(x, y) == PixelStatus::Measured && sigma <= max_sigma) {
      fine.phase_rad(x, y) =
          static_cast<float>(wrapped + kTwoPi * std::round((expected - wrapped) / kTwoPi));
      continue;
    }
    const bool invalid_before = coarse.status(x, y) != PixelStatus::Measured;
    fine.status(x, y) = invalid_before ? coarse.status(x, y) : PixelStatus::UncertainOrder;
    fine.phase_rad(x, y) = kMissing;
    fine.sigma_rad(x, y) = kMissing;
  }
}

}  // namespace

AbsolutePhase unwrap_finer_levels(AbsolutePhase absolute,
                                  std::span<const WrappedPhase> finer,
                                  const TemporalUnwrapOptions& options) {
  const double max_sigma = sigma_for_wrong_order_probability(options.max_wrong_order);
  for (const WrappedPhase& level : finer) {
    require(level.pattern.fringes_per_unit() > absolute.pattern.fringes_per_unit(),
            "unwrap_finer_levels: the phases must go from coarse to fine");
    require(same_size(level.phase_rad, absolute.phase_rad),
            "unwrap_finer_levels: the phases differ in size");
    if (options.smooth_radius_px > 0) absolute = smooth(absolute, options.smooth_radius_px);
    AbsolutePhase unwrapped{level.pattern, level.phase_rad, level.sigma_rad, level.status};
    parallel_rows(unwrapped.phase_rad.height(),
                  [&](int y) { unwrap_row(absolute, max_sigma, y, unwrapped); });
    absolute = std::move(unwrapped);
  }
  return absolute;
}

AbsolutePhase unwrap_temporally(std::span<const WrappedPhase> coarse_to_fine,
                                const Projector& projector,
                                const TemporalUnwrapOptions& options) {
  require(!coarse_to_fine.empty(), "unwrap_temporally: no phase given");
  require(is_absolute(coarse_to_fine.front().pattern, projector),
          "unwrap_temporally: the first level must have at most one fringe over the field");
  const double sigmas = kPi / sigma_for_wrong_order_probability(options.max_wrong_order);
  AbsolutePhase coarsest = from_single_fringe(coarse_to_fine.front(), projector, sigmas);
  return unwrap_finer_levels(std::move(coarsest), coarse_to_fine.subspan(1), options);
}

}  // namespace frangia
