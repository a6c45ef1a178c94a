#include "frangia/fusion/internal/hermite_accumulators.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

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

void HermiteAccumulators::keep_weights() {
  constexpr std::size_t kMost = 100'000;  // crossings
  noted_.resize(secondary_.size());
  noted_stride_ = all_.size() / kMost + 1;
}

void HermiteAccumulators::note_weight(std::size_t i, bool first, std::size_t view, float weight) {
  if (noted_.empty() || i % noted_stride_ != 0) return;
  noted_[i / kChunk].push_back(
      {static_cast<std::uint32_t>(i), static_cast<std::uint16_t>(view), first, weight});
}

ViewWeights HermiteAccumulators::view_weights(const EdgeCrossings& crossings) const {
  std::vector<ViewWeights::Place> places;
  std::vector<ViewWeights::View> views;
  for (const auto& chunk : noted_) {
    std::vector<NotedWeight> sorted = chunk;
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
      return a.crossing < b.crossing;
    });
    std::size_t last = all_.size();
    for (const NotedWeight& noted : sorted) {
      const std::size_t i = noted.crossing;
      const HermiteAccumulator::PlaneSum& face = dominant(i);
      if (noted.first != (&face == &all_[i].first) || !is_supported(i)) continue;
      if (i != last) {
        const Eigen::Vector3f normal = face.normal.normalized();
        places.push_back({crossings.points_mm[i] - face.distance_mm() * normal,
                          normal,
                          static_cast<std::uint32_t>(views.size())});
      }
      views.emplace_back(noted.view, noted.weight);
      last = i;
    }
  }
  const double spacing_mm = crossings.voxel_mm * std::sqrt(static_cast<double>(noted_stride_));
  return {spacing_mm, places, std::move(views)};
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

namespace {

/// Variance between the views in excess of their noise, pooled over several crossings.
struct PooledScatter {
  float excess = 0.0F;
  float degrees_of_freedom = 0.0F;

