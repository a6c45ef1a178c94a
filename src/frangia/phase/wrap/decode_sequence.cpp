#include "frangia/phase/wrap/decode_sequence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/image.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/vectorized.h"
#include "frangia/phase/internal/hierarchical_unwrapper.h"
#include "frangia/phase/internal/wrap_tile.h"
#include "frangia/phase/wrap/internal/phase_kernel.h"
#include "frangia/phase/wrap/internal/sum_frames.h"

namespace frangia {
namespace {

/// Not a power of two: lanes whose distance is a power of two share one cache set.
constexpr std::size_t kLane = kTilePixels + 16;
constexpr std::size_t kDecodeChunk = 64 * kTilePixels;

using TileInts = std::array<std::int32_t, kTilePixels>;

FRANGIA_VECTORIZED void lower(const float* __restrict precision,
                              std::size_t n,
                              float* __restrict lowest_precision) {
  for (std::size_t i = 0; i < n; ++i)
    lowest_precision[i] = precision[i] < lowest_precision[i] ? precision[i] : lowest_precision[i];
}

/// Limits beyond which a pixel has no phase.
struct DecodeLimits {
  float min_precision;
  std::int32_t white;
};

FRANGIA_VECTORIZED void find_status(const float* __restrict lowest_precision,
                                    const std::uint16_t* __restrict brightest,
                                    std::size_t n,
                                    DecodeLimits limits,
                                    std::int32_t* __restrict status) {
  constexpr auto kSaturated = static_cast<std::int32_t>(PixelStatus::Saturated);
  constexpr auto kUnmodulated = static_cast<std::int32_t>(PixelStatus::Unmodulated);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t dim = lowest_precision[i] >= limits.min_precision ? 0 : kUnmodulated;
    status[i] = static_cast<std::int32_t>(brightest[i]) >= limits.white ? kSaturated : dim;
  }
}

FRANGIA_VECTORIZED bool any_measured(const std::int32_t* status, std::size_t n) {
  std::int32_t measured = 0;
  for (std::size_t i = 0; i < n; ++i)
    measured |= status[i] == 0 ? 1 : 0;
  return measured != 0;
}

FRANGIA_VECTORIZED void discard(const std::int32_t* __restrict uncertain,
                                std::size_t n,
                                std::int32_t* __restrict status,
                                float* __restrict phase,
                                float* __restrict sigma) {
  constexpr auto kUncertain = static_cast<std::int32_t>(PixelStatus::UncertainOrder);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t result = status[i] != 0 ? status[i] : uncertain[i] * kUncertain;
    status[i] = result;
    phase[i] = result != 0 ? kMissing : phase[i];
    sigma[i] = result != 0 ? kMissing : sigma[i];
  }
}

FRANGIA_VECTORIZED void narrow(const std::int32_t* __restrict status,
                               std::size_t n,
                               PixelStatus* __restrict out) {
  for (std::size_t i = 0; i < n; ++i)
    out[i] = static_cast<PixelStatus>(status[i]);
}

/// Decodes all maps, tile by tile, in one thread.
class TileDecoder {
 public:
  TileDecoder(std::span<const PhaseKernel> maps,
              const HierarchicalUnwrapper& unwrapper,
              float min_precision)
      : maps_(maps),
        unwrapper_(unwrapper),
        min_precision_(min_precision),
        lanes_(2 * maps.size() * kLane) {
    for (std::size_t m = 0; m < maps.size(); ++m) {
      phase_.push_back(lane(2 * m));
      precision_.push_back(lane(2 * m + 1));
    }
  }

  void decode(std::size_t at, std::size_t n, AbsolutePhase& out) {
    brightest_.fill(0);
    lowest_precision_.fill(std::numeric_limits<float>::max());
    for (std::size_t m = 0; m < maps_.size(); ++m) {
      float* phase = lane(2 * m);
      float* precision = lane(2 * m + 1);
      maps_[m].wrap(at,
                    n,
                    scratch_,
                    {.phase_rad = phase,
                     .precision = precision,
                     .sigma_rad = nullptr,
                     .modulation_counts = nullptr,
                     .mean_counts = nullptr,
                     .brightest = brightest_.data()});
      lower(precision, n, lowest_precision_.data());
    }
    find_status(lowest_precision_.data(),
                brightest_.data(),
                n,
                {min_precision_, maps_.front().white()},
                status_.data());
    float* phase = out.phase_rad.pixels().data() + at;
    float* sigma = out.sigma_rad.pixels().data() + at;
    if (any_measured(status_.data(), n))
      unwrapper_.unwrap({phase_, precision_, status_.data()}, n, phase, sigma, uncertain_.data());
    discard(uncertain_.data(), n, status_.data(), phase, sigma);
    narrow(status_.data(), n, out.status.pixels().data() + at);
  }

 private:
  float* lane(std::size_t k) { return lanes_.data() + k * kLane; }

  std::span<const PhaseKernel> maps_;
  const HierarchicalUnwrapper& unwrapper_;
  float min_precision_;
  WrapTile scratch_;
  std::vector<float> lanes_;  ///< phase and precision of each map
  std::vector<const float*> phase_;
  std::vector<const float*> precision_;
  alignas(64) Lane lowest_precision_{};
  alignas(64) std::array<std::uint16_t, kTilePixels> brightest_{};
  TileInts status_{};
  TileInts uncertain_{};
};

}  // namespace

AbsolutePhase decode_sequence(std::span<const SequenceFrames> coarse_to_fine,
                              const NoiseModel& noise,
                              const Projector& projector,
                              const SequenceOptions& options,
                              AbsolutePhase recycled) {
  std::vector<Pattern> patterns;
  std::vector<PhaseKernel> maps;
  for (const SequenceFrames& map : coarse_to_fine) {
    maps.emplace_back(*map.stack, map.algorithm, noise);
    require(width_of(map.stack->frames.front()) ==
                    width_of(coarse_to_fine.front().stack->frames.front()) &&
                height_of(map.stack->frames.front()) ==
                    height_of(coarse_to_fine.front().stack->frames.front()),
            "decode_sequence: the patterns' frames differ in size");
    patterns.push_back(map.stack->pattern);
  }
  const HierarchicalUnwrapper unwrapper(patterns, projector, options.temporal.max_wrong_order);
  const Frame& first = coarse_to_fine.front().stack->frames.front();
  AbsolutePhase out = std::move(recycled);
  out.pattern = patterns.back();
  out.systematic_rad = {};
  resize_uninitialized(width_of(first), height_of(first), out.phase_rad);
  resize_uninitialized(width_of(first), height_of(first), out.sigma_rad);
  resize_uninitialized(width_of(first), height_of(first), out.status);
  const float min_precision = 1.0F / (options.wrap.max_sigma_rad * options.wrap.max_sigma_rad);
  parallel_chunks(
      out.status.pixels().size(), kDecodeChunk, [&](std::size_t begin, std::size_t end) {
        TileDecoder decoder(maps, unwrapper, min_precision);
        for (std::size_t at = begin; at < end; at += kTilePixels)
          decoder.decode(at, std::min(kTilePixels, end - at), out);
      });
  return out;
}

}  // namespace frangia
