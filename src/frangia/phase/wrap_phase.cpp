#include "frangia/phase/wrap_phase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/vectorised.h"

namespace frangia {
namespace {

constexpr std::size_t kTile = 1024;  ///< pixels whose sums stay in the first-level cache
constexpr std::size_t kChunk = 64 * kTile;

using Lane = std::array<float, kTile>;

/// Sums over the frames of one tile, and what follows from them.
struct Tile {
  alignas(64) Lane sine;
  alignas(64) Lane cosine;
  alignas(64) Lane mean;
  alignas(64) Lane top;                              ///< brightest of the frames
  alignas(64) Lane outer;                            ///< Carré's second difference
  alignas(64) std::array<std::int32_t, kTile> lost;  ///< a PixelFate; narrow ones do not vectorise
};

struct Weights {
  float sine;
  float cosine;
  float mean;
};

/// What the last loops need besides the sums.
struct Finish {
  float white;
  float variance_floor;
  float variance_slope;
  float sine_gain;    ///< sum of sine[k]^2
  float cosine_gain;  ///< sum of cosine[k]^2
  float cross_gain;   ///< sum of sine[k] cosine[k]
  float max_sigma;
};

// One small loop a step, its values in the first-level cache: a single large one does not
// vectorise.

/// Adds two frames at once: the sums are loaded and stored half as often.
template <typename T>
FRANGIA_VECTORISED void add_frames(const T* __restrict a,
                                   const T* __restrict b,
                                   std::size_t n,
                                   std::array<Weights, 2> w,
                                   Tile& __restrict tile) {
  for (std::size_t i = 0; i < n; ++i) {
    const auto one = static_cast<float>(a[i]);
    const auto two = static_cast<float>(b[i]);
    const float top = one > two ? one : two;
    tile.sine[i] += w[0].sine * one + w[1].sine * two;
    tile.cosine[i] += w[0].cosine * one + w[1].cosine * two;
    tile.mean[i] += w[0].mean * one + w[1].mean * two;
    tile.top[i] = top > tile.top[i] ? top : tile.top[i];
  }
}

template <typename T>
FRANGIA_VECTORISED void add_outer(const T* counts, std::size_t n, float weight, Tile& tile) {
  for (std::size_t i = 0; i < n; ++i)
    tile.outer[i] += weight * static_cast<float>(counts[i]);
}

/// Carré's sine from its two differences, and both turned back by the angle of `c` and `s`.
FRANGIA_VECTORISED void finish_carre(std::size_t n, float c, float s, Tile& tile) {
  for (std::size_t i = 0; i < n; ++i) {
    const float u = tile.sine[i];
    const float square = (3.0F * u - tile.outer[i]) * (u + tile.outer[i]);
    const float size = std::sqrt(square > 0.0F ? square : 0.0F);
    const float sine = u < 0.0F ? -size : size;
    tile.sine[i] = sine * c - tile.cosine[i] * s;
    tile.cosine[i] = tile.cosine[i] * c + sine * s;
  }
}

struct Output {
  float* phase;
  float* sigma;
  float* modulation;
  float* mean;
  PixelFate* fate;
};

/// atan2 by an odd polynomial on [0, 1], error 2.7e-7 rad; without a branch, so that it vectorises.
[[gnu::always_inline]] inline float fast_atan2(float y, float x) {
  const float ax = std::fabs(x);
  const float ay = std::fabs(y);
  const float large = ax > ay ? ax : ay;
  const float small = ax > ay ? ay : ax;
  const float t = small / (large > 0.0F ? large : 1.0F);
  const float t2 = t * t;
  // In pairs of powers, so that the products need not wait for each other.
  const float t4 = t2 * t2;
  const float t8 = t4 * t4;
  const float low =
      (0.9999998864F - 0.3333259703F * t2) + (0.1998590676F - 0.1416122916F * t2) * t4;
  const float high =
      (0.1049894598F - 0.07234857177F * t2) + (0.03978122134F - 0.01440135652F * t2) * t4;
  const float p = low + t8 * (high + 0.002456724222F * t8);
  float angle = p * t;
  angle = ay > ax ? 1.57079632679F - angle : angle;
  angle = x < 0.0F ? 3.14159265359F - angle : angle;
  return y < 0.0F ? -angle : angle;
}

FRANGIA_VECTORISED void find_phase(const Tile& __restrict tile,
                                   std::size_t n,
                                   float* __restrict phase) {
  for (std::size_t i = 0; i < n; ++i)
    phase[i] = fast_atan2(tile.sine[i], tile.cosine[i]);
}

/// Modulation, mean and sigma: d phi = (cos phi dS - sin phi dC) / B, with S and C sums over frames
/// of equal variance.
FRANGIA_VECTORISED void find_noise(const Tile& __restrict tile,
                                   std::size_t n,
                                   Finish f,
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

FRANGIA_VECTORISED void find_lost(const float* __restrict sigma,
                                  std::size_t n,
                                  Finish f,
                                  Tile& __restrict tile) {
  constexpr auto kSaturated = static_cast<std::int32_t>(PixelFate::Saturated);
  constexpr auto kUnmodulated = static_cast<std::int32_t>(PixelFate::Unmodulated);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t dim = sigma[i] <= f.max_sigma ? 0 : kUnmodulated;
    tile.lost[i] = tile.top[i] >= f.white ? kSaturated : dim;
  }
}

FRANGIA_VECTORISED void discard_lost(const Tile& __restrict tile,
                                     std::size_t n,
                                     float* __restrict phase,
                                     float* __restrict sigma) {
  for (std::size_t i = 0; i < n; ++i) {
    phase[i] = tile.lost[i] != 0 ? kMissing : phase[i];
    sigma[i] = tile.lost[i] != 0 ? kMissing : sigma[i];
  }
}

FRANGIA_VECTORISED void copy_out(const Tile& __restrict tile,
                                 std::size_t n,
                                 float* __restrict mean,
                                 PixelFate* __restrict fate) {
  for (std::size_t i = 0; i < n; ++i)
    mean[i] = tile.mean[i];
  for (std::size_t i = 0; i < n; ++i)
    fate[i] = static_cast<PixelFate>(tile.lost[i]);
}

void finish_tile(Tile& tile, std::size_t n, const Finish& f, const Output& out) {
  find_phase(tile, n, out.phase);
  find_noise(tile, n, f, out.sigma, out.modulation);
  find_lost(out.sigma, n, f, tile);
  discard_lost(tile, n, out.phase, out.sigma);
  copy_out(tile, n, out.mean, out.fate);
}

/// An image of this size to be written all over: the one at hand when it fits.
template <typename T>
void make_room(int width, int height, Image<T>& image) {
  if (image.width() != width || image.height() != height)
    image = Image<T>(width, height, Unfilled{});
}

void check(const FrameStack& stack, const PhaseAlgorithm& algorithm) {
  if (stack.frames.size() != algorithm.sine.size()) {
    throw Error(ErrorKind::Input,
                fmt::format("pattern \"{}\" has {} frames, but the algorithm \"{}\" takes {}",
                            stack.pattern.name,
                            stack.frames.size(),
                            algorithm.name,
                            algorithm.sine.size()));
  }
  for (const Frame& frame : stack.frames) {
    require(width_of(frame) == width_of(stack.frames.front()) &&
                height_of(frame) == height_of(stack.frames.front()) &&
                frame.index() == stack.frames.front().index(),
            "wrap_phase: the frames differ in size or depth");
  }
}

Finish finish_of(const FrameStack& stack,
                 const PhaseAlgorithm& algorithm,
                 const NoiseModel& noise,
                 const WrapOptions& options) {
  double sine_gain = 0.0;
  double cosine_gain = 0.0;
  double cross_gain = 0.0;
  for (std::size_t k = 0; k < algorithm.sine.size(); ++k) {
    sine_gain += algorithm.sine[k] * algorithm.sine[k];
    cosine_gain += algorithm.cosine[k] * algorithm.cosine[k];
    cross_gain += algorithm.sine[k] * algorithm.cosine[k];
  }
  if (!algorithm.outer.empty()) {  // not linear: the mean over the fringe
    sine_gain = cosine_gain = algorithm.noise_gain * algorithm.noise_gain;
    cross_gain = 0.0;
  }
  return {.white = static_cast<float>(stack.white_level),
          .variance_floor = static_cast<float>(noise.floor_counts2),
          .variance_slope = static_cast<float>(noise.slope_counts),
          .sine_gain = static_cast<float>(sine_gain),
          .cosine_gain = static_cast<float>(cosine_gain),
          .cross_gain = static_cast<float>(cross_gain),
          .max_sigma = options.max_sigma_rad};
}

/// Sums over all frames; an odd last one goes with itself at no weight.
void add_all(const FrameStack& stack,
             const PhaseAlgorithm& algorithm,
             std::size_t at,
             std::size_t n,
             Tile& tile) {
  const auto weights = [&](std::size_t k) {
    return k < algorithm.frames() ? Weights{static_cast<float>(algorithm.sine[k]),
                                            static_cast<float>(algorithm.cosine[k]),
                                            static_cast<float>(algorithm.mean[k])}
                                  : Weights{0.0F, 0.0F, 0.0F};
  };
  for (std::size_t k = 0; k < stack.frames.size(); k += 2) {
    std::visit(
        [&](const auto& image) {
          using Same = std::remove_cvref_t<decltype(image)>;
          const auto& next = std::get<Same>(stack.frames[std::min(k + 1, stack.frames.size() - 1)]);
          add_frames(image.pixels().data() + at,
                     next.pixels().data() + at,
                     n,
                     {weights(k), weights(k + 1)},
                     tile);
        },
        stack.frames[k]);
  }
}

void add_carre(const FrameStack& stack,
               const PhaseAlgorithm& algorithm,
               std::size_t at,
               std::size_t n,
               Tile& tile) {
  tile.outer.fill(0.0F);
  for (std::size_t k = 0; k < stack.frames.size(); ++k) {
    const auto weight = static_cast<float>(algorithm.outer[k]);
    std::visit([&](const auto& image) { add_outer(image.pixels().data() + at, n, weight, tile); },
               stack.frames[k]);
  }
  finish_carre(n,
               static_cast<float>(std::cos(algorithm.turn_rad)),
               static_cast<float>(std::sin(algorithm.turn_rad)),
               tile);
}

}  // namespace

WrappedPhase wrap_phase(const FrameStack& stack,
                        const PhaseAlgorithm& algorithm,
                        const NoiseModel& noise,
                        const WrapOptions& options,
                        WrappedPhase lent) {
  check(stack, algorithm);
  const int width = width_of(stack.frames.front());
  const int height = height_of(stack.frames.front());
  const Finish finish = finish_of(stack, algorithm, noise, options);
  WrappedPhase out = std::move(lent);
  out.pattern = stack.pattern;
  for (auto* map : {&out.phase_rad, &out.sigma_rad, &out.modulation_counts, &out.mean_counts})
    make_room(width, height, *map);
  make_room(width, height, out.fate);

  parallel_chunks(out.phase_rad.pixels().size(), kChunk, [&](std::size_t begin, std::size_t end) {
    Tile tile;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled below
    for (std::size_t at = begin; at < end; at += kTile) {
      const std::size_t n = std::min(kTile, end - at);
      tile.sine.fill(0.0F);
      tile.cosine.fill(0.0F);
      tile.mean.fill(0.0F);
      tile.top.fill(0.0F);
      add_all(stack, algorithm, at, n, tile);
      if (!algorithm.outer.empty()) add_carre(stack, algorithm, at, n, tile);
      finish_tile(tile,
                  n,
                  finish,
                  {out.phase_rad.pixels().data() + at,
                   out.sigma_rad.pixels().data() + at,
                   out.modulation_counts.pixels().data() + at,
                   out.mean_counts.pixels().data() + at,
                   out.fate.pixels().data() + at});
    }
  });
  return out;
}

}  // namespace frangia
