#include "frangia/phase/wrap/internal/sum_frames.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <variant>

#include "frangia/core/vectorized.h"

namespace frangia {
namespace {

struct SineCosineMean {
  float sine = 0.0F;
  float cosine = 0.0F;
  float mean = 0.0F;
};

SineCosineMean weights_of(const PhaseAlgorithm& algorithm, std::size_t frame) {
  return {static_cast<float>(algorithm.sine[frame]),
          static_cast<float>(algorithm.cosine[frame]),
          static_cast<float>(algorithm.mean[frame])};
}

// Several small loops with data in the first-level cache: a single large loop does not vectorize.

/// Initializes the sums with three frames.
template <typename T>
FRANGIA_VECTORIZED void set_three(std::array<const T*, 3> frames,
                                  std::size_t n,
                                  std::array<SineCosineMean, 3> w,
                                  WrapTile& __restrict tile) {
  const T* __restrict a = frames[0];
  const T* __restrict b = frames[1];
  const T* __restrict c = frames[2];
  for (std::size_t i = 0; i < n; ++i) {
    const auto one = static_cast<float>(a[i]);
    const auto two = static_cast<float>(b[i]);
    const auto three = static_cast<float>(c[i]);
    tile.sine[i] = w[0].sine * one + w[1].sine * two + w[2].sine * three;
    tile.cosine[i] = w[0].cosine * one + w[1].cosine * two + w[2].cosine * three;
    tile.mean[i] = w[0].mean * one + w[1].mean * two + w[2].mean * three;
  }
}

/// Initializes the sums with four frames in one pass, so that no sum is stored and reloaded.
template <typename T>
FRANGIA_VECTORIZED void set_four(std::array<const T*, 4> frames,
                                 std::size_t n,
                                 std::array<SineCosineMean, 4> w,
                                 WrapTile& __restrict tile) {
  const T* __restrict a = frames[0];
  const T* __restrict b = frames[1];
  const T* __restrict c = frames[2];
  const T* __restrict d = frames[3];
  for (std::size_t i = 0; i < n; ++i) {
    const auto one = static_cast<float>(a[i]);
    const auto two = static_cast<float>(b[i]);
    const auto three = static_cast<float>(c[i]);
    const auto four = static_cast<float>(d[i]);
    tile.sine[i] = (w[0].sine * one + w[1].sine * two) + (w[2].sine * three + w[3].sine * four);
    tile.cosine[i] =
        (w[0].cosine * one + w[1].cosine * two) + (w[2].cosine * three + w[3].cosine * four);
    tile.mean[i] = (w[0].mean * one + w[1].mean * two) + (w[2].mean * three + w[3].mean * four);
  }
}

/// Maximum over the frames in their own integer type, which gives the widest vectors.
template <typename T>
FRANGIA_VECTORIZED void raise_brightest(const T* __restrict a,
                                        std::size_t n,
                                        std::uint16_t* __restrict brightest) {
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint16_t counts = a[i];
    brightest[i] = counts > brightest[i] ? counts : brightest[i];
  }
}

/// Adds two more frames to the sums.
template <typename T>
FRANGIA_VECTORIZED void add_frames(const T* __restrict a,
                                   const T* __restrict b,
                                   std::size_t n,
                                   std::array<SineCosineMean, 2> w,
                                   WrapTile& __restrict tile) {
  for (std::size_t i = 0; i < n; ++i) {
    const auto one = static_cast<float>(a[i]);
    const auto two = static_cast<float>(b[i]);
    tile.sine[i] += w[0].sine * one + w[1].sine * two;
    tile.cosine[i] += w[0].cosine * one + w[1].cosine * two;
    tile.mean[i] += w[0].mean * one + w[1].mean * two;
  }
}

template <typename T>
FRANGIA_VECTORIZED void add_outer(const T* counts, std::size_t n, float weight, WrapTile& tile) {
  for (std::size_t i = 0; i < n; ++i)
    tile.outer[i] += weight * static_cast<float>(counts[i]);
}

/// Computes Carré's sine from its two differences and rotates both sums by the phase offset, given
/// as `c` and `s`.
FRANGIA_VECTORIZED void finish_carre(std::size_t n, float c, float s, WrapTile& tile) {
  for (std::size_t i = 0; i < n; ++i) {
    const float u = tile.sine[i];
    const float square = (3.0F * u - tile.outer[i]) * (u + tile.outer[i]);
    const float size = std::sqrt(square > 0.0F ? square : 0.0F);
    const float sine = u < 0.0F ? -size : size;
    tile.sine[i] = sine * c - tile.cosine[i] * s;
    tile.cosine[i] = tile.cosine[i] * c + sine * s;
  }
}

void add_carre(const FrameStack& stack,
               const PhaseAlgorithm& algorithm,
               std::size_t at,
               std::size_t n,
               WrapTile& tile) {
  tile.outer.fill(0.0F);
  for (std::size_t k = 0; k < stack.frames.size(); ++k) {
    const auto weight = static_cast<float>(algorithm.outer[k]);
    std::visit([&](const auto& image) { add_outer(image.pixels().data() + at, n, weight, tile); },
               stack.frames[k]);
  }
  finish_carre(n,
               static_cast<float>(std::cos(algorithm.phase_offset_rad)),
               static_cast<float>(std::sin(algorithm.phase_offset_rad)),
               tile);
}

/// Sums frames of one depth.
template <typename T>
void sum_all(const FrameStack& stack,
             const PhaseAlgorithm& algorithm,
             std::size_t at,
             std::size_t n,
             WrapTile& tile,
             std::uint16_t* brightest) {
  const auto pixels = [&](std::size_t k) {
    return std::get<Image<T>>(stack.frames[k]).pixels().data() + at;
  };
  const auto weights = [&](std::size_t k) { return weights_of(algorithm, k); };
  const std::size_t count = stack.frames.size();
  const std::size_t first = count == 3 ? 3 : 4;
  if (count == 3) {
    set_three<T>({pixels(0), pixels(1), pixels(2)}, n, {weights(0), weights(1), weights(2)}, tile);
  } else {
    const std::array<SineCosineMean, 4> four = {weights(0), weights(1), weights(2), weights(3)};
    const std::array<const T*, 4> frames = {pixels(0), pixels(1), pixels(2), pixels(3)};
    set_four<T>(frames, n, four, tile);
  }
  for (std::size_t k = 0; k < count; ++k)
    raise_brightest<T>(pixels(k), n, brightest);
  for (std::size_t k = first; k < count; k += 2) {
    const bool pair =
        k + 1 < count;  // the last frame of an odd number is paired with itself at weight zero
    add_frames<T>(pixels(k),
                  pixels(pair ? k + 1 : k),
                  n,
                  {weights(k), pair ? weights(k + 1) : SineCosineMean{}},
                  tile);
  }
}

}  // namespace

void sum_frames(const FrameStack& stack,
                const PhaseAlgorithm& algorithm,
                std::size_t at,
                std::size_t n,
                WrapTile& tile,
                std::uint16_t* brightest) {
  if (std::holds_alternative<Image<std::uint8_t>>(stack.frames.front())) {
    sum_all<std::uint8_t>(stack, algorithm, at, n, tile, brightest);
  } else {
    sum_all<std::uint16_t>(stack, algorithm, at, n, tile, brightest);
  }
  if (!algorithm.outer.empty()) add_carre(stack, algorithm, at, n, tile);
}

}  // namespace frangia
