#include "frangia/phase/wrap/wrap_phase.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "frangia/core/image.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/vectorized.h"
#include "frangia/phase/internal/wrap_tile.h"
#include "frangia/phase/wrap/internal/phase_kernel.h"
#include "frangia/phase/wrap/internal/sum_frames.h"

namespace frangia {
namespace {

constexpr std::size_t kWrapChunk = 64 * kTilePixels;

/// Limits beyond which a pixel has no phase.
struct WrapLimits {
  std::int32_t white;
  float max_sigma;
};

/// Brightest counts and result of the pixels of a tile.
struct TileState {
  alignas(64) std::array<std::uint16_t, kTilePixels> brightest;
  alignas(64) std::array<std::int32_t,
                         kTilePixels> status;  ///< a PixelStatus; narrower types do not vectorize
};

FRANGIA_VECTORIZED void find_status(const float* __restrict sigma,
                                    std::size_t n,
                                    WrapLimits f,
                                    TileState& __restrict state) {
  constexpr auto kSaturated = static_cast<std::int32_t>(PixelStatus::Saturated);
  constexpr auto kUnmodulated = static_cast<std::int32_t>(PixelStatus::Unmodulated);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t dim = sigma[i] <= f.max_sigma ? 0 : kUnmodulated;
    state.status[i] = static_cast<std::int32_t>(state.brightest[i]) >= f.white ? kSaturated : dim;
  }
}

FRANGIA_VECTORIZED void multiply(const float* __restrict gain,
                                 std::size_t n,
                                 float* __restrict sigma) {
  for (std::size_t i = 0; i < n; ++i)
    sigma[i] *= gain[i];
}

FRANGIA_VECTORIZED void clear_discarded(const TileState& __restrict state,
                                        std::size_t n,
                                        float* __restrict phase,
                                        float* __restrict sigma) {
  for (std::size_t i = 0; i < n; ++i) {
    phase[i] = state.status[i] != 0 ? kMissing : phase[i];
    sigma[i] = state.status[i] != 0 ? kMissing : sigma[i];
  }
}

FRANGIA_VECTORIZED void narrow(const TileState& __restrict state,
                               std::size_t n,
                               PixelStatus* __restrict status) {
  for (std::size_t i = 0; i < n; ++i)
    status[i] = static_cast<PixelStatus>(state.status[i]);
}

}  // namespace

WrappedPhase wrap_phase(const FrameStack& stack,
                        const PhaseAlgorithm& algorithm,
                        const NoiseModel& noise,
                        const WrapOptions& options,
                        WrappedPhase recycled) {
  const PhaseKernel kernel(stack, algorithm, noise);
  const int width = width_of(stack.frames.front());
  const int height = height_of(stack.frames.front());
  WrappedPhase out = std::move(recycled);
  out.pattern = stack.pattern;
  out.systematic_rad = {};
  for (auto* map : {&out.phase_rad, &out.sigma_rad, &out.modulation_counts, &out.mean_counts})
    resize_uninitialized(width, height, *map);
  resize_uninitialized(width, height, out.status);

  parallel_chunks(
      out.phase_rad.pixels().size(), kWrapChunk, [&](std::size_t begin, std::size_t end) {
        WrapTile scratch;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled below
        TileState state;   // NOLINT(cppcoreguidelines-pro-type-member-init): filled below
        for (std::size_t at = begin; at < end; at += kTilePixels) {
          const std::size_t n = std::min(kTilePixels, end - at);
          float* phase = out.phase_rad.pixels().data() + at;
          float* sigma = out.sigma_rad.pixels().data() + at;
          state.brightest.fill(0);
          kernel.wrap(at,
                      n,
                      scratch,
                      {.phase_rad = phase,
                       .precision = nullptr,
                       .sigma_rad = sigma,
                       .modulation_counts = out.modulation_counts.pixels().data() + at,
                       .mean_counts = out.mean_counts.pixels().data() + at,
                       .brightest = state.brightest.data()});
          if (!stack.noise_gain.empty()) multiply(stack.noise_gain.pixels().data() + at, n, sigma);
          find_status(sigma, n, {kernel.white(), options.max_sigma_rad}, state);
          clear_discarded(state, n, phase, sigma);
          narrow(state, n, out.status.pixels().data() + at);
        }
      });
  return out;
}

}  // namespace frangia
