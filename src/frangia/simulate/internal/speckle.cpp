#include "frangia/simulate/internal/speckle.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "frangia/core/parallel.h"
#include "frangia/core/random.h"

namespace frangia {
namespace {

using NormalField = Image<std::complex<float>>;

/// Weights of a Gaussian whose squares add up to 1: they keep a field's variance.
std::vector<float> smoothing_weights(double sigma_px) {
  const int reach = static_cast<int>(std::ceil(3.0 * sigma_px));
  std::vector<float> weights;
  double sum2 = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    const double weight = sigma_px > 0.0 ? std::exp(-0.5 * i * i / (sigma_px * sigma_px)) : 1.0;
    weights.push_back(static_cast<float>(weight));
    sum2 += weight * weight;
  }
  for (float& weight : weights)
    weight /= static_cast<float>(std::sqrt(sum2));
  return weights;
}

/// A smooth random field of mean 0 and mean square 1.
NormalField random_field(int width,
                         int height,
                         std::uint64_t stream,
                         const std::vector<float>& weights) {
  const int margin = static_cast<int>(weights.size()) - 1;
  NormalField across(width, height + margin);
  parallel_rows(across.height(), [&](int y) {
    std::vector<std::complex<float>> rough(static_cast<std::size_t>(width + margin));
    for (std::size_t x = 0; x < rough.size(); ++x) {
      const std::uint64_t seed = hash(hash(stream, static_cast<std::uint64_t>(y)), x);
      rough[x] = {static_cast<float>(normal_from(hash(seed, 1)) * std::sqrt(0.5)),
                  static_cast<float>(normal_from(hash(seed, 2)) * std::sqrt(0.5))};
    }
    for (int x = 0; x < width; ++x) {
      std::complex<float> sum = 0.0F;
      for (std::size_t i = 0; i < weights.size(); ++i)
        sum += weights[i] * rough[static_cast<std::size_t>(x) + i];
      across(x, y) = sum;
    }
  });
  NormalField field(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      std::complex<float> sum = 0.0F;
      for (std::size_t i = 0; i < weights.size(); ++i)
        sum += weights[i] * across(x, y + static_cast<int>(i));
      field(x, y) = sum;
    }
  });
  return field;
}

}  // namespace

Image<Speckle> speckle_of(int width,
                          int height,
                          std::uint64_t stream,
                          const SpeckleOptions& options) {
  // A field smoothed with sigma has an intensity whose correlation has the same sigma.
  const std::vector<float> weights = smoothing_weights(options.grain_px / 2.3548);
  const NormalField first = random_field(width, height, hash(stream, 1), weights);
  const NormalField other = random_field(width, height, hash(stream, 2), weights);
  const auto share = static_cast<float>(options.contrast);
  const auto mu = static_cast<float>(options.correlation);
  Image<Speckle> speckle(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::complex<float> a = first(x, y);
      const std::complex<float> b = mu * a + std::sqrt(1.0F - mu * mu) * other(x, y);
      Speckle& here = speckle(x, y);
      here.gain = 1.0F - share + share * 0.5F * (std::norm(a) + std::norm(b));
      here.fringe = (1.0F - share + share * b * std::conj(a)) / std::max(here.gain, 1e-9F);
    }
  });
  return speckle;
}

}  // namespace frangia
