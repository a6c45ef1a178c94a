#include "frangia/phase/wrap/internal/phase_kernel.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/vectorized.h"
#include "frangia/phase/internal/fast_atan2.h"

namespace frangia {
namespace {

/// Keeps the precision of frames without noise finite, for the deepest frames too.
constexpr float kLeastVariance = 1e-12F;

void check_frames(const FrameStack& stack, const PhaseAlgorithm& algorithm) {
  if (stack.frames.size() != algorithm.sine.size()) {
    throw Error(ErrorKind::Input,
                fmt::format(R"(pattern "{}" has {} frames, but the algorithm "{}" takes {})",
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

SumNoise noise_of_sums(const PhaseAlgorithm& algorithm, const NoiseModel& noise) {
  double sine_gain = 0.0;
  double cosine_gain = 0.0;
  double cross_gain = 0.0;
  for (std::size_t k = 0; k < algorithm.sine.size(); ++k) {
    sine_gain += algorithm.sine[k] * algorithm.sine[k];
    cosine_gain += algorithm.cosine[k] * algorithm.cosine[k];
    cross_gain += algorithm.sine[k] * algorithm.cosine[k];
  }
  if (!algorithm.outer.empty()) {  // nonlinear algorithm: mean over the fringe
    sine_gain = cosine_gain = algorithm.noise_gain * algorithm.noise_gain;
    cross_gain = 0.0;
  }
  return {.variance_floor = static_cast<float>(noise.floor_counts2),
          .variance_slope = static_cast<float>(noise.slope_counts),
          .variance_dark = static_cast<float>(noise.dark_counts2),
          .dark_range = static_cast<float>(noise.dark_range_counts),
          .sine_gain = static_cast<float>(sine_gain),
          .cosine_gain = static_cast<float>(cosine_gain),
          .cross_gain = static_cast<float>(cross_gain)};
}

FRANGIA_VECTORIZED void find_phase(const WrapTile& __restrict tile,
                                   std::size_t n,
                                   float* __restrict phase_rad) {
  for (std::size_t i = 0; i < n; ++i)
    phase_rad[i] = fast_atan2(tile.sine[i], tile.cosine[i]);
}

/// `kAll`: what a map keeps; else the precision alone. `kDark`: the noise of dark pixels exceeds
/// the straight line, which takes a division.
template <bool kAll, bool kDark>
FRANGIA_VECTORIZED void find_precision(const WrapTile& __restrict tile,
                                       std::size_t n,
                                       SumNoise f,
                                       const TilePhase& out) {
  float* __restrict precision = out.precision;
  float* __restrict sigma = out.sigma_rad;
  float* __restrict modulation = out.modulation_counts;
  float* __restrict means = out.mean_counts;
  for (std::size_t i = 0; i < n; ++i) {
    const float s = tile.sine[i];
    const float c = tile.cosine[i];
    const float square = s * s + c * c;
    const float mean = tile.mean[i] > 0.0F ? tile.mean[i] : 0.0F;
    float variance = f.variance_floor + f.variance_slope * mean;
    if constexpr (kDark) {
      const float left = f.dark_range / (mean + f.dark_range);
      variance += f.variance_dark * left * left;
    }
    const float gain = c * c * f.sine_gain + s * s * f.cosine_gain - 2.0F * s * c * f.cross_gain;
    const float product = variance * gain + kLeastVariance;
    if constexpr (!kAll) {
      precision[i] = square * square / product;
    } else {
      sigma[i] = std::sqrt(product) / square;
      modulation[i] = std::sqrt(square);
      means[i] = tile.mean[i];
    }
  }
}

/// The four frames, ordered such that the sine is proportional to d - b and the cosine to a - c.
template <typename T>
struct FourFrames {
  const T* a;
  const T* b;
  const T* c;
  const T* d;
};

/// Variance of the phase times the squared modulation, both from unscaled differences of counts.
struct FourStepNoise {
  float floor;
  float slope;  ///< per count of the sum of all four frames
};

/// What unscaled differences and sums of counts are multiplied with.
struct FourStepScales {
  FourStepNoise noise;
  float modulation;
  float mean;
};

/// Differences and sum of the four frames, as integers twice as wide as the counts, which vectorize
/// better than float.
template <typename T>
struct Sums {
  using Whole = std::conditional_t<sizeof(T) == 1, std::int16_t, std::int32_t>;
  /// Not a power of two: lanes whose distance is a power of two share one cache set.
  using Counts = std::array<Whole, kTilePixels + 32>;
  alignas(64) Counts sine;
  alignas(64) Counts cosine;
  alignas(64) Counts all;
};

template <typename T>
FRANGIA_VECTORIZED void sum_four(FourFrames<T> frames, std::size_t n, Sums<T>& __restrict sums) {
  using Whole = typename Sums<T>::Whole;
  const T* __restrict a = frames.a;
  const T* __restrict b = frames.b;
  const T* __restrict c = frames.c;
  const T* __restrict d = frames.d;
  for (std::size_t i = 0; i < n; ++i) {
    const auto one = static_cast<Whole>(a[i]);
    const auto two = static_cast<Whole>(b[i]);
    const auto three = static_cast<Whole>(c[i]);
    const auto four = static_cast<Whole>(d[i]);
    sums.sine[i] = static_cast<Whole>(four - two);
    sums.cosine[i] = static_cast<Whole>(one - three);
    sums.all[i] = static_cast<Whole>((one + three) + (two + four));
  }
}

/// `kAll`: what a map keeps; else the precision alone.
template <bool kAll, typename T>
FRANGIA_VECTORIZED void find_phase(const Sums<T>& __restrict sums,
                                   std::size_t n,
                                   FourStepScales scales,
                                   const TilePhase& out) {
  const FourStepNoise noise = scales.noise;
  float* __restrict phase = out.phase_rad;
  float* __restrict precision = out.precision;
  float* __restrict sigma = out.sigma_rad;
  float* __restrict modulation = out.modulation_counts;
  float* __restrict means = out.mean_counts;
  for (std::size_t i = 0; i < n; ++i) {
    const auto y = static_cast<float>(sums.sine[i]);
    const auto x = static_cast<float>(sums.cosine[i]);
    const auto all = static_cast<float>(sums.all[i]);
    const float square = x * x + y * y;
    const float variance = noise.floor + noise.slope * all;
    const float ax = std::fabs(x);
    const float ay = std::fabs(y);
    const float larger = ax > ay ? ax : ay;
    const float smaller = ax > ay ? ay : ax;
    const float large = larger > 0.5F ? larger : 0.5F;  // otherwise an integer of at least 1
    const float inverse = 1.0F / (large * variance);    // one division serves both quotients
    phase[i] = restore_octant(fast_atan(smaller * (variance * inverse)), y, x);
    if constexpr (!kAll) {
      precision[i] = square * (large * inverse);
    } else {
      sigma[i] = std::sqrt(variance / square);
      modulation[i] = scales.modulation * std::sqrt(square);
      means[i] = scales.mean * all;
    }
  }
}

/// Maximum over the frames in their own integer type, which gives the widest vectors.
template <typename T>
FRANGIA_VECTORIZED void update_brightest(FourFrames<T> frames,
                                         std::size_t n,
                                         std::uint16_t* __restrict brightest) {
  const T* __restrict a = frames.a;
  const T* __restrict b = frames.b;
  const T* __restrict c = frames.c;
  const T* __restrict d = frames.d;
  for (std::size_t i = 0; i < n; ++i) {
    const T left = a[i] > b[i] ? a[i] : b[i];
    const T right = c[i] > d[i] ? c[i] : d[i];
    const std::uint16_t most = left > right ? left : right;
    brightest[i] = most > brightest[i] ? most : brightest[i];
  }
}

template <typename T>
void wrap(FourFrames<T> frames, std::size_t n, const FourStepScales& scales, const TilePhase& out) {
  Sums<T> sums;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled below
  sum_four<T>(frames, n, sums);
  if (out.precision == nullptr) {
    find_phase<true>(sums, n, scales, out);
  } else {
    find_phase<false>(sums, n, scales, out);
  }
  update_brightest<T>(frames, n, out.brightest);
}

/// Returns whether an algorithm is the four-step algorithm: its sine uses the second and fourth
/// frame, its cosine the first and third, and its mean all four equally.
bool is_four_step(const PhaseAlgorithm& algorithm) {
  constexpr double kNothing = 1e-9;
  const std::vector<double>& sine = algorithm.sine;
  const std::vector<double>& cosine = algorithm.cosine;
  const std::vector<double>& mean = algorithm.mean;
  const auto is = [](double a, double b) { return std::abs(a - b) < kNothing; };
  return sine.size() == 4 && algorithm.outer.empty() && is(sine[0], 0.0) && is(sine[2], 0.0) &&
         is(sine[1], -sine[3]) && is(cosine[1], 0.0) && is(cosine[3], 0.0) &&
         is(cosine[2], -cosine[0]) && is(std::abs(sine[3]), std::abs(cosine[0])) &&
         is(mean[1], mean[0]) && is(mean[2], mean[0]) && is(mean[3], mean[0]);
}

/// Frames for which `is_four_step` holds, and the noise of their weighted sums.
struct FourStepFrames {
  const FrameStack& stack;
  const PhaseAlgorithm& algorithm;
  const SumNoise& noise;
};

/// Computes a tile from two differences of counts instead of three weighted sums.
void wrap_four_step(const FourStepFrames& frames,
                    std::size_t at,
                    std::size_t n,
                    const TilePhase& out) {
  const PhaseAlgorithm& algorithm = frames.algorithm;
  const SumNoise& noise = frames.noise;
  const std::vector<Frame>& images = frames.stack.frames;
  // The differences are not scaled: their scale enters the noise, their sign the order of the
  // frames.
  const double scale = algorithm.sine[3] * algorithm.sine[3];
  const double gain = static_cast<double>(noise.sine_gain) / scale;
  const FourStepScales scales{
      .noise = {.floor = static_cast<float>(noise.variance_floor * gain + kLeastVariance),
                .slope = static_cast<float>(noise.variance_slope * gain * algorithm.mean.front())},
      .modulation = static_cast<float>(std::abs(algorithm.sine[3])),
      .mean = static_cast<float>(algorithm.mean.front())};
  const std::size_t b = algorithm.sine[3] > 0.0 ? 1 : 3;
  const std::size_t a = algorithm.cosine[0] > 0.0 ? 0 : 2;
  std::visit(
      [&](const auto& first) {
        using T = std::decay_t<decltype(*first.pixels().data())>;
        const auto pixels = [&](std::size_t k) {
          return std::get<Image<T>>(images[k]).pixels().data() + at;
        };
        wrap<T>({pixels(a), pixels(b), pixels(2 - a), pixels(4 - b)}, n, scales, out);
      },
      images.front());
}

}  // namespace

PhaseKernel::PhaseKernel(const FrameStack& stack,
                         const PhaseAlgorithm& algorithm,
                         const NoiseModel& noise)
    : stack_(&stack),
      algorithm_(&algorithm),
      noise_(noise_of_sums(algorithm, noise)),
      is_four_step_(is_four_step(algorithm) && noise.dark_counts2 == 0.0) {
  check_frames(stack, algorithm);
}

void PhaseKernel::wrap(std::size_t at,
                       std::size_t n,
                       WrapTile& scratch,
                       const TilePhase& out) const {
  if (is_four_step_) {
    wrap_four_step({*stack_, *algorithm_, noise_}, at, n, out);
    return;
  }
  sum_frames(*stack_, *algorithm_, at, n, scratch, out.brightest);
  find_phase(scratch, n, out.phase_rad);
  const bool is_dark = noise_.variance_dark > 0.0F;
  if (out.precision == nullptr) {
    (is_dark ? find_precision<true, true> : find_precision<true, false>)(scratch, n, noise_, out);
  } else {
    (is_dark ? find_precision<false, true> : find_precision<false, false>)(scratch, n, noise_, out);
  }
}

}  // namespace frangia
