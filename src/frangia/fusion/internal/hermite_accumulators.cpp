#include "frangia/fusion/internal/hermite_accumulators.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/parallel.h"

namespace frangia {

const HermiteAccumulator::PlaneSum HermiteAccumulators::kNoPlane{
    0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, Eigen::Vector3f::Zero(), 0};

HermiteAccumulators::HermiteAccumulators(std::size_t count, bool with_systematic)
    : all_(count),
      systematic_(with_systematic ? count : 0),
      secondary_((count + kChunk - 1) / kChunk) {
  parallel_chunks(count, 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      all_[i] = {kNoPlane, 0.0F, 0.0F, 0};
    if (!with_systematic) return;
    for (std::size_t i = begin; i < end; ++i)
      systematic_[i] = {};
  });
}

HermiteAccumulator::PlaneSum& HermiteAccumulators::make_secondary(std::size_t i) {
  auto& chunk = secondary_[i / kChunk];
  std::uint32_t& second = all_[i].second;
  if (second == 0) {
    chunk.push_back(kNoPlane);
    second = static_cast<std::uint32_t>(chunk.size());
  }
  return chunk[second - 1];
}

float HermiteAccumulators::systematic_mm(std::size_t i) const {
  const HermiteAccumulator::PlaneSum& face = dominant(i);
  const SystematicSum& sum = dominant_systematic(i);
  const float common = sum.common / face.weight;
  const float squared_weight = face.weight * face.weight;
  const float differing =
      (face.lateral_squared + differing_factor_ * sum.differing_squared) / squared_weight;
  return std::sqrt(common * common + std::max(0.0F, differing - all_[i].common_variance));
}

float HermiteAccumulators::differing_variance(std::size_t i) const {
  return has_systematic() ? dominant_systematic(i).differing_squared / dominant(i).weight_squared
                          : 0.0F;
}

float correlation(float distance_mm, float half_width_mm) {
  const float x = distance_mm / half_width_mm;
  if (x >= 2.0F) return 0.0F;
  if (x >= 1.0F) return 0.25F * (2.0F - x) * (2.0F - x) * (2.0F - x);
  return 1.0F - 1.5F * x * x + 0.75F * x * x * x;
}

void add_between_view_variance(HermiteAccumulators& hermite, const EdgeCrossings& crossings) {
  struct Share {
    float found = 0.0F;  // of the stated variance that differs by view, times the weight
    float weight = 0.0F;
  };
  std::vector<Share> shares(hermite.has_systematic() ? crossings.blocks.size() : 0);
  parallel_chunks(crossings.blocks.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const std::size_t first = crossings.first_of(block);
      const std::size_t last = crossings.first_of(block + 1);
      float excess = 0.0F;  // scatter between the views in excess of their noise
      float degrees_of_freedom = 0.0F;
      float stated = 0.0F;  // variance that differs by view
      for (std::size_t i = first; i < last; ++i) {
        const HermiteAccumulator::PlaneSum& face = hermite.dominant(i);
        if (face.views < 2) continue;
        const float scatter = face.offset_squared - face.offset * face.offset / face.weight;
        const float expected = face.noise - face.noise_squared / face.weight;
        excess += (scatter - expected) / face.weight;
        const float freedom = 1.0F - face.weight_squared / (face.weight * face.weight);
        degrees_of_freedom += freedom;
        stated += freedom * hermite.differing_variance(i);
      }
      const float between =
          excess > 0.0F && degrees_of_freedom > 0.0F ? excess / degrees_of_freedom : 0.0F;
      if (stated > 0.0F) {
        const float found = std::clamp(excess / stated, 0.0F, 1.0F);
        shares[block] = {found * degrees_of_freedom, degrees_of_freedom};
      }
      for (std::size_t i = first; i < last; ++i) {
        const HermiteAccumulator::PlaneSum& face = hermite.dominant(i);
        if (face.views == 0) continue;
        hermite[i].common_variance = std::max(between * face.weight_squared, face.lateral_squared) /
                                     (face.weight * face.weight);
      }
    }
  });
  Share all;
  for (const Share& share : shares) {
    all.found += share.found;
    all.weight += share.weight;
  }
  if (all.weight > 0.0F) hermite.scale_differing(all.found / all.weight);
}

}  // namespace frangia