  void add(const PooledScatter& more, float weight = 1.0F) {
    excess += weight * more.excess;
    degrees_of_freedom += weight * more.degrees_of_freedom;
  }
  [[nodiscard]] float variance() const {
    return excess > 0.0F && degrees_of_freedom > 0.0F ? excess / degrees_of_freedom : 0.0F;
  }
};

constexpr int kCells = 4;  // along a block: cells of two voxels
static_assert(kCells * 2 == kBlockEdge && kCells * kCells * kCells == 64);

/// Scatter between the views over a block.
struct BlockScatter {
  PooledScatter all;
  /// Without outliers: at the edge of a step or of a shadow the views see different surfaces, so
  /// that their scatter there does not hold for the adjacent faces.
  PooledScatter inliers;
  std::uint64_t outlying = 0;  ///< cells that hold outliers, a bit each, x lowest
  float stated = 0.0F;         ///< variance that differs by view
};

/// The cell that holds a point, counted from the lowest cell of a block.
Eigen::Array3i cell_from(const Eigen::Vector3f& point_mm,
                         const Eigen::Vector3i& block,
                         float per_cell) {
  const Eigen::Array3i cell = (per_cell * point_mm).array().floor().cast<int>();
  return cell - kCells * block.array();
}

std::uint64_t bit_of(const Eigen::Array3i& cell) {
  const Eigen::Array3i within = cell.max(0).min(kCells - 1);
  return std::uint64_t{1} << (within.x() + kCells * (within.y() + kCells * within.z()));
}

/// Scatter of a crossing that two or more views measured.
struct CrossingScatter {
  std::size_t crossing;
  float scatter;
  float noise;  ///< that is expected
  float freedom;
};

/// The scatter per degree of freedom beyond which a crossing is an outlier; infinite where too few
/// crossings determine the median. The median of the squares of normal errors is 0.45 of their
/// variance or more: 4.5 standard deviations, which occur once in 150 000.
float outlier_limit(const std::vector<CrossingScatter>& seen) {
  constexpr std::size_t kFewest = 20;
  constexpr float kOfMedian = 45.0F;
  std::vector<float> per_freedom;
  for (const CrossingScatter& one : seen) {
    if (one.freedom > 0.0F) per_freedom.push_back(one.scatter / one.freedom);
  }
  if (per_freedom.size() < kFewest) return std::numeric_limits<float>::infinity();
  const auto middle = per_freedom.begin() + static_cast<std::ptrdiff_t>(per_freedom.size() / 2);
  std::nth_element(per_freedom.begin(), middle, per_freedom.end());
  return kOfMedian * *middle;
}

BlockScatter scatter_in(const HermiteAccumulators& hermite,
                        const EdgeCrossings& crossings,
                        std::size_t block) {
  constexpr float kOfNoise = 20.0F;  // 4.5 standard deviations of what the views state
  BlockScatter out;
  std::vector<CrossingScatter> seen;
  for (std::size_t i = crossings.first_of(block); i < crossings.first_of(block + 1); ++i) {
    const HermiteAccumulator::PlaneSum& face = hermite.dominant(i);
    if (face.views < 2) continue;
    const float scatter = face.offset_squared - face.offset * face.offset / face.weight;
    const float expected = face.noise - face.noise_squared / face.weight;
    const float freedom = 1.0F - face.weight_squared / (face.weight * face.weight);
    seen.push_back({i, scatter / face.weight, expected / face.weight, freedom});
    out.stated += freedom * hermite.differing_variance(i);
  }
  const float most = outlier_limit(seen);
  const auto per_cell = static_cast<float>(0.5 / crossings.voxel_mm);
  for (const CrossingScatter& one : seen) {
    const PooledScatter scatter{one.scatter - one.noise, one.freedom};
    out.all.add(scatter);
    if (one.scatter > one.freedom * most && one.scatter > kOfNoise * one.noise)
      out.outlying |= bit_of(
          cell_from(crossings.points_mm[one.crossing], crossings.block_coords[block], per_cell));
    else
      out.inliers.add(scatter);
  }
  return out;
}

/// The variance between the views around a place: the scatter of the blocks around it, weighted
/// linearly by the distances of their centres, so that it has no step from block to block. Outliers
/// count only in the cells that touch theirs.
class ScatterAround {
 public:
  ScatterAround(const EdgeCrossings& crossings,
                const std::vector<BlockScatter>& scatters,
                std::size_t block)
      : corner_(crossings.block_coords[block]),
        per_block_(1.0F / (static_cast<float>(crossings.voxel_mm) * kBlockEdge)) {
    std::size_t next = 0;
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          const std::uint32_t found =
              crossings.index.find(block_key(corner_ + Eigen::Vector3i(x, y, z)));
          if (found != BlockIndex::kNone) near_.at(next) = scatters[found];
          any_ = any_ || near_.at(next).outlying != 0;
          ++next;
        }
      }
    }
  }

  [[nodiscard]] float variance_at(const Eigen::Vector3f& point_mm) const {
    // From the block's centre: -0.5 to 0.5.
    const Eigen::Array3f from = (per_block_ * point_mm - corner_.cast<float>()).array() - 0.5F;
    const Eigen::Array3f far = from.abs().min(0.5F);
    const bool beside = any_ && is_beside_outliers(point_mm);
    PooledScatter pooled;
    for (int corner = 0; corner < 8; ++corner) {
      float weight = 1.0F;
      int index = 0;
      for (int axis = 2; axis >= 0; --axis) {
        const bool neighbor = ((corner >> axis) & 1) != 0;
        weight *= neighbor ? far(axis) : 1.0F - far(axis);
        index = 3 * index + 1 + (neighbor ? (from(axis) < 0.0F ? -1 : 1) : 0);
      }
      const BlockScatter& scatter = near_.at(static_cast<std::size_t>(index));
      pooled.add(beside ? scatter.all : scatter.inliers, weight);
    }
    return pooled.variance();
  }

 private:
  /// Whether the cell of a point, or one that touches it, holds outliers.
  [[nodiscard]] bool is_beside_outliers(const Eigen::Vector3f& point_mm) const {
    const Eigen::Array3i cell =
        cell_from(point_mm, corner_, per_block_ * kCells).max(0).min(kCells - 1);
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const Eigen::Array3i other = cell + Eigen::Array3i(dx, dy, dz) + kCells;
          const Eigen::Array3i block = other / kCells;
          const int index = block.x() + 3 * (block.y() + 3 * block.z());
          const std::uint64_t bit = bit_of(other - kCells * block);
          if ((near_.at(static_cast<std::size_t>(index)).outlying & bit) != 0) return true;
        }
      }
    }
    return false;
  }

  Eigen::Vector3i corner_;
  float per_block_;
  std::array<BlockScatter, 27> near_;  ///< x runs fastest
  bool any_ = false;                   ///< whether one of them holds outliers
};

}  // namespace

void add_between_view_variance(HermiteAccumulators& hermite, const EdgeCrossings& crossings) {
  std::vector<BlockScatter> scatters(crossings.blocks.size());
  parallel_chunks(scatters.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      scatters[block] = scatter_in(hermite, crossings, block);
    }
  });
  parallel_chunks(scatters.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const ScatterAround around(crossings, scatters, block);
      for (std::size_t i = crossings.first_of(block); i < crossings.first_of(block + 1); ++i) {
        const HermiteAccumulator::PlaneSum& face = hermite.dominant(i);
        if (face.views == 0) continue;
        const float between = around.variance_at(crossings.points_mm[i]);
        hermite[i].common_variance = std::max(between * face.weight_squared, face.lateral_squared) /
                                     (face.weight * face.weight);
      }
    }
  });
  if (!hermite.has_systematic()) return;
  float found = 0.0F;  // of the stated variance that differs by view, times the weight
  float weight = 0.0F;
  for (const BlockScatter& block : scatters) {
    if (!(block.stated > 0.0F)) continue;
    const float freedom = block.all.degrees_of_freedom;
    found += std::clamp(block.all.excess / block.stated, 0.0F, 1.0F) * freedom;
    weight += freedom;
  }
  if (weight > 0.0F) hermite.scale_differing(found / weight);
}

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
