#include "frangia/phase/wrap/wrap_phase.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/resize_uninitialized.h"
#include "frangia/core/vectorized.h"
#include "frangia/phase/internal/wrap_tile.h"
#include "frangia/phase/wrap/internal/sum_frames.h"

namespace frangia {
namespace {

constexpr std::size_t kWrapChunk = 64 * kTilePixels;

/// Limits beyond which a pixel has no phase.
struct WrapLimits {
  std::int32_t white;
  float max_sigma;
};

struct Output {
  float* phase;
  float* sigma;
  float* modulation;
  float* mean;
  PixelStatus* status;
};

/// Modulation and sigma: d phi = (cos phi dS - sin phi dC) / B, where S and C are sums over frames
/// of equal variance.
FRANGIA_VECTORIZED void find_noise(const WrapTile& __restrict tile,
                                   std::size_t n,
                                   TileNoise f,
                                   float* __restrict sigma,
                                   float* __restrict modulation) {
  for (std::size_t i = 0; i < n; ++i) {
    const float s = tile.sine[i];
    const float c = tile.cosine[i];
    const float square = s * s + c * c + 1e-30F;
    const float mean = tile.mean[i] > 0.0F ? tile.mean[i] : 0.0F;
    const float variance = f.variance_floor + f.variance_slope * mean;
    const float gain = c * c * f.sine_gain + s * s * f.cosine_gain - 2.0F * s * c * f.cross_gain;
    modulation[i] = std::sqrt(square);
    sigma[i] = std::sqrt(variance * gain + 1e-30F) / square;
  }
}

FRANGIA_VECTORIZED void find_status(const float* __restrict sigma,
                                    std::size_t n,
                                    WrapLimits f,
                                    WrapTile& __restrict tile) {
  constexpr auto kSaturated = static_cast<std::int32_t>(PixelStatus::Saturated);
  constexpr auto kUnmodulated = static_cast<std::int32_t>(PixelStatus::Unmodulated);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t dim = sigma[i] <= f.max_sigma ? 0 : kUnmodulated;
    tile.status[i] = static_cast<std::int32_t>(tile.brightest[i]) >= f.white ? kSaturated : dim;
  }
}

FRANGIA_VECTORIZED void clear_discarded(const WrapTile& __restrict tile,
                                        std::size_t n,
                                        float* __restrict phase,
                                        float* __restrict sigma) {
  for (std::size_t i = 0; i < n; ++i) {
    phase[i] = tile.status[i] != 0 ? kMissing : phase[i];
    sigma[i] = tile.status[i] != 0 ? kMissing : sigma[i];
  }
}

FRANGIA_VECTORIZED void copy_out(const WrapTile& __restrict tile,
                                 std::size_t n,
                                 float* __restrict mean,
                                 PixelStatus* __restrict status) {
  for (std::size_t i = 0; i < n; ++i)
    mean[i] = tile.mean[i];
  for (std::size_t i = 0; i < n; ++i)
    status[i] = static_cast<PixelStatus>(tile.status[i]);
}

void finish_tile(
    WrapTile& tile, std::size_t n, const TileNoise& noise, float max_sigma, const Output& out) {
  find_tile_phase(tile, n, out.phase);
  find_noise(tile, n, noise, out.sigma, out.modulation);
  find_status(out.sigma, n, {noise.white, max_sigma}, tile);
  clear_discarded(tile, n, out.phase, out.sigma);
  copy_out(tile, n, out.mean, out.status);
}

}  // namespace

WrappedPhase wrap_phase(const FrameStack& stack,
                        const PhaseAlgorithm& algorithm,
                        const NoiseModel& noise,
                        const WrapOptions& options,
                        WrappedPhase recycled) {
  check_frames(stack, algorithm);
  const int width = width_of(stack.frames.front());
  const int height = height_of(stack.frames.front());
  const TileNoise noise_of_sums = tile_noise(stack, algorithm, noise);
  WrappedPhase out = std::move(recycled);
  out.pattern = stack.pattern;
  out.systematic_rad = {};
  for (auto* map : {&out.phase_rad, &out.sigma_rad, &out.modulation_counts, &out.mean_counts})
    resize_uninitialized(width, height, *map);
  resize_uninitialized(width, height, out.status);

  parallel_chunks(
      out.phase_rad.pixels().size(), kWrapChunk, [&](std::size_t begin, std::size_t end) {
        WrapTile tile;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled below
        for (std::size_t at = begin; at < end; at += kTilePixels) {
          const std::size_t n = std::min(kTilePixels, end - at);
          tile.brightest.fill(0);
          sum_frames(stack, algorithm, at, n, tile);
          finish_tile(tile,
                      n,
                      noise_of_sums,
                      options.max_sigma_rad,
                      {out.phase_rad.pixels().data() + at,
                       out.sigma_rad.pixels().data() + at,
                       out.modulation_counts.pixels().data() + at,
                       out.mean_counts.pixels().data() + at,
                       out.status.pixels().data() + at});
        }
      });
  return out;
}

}  // namespace frangia
