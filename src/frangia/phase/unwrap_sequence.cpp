#include "frangia/phase/unwrap_sequence.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/vectorised.h"
#include "frangia/phase/climb_ladder.h"
#include "frangia/phase/wrap_tile.h"

namespace frangia {
namespace {

constexpr std::size_t kChunk = 16 * kTilePixels;

FRANGIA_VECTORISED void precision_of(const float* __restrict from,
                                     std::size_t n,
                                     float* __restrict into) {
  for (std::size_t i = 0; i < n; ++i)
    into[i] = 1.0F / (from[i] * from[i]);
}

/// Why a pixel is missing in some map; saturation first, which a shorter exposure would mend.
PixelFate fate_of(std::span<const WrappedPhase> maps, std::size_t i) {
  PixelFate fate = PixelFate::Measured;
  for (const WrappedPhase& map : maps) {
    if (map.fate.pixels()[i] == PixelFate::Saturated) return PixelFate::Saturated;
    if (fate == PixelFate::Measured) fate = map.fate.pixels()[i];
  }
  return fate;
}

}  // namespace

AbsolutePhase unwrap_sequence(std::span<const WrappedPhase> coarse_to_fine,
                              const Projector& projector,
                              const TimeUnwrapOptions& options) {
  std::vector<Pattern> patterns;
  for (const WrappedPhase& map : coarse_to_fine) {
    patterns.push_back(map.pattern);
    require(same_size(map.phase_rad, coarse_to_fine.front().phase_rad),
            "unwrap_sequence: the phases differ in size");
  }
  const LadderClimb ladder(patterns, projector, options.max_wrong_order);
  const int width = coarse_to_fine.back().phase_rad.width();
  const int height = coarse_to_fine.back().phase_rad.height();
  AbsolutePhase out{coarse_to_fine.back().pattern,
                    Image<float>(width, height, Unfilled{}),
                    Image<float>(width, height, Unfilled{}),
                    Image<PixelFate>(width, height, Unfilled{})};
  parallel_chunks(out.fate.pixels().size(), kChunk, [&](std::size_t begin, std::size_t end) {
    std::vector<Lane> precisions(coarse_to_fine.size());
    std::vector<const float*> phase(coarse_to_fine.size());
    std::vector<const float*> precision(coarse_to_fine.size());
    std::array<std::int32_t, kTilePixels> lost{};
    std::array<std::int32_t, kTilePixels> doubtful{};
    for (std::size_t at = begin; at < end; at += kTilePixels) {
      const std::size_t n = std::min(kTilePixels, end - at);
      for (std::size_t m = 0; m < phase.size(); ++m) {
        precision_of(coarse_to_fine[m].sigma_rad.pixels().data() + at, n, precisions[m].data());
        precision[m] = precisions[m].data();
        phase[m] = coarse_to_fine[m].phase_rad.pixels().data() + at;
      }
      float* absolute = out.phase_rad.pixels().data() + at;
      float* sigma = out.sigma_rad.pixels().data() + at;
      for (std::size_t i = 0; i < n; ++i)
        lost[i] = static_cast<std::int32_t>(fate_of(coarse_to_fine, at + i));
      ladder.climb({phase, precision, lost.data()}, n, absolute, sigma, doubtful.data());
      for (std::size_t i = 0; i < n; ++i) {
        auto fate = static_cast<PixelFate>(lost[i]);
        if (fate == PixelFate::Measured && doubtful[i] != 0) fate = PixelFate::Doubtful;
        out.fate.pixels()[at + i] = fate;
        if (fate != PixelFate::Measured) absolute[i] = sigma[i] = kMissing;
      }
    }
  });
  return out;
}

}  // namespace frangia
