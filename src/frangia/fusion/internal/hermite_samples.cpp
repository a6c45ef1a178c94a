#include "frangia/fusion/internal/hermite_samples.h"

#include <cmath>
#include <cstddef>

#include "frangia/core/parallel.h"

namespace frangia {
namespace {

HermiteSample sample_of(const Eigen::Vector3f& crossing_mm,
                        const HermiteAccumulator::PlaneSum& face) {
  const float per_weight = 1.0F / face.weight;
  HermiteSample sample;
  sample.normal = face.normal.normalized();
  sample.point = crossing_mm - sample.normal * (face.offset * per_weight);
  sample.noise_mm = std::sqrt(face.noise_squared) * per_weight;
  sample.spacing_mm = face.spacing * per_weight;
  sample.views = face.views;
  sample.common_variance = 0.0F;
  sample.supported = true;
  sample.has_lesser = false;
  return sample;
}

}  // namespace

HermiteSample lesser_sample(const EdgeCrossings& crossings,
                            const HermiteAccumulators& hermite,
                            std::size_t crossing) {
  return sample_of(crossings.points_mm[crossing], hermite.lesser(crossing));
}

HermiteSamples make_hermite_samples(const EdgeCrossings& crossings,
                                    const HermiteAccumulators& hermite,
                                    const HermiteParameters& parameters) {
  const auto min_share = static_cast<float>(parameters.lesser_share);
  HermiteSamples samples(hermite.size());
  parallel_chunks(hermite.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      samples[i].supported = hermite.is_supported(i);
      if (!samples[i].supported) continue;
      const HermiteAccumulator::PlaneSum& main = hermite.dominant(i);
      const HermiteAccumulator::PlaneSum& side = hermite.lesser(i);
      samples[i] = sample_of(crossings.points_mm[i], main);
      samples[i].common_variance = hermite[i].common_variance;
      samples[i].has_lesser = side.views != 0 && side.weight >= min_share * main.weight;
    }
  });
  return samples;
}

}  // namespace frangia
