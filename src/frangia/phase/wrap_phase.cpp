#include "frangia/phase/wrap_phase.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"

// A function for the newest instruction set that the machine has, chosen when the program starts.
// Sanitizers run before the choice is made, so they get the plain one.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FRANGIA_VECTORISED __attribute__((target_clones("arch=haswell", "default")))
#else
#define FRANGIA_VECTORISED
#endif

namespace frangia {
namespace {

constexpr std::size_t kTile = 1024;  ///< pixels whose sums stay in the first-level cache
constexpr std::size_t kChunk = 64 * kTile;

/// Sums over the frames of one tile.
struct Tile {
  alignas(64) std::array<float, kTile> sine;
  alignas(64) std::array<float, kTile> cosine;
  alignas(64) std::array<float, kTile> mean;
  alignas(64) std::array<float, kTile> top;    ///< brightest of the frames
  alignas(64) std::array<float, kTile> outer;  ///< Carré's second difference
};

struct Weights {
  float sine;
  float cosine;
  float mean;
};

/// What the last loop needs besides the sums.
struct Finish {
  float white;
  float variance_floor;
  float variance_slope;
  float sine_gain;    ///< sum of sine[k]^2
  float cosine_gain;  ///< sum of cosine[k]^2
  float cross_gain;   ///< sum of sine[k] cosine[k]
  float max_sigma;
};

template <typename T>
FRANGIA_VECTORISED void add_frame(const T* counts, std::size_t n, Weights w, Tile& tile) {
  for (std::size_t i = 0; i < n; ++i) {
    const auto value = static_cast<float>(counts[i]);
    tile.sine[i] += w.sine * value;
    tile.cosine[i] += w.cosine * value;
    tile.mean[i] += w.mean * value;
    tile.top[i] = value > tile.top[i] ? value : tile.top[i];
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
inline float fast_atan2(float y, float x) {
  const float ax = std::fabs(x);
  const float ay = std::fabs(y);
  const float large = ax > ay ? ax : ay;
  const float small = ax > ay ? ay : ax;
  const float t = small / (large > 0.0F ? large : 1.0F);
  const float t2 = t * t;
  float p = 0.002456724222F;
  p = p * t2 - 0.01440135652F;
  p = p * t2 + 0.03978122134F;
  p = p * t2 - 0.07234857177F;
  p = p * t2 + 0.1049894598F;
  p = p * t2 - 0.1416122916F;
  p = p * t2 + 0.1998590676F;
  p = p * t2 - 0.3333259703F;
  p = p * t2 + 0.9999998864F;
  float angle = p * t;
  angle = ay > ax ? 1.57079632679F - angle : angle;
  angle = x < 0.0F ? 3.14159265359F - angle : angle;
  return y < 0.0F ? -angle : angle;
}

FRANGIA_VECTORISED void finish_tile(const Tile& tile, std::size_t n, const Finish& f, Output out) {
  for (std::size_t i = 0; i < n; ++i) {
    const float s = tile.sine[i];
    const float c = tile.cosine[i];
    const float square = s * s + c * c;
    const float modulation = std::sqrt(square);
    const float mean = tile.mean[i] > 0.0F ? tile.mean[i] : 0.0F;
    const float variance = f.variance_floor + f.variance_slope * mean;
    // d phi = (cos phi dS - sin phi dC) / B, with S and C sums over frames of equal variance.
    const float gain = c * c * f.sine_gain + s * s * f.cosine_gain - 2.0F * s * c * f.cross_gain;
    const float sigma = std::sqrt(variance * gain) / (square > 0.0F ? square : 1e-30F);
    const float phase = fast_atan2(s, c);
    const bool saturated = tile.top[i] >= f.white;
    const bool unmodulated = !(sigma <= f.max_sigma) || square <= 0.0F;
    const bool lost = saturated || unmodulated;
    out.phase[i] = lost ? kMissing : phase;
    out.sigma[i] = lost ? kMissing : sigma;
    out.modulation[i] = modulation;
    out.mean[i] = tile.mean[i];
  }
  for (std::size_t i = 0; i < n; ++i) {
    const bool saturated = tile.top[i] >= f.white;
    const bool unmodulated = !(out.sigma[i] <= f.max_sigma);
    out.fate[i] = saturated     ? PixelFate::Saturated
                  : unmodulated ? PixelFate::Unmodulated
                                : PixelFate::Measured;
  }
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
                height_of(frame) == height_of(stack.frames.front()),
            "wrap_phase: the frames differ in size");
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
                        const WrapOptions& options) {
  check(stack, algorithm);
  const int width = width_of(stack.frames.front());
  const int height = height_of(stack.frames.front());
  const Finish finish = finish_of(stack, algorithm, noise, options);
  WrappedPhase out{.pattern = stack.pattern,
                   .phase_rad = Image<float>(width, height),
                   .sigma_rad = Image<float>(width, height),
                   .modulation_counts = Image<float>(width, height),
                   .mean_counts = Image<float>(width, height),
                   .fate = Image<PixelFate>(width, height)};

  parallel_chunks(out.phase_rad.pixels().size(), kChunk, [&](std::size_t begin, std::size_t end) {
    Tile tile;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled below
    for (std::size_t at = begin; at < end; at += kTile) {
      const std::size_t n = std::min(kTile, end - at);
      tile.sine.fill(0.0F);
      tile.cosine.fill(0.0F);
      tile.mean.fill(0.0F);
      tile.top.fill(0.0F);
      for (std::size_t k = 0; k < stack.frames.size(); ++k) {
        const Weights weights{static_cast<float>(algorithm.sine[k]),
                              static_cast<float>(algorithm.cosine[k]),
                              static_cast<float>(algorithm.mean[k])};
        std::visit(
            [&](const auto& image) { add_frame(image.pixels().data() + at, n, weights, tile); },
            stack.frames[k]);
      }
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
