#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/chunked_vector.h"
#include "frangia/fusion/internal/cell_loops.h"
#include "frangia/fusion/view_weights.h"

namespace frangia {

/// Sums over the views of the position and slope of the surface at one crossing.
///
/// @units    mm, object frame; weights 1/mm^2
struct HermiteAccumulator {
  /// One face near the crossing: the sums over the views whose normals agree.
  struct PlaneSum {
    float weight;          ///< sum of w
    float weight_squared;  ///< sum of w^2
    float offset;  ///< sum of w d; d is the distance of the crossing in front of the surface
    float offset_squared;    ///< sum of w d^2
    float noise;             ///< sum of w v; v is the variance of d from noise
    float noise_squared;     ///< sum of w^2 v
    float lateral_squared;   ///< sum of w^2 l; l is the variance of d from lateral pixel error
    float spacing;           ///< sum of w s; s is the spacing of pixels on the surface
    Eigen::Vector3f normal;  ///< sum of w n
    std::uint16_t views;

    [[nodiscard]] float distance_mm() const { return offset / weight; }
  };

  PlaneSum first;
  float free_space_weight;  ///< sum of 1/sigma^2 over the views that observe free space
  float common_variance;    ///< variance common to neighbouring crossings
  std::uint32_t second;     ///< number of the second face + 1; 0 without one
};

/// One accumulator for each crossing; the few crossings near edges have a second face.
class HermiteAccumulators {
 public:
  /// Crossings whose second faces share a vector: only one thread at a time may add to it.
  static constexpr std::size_t kChunk = 4096;

  /// The systematic parts of one face near a crossing.
  struct SystematicSum {
    float common = 0.0F;             ///< sum of w s; s is the part of d that all views share
    float differing_squared = 0.0F;  ///< sum of w^2 v; v is the variance that differs by view
  };
  /// Those of both faces.
  struct SystematicSums {
    SystematicSum first;
    SystematicSum second;
  };

  /// Creates empty accumulators; `with_systematic` adds the sums of systematic parts.
  explicit HermiteAccumulators(std::size_t count, bool with_systematic = false);

  /// Keeps the weight of each view from now on: at all crossings, or, where there are many, at an
  /// even choice of at most 100 000, because the weights vary slowly over the surface.
  void keep_weights();
  /// Notes the weight of a view at the first or the second face near a crossing.
  void note_weight(std::size_t i, bool first, std::size_t view, float weight);
  /// The weights of the views at the faces with the larger weight, which support a surface; none
  /// where they were not kept.
  [[nodiscard]] ViewWeights view_weights(const EdgeCrossings& crossings) const;

  /// Whether systematic parts are summed.
  [[nodiscard]] bool has_systematic() const { return systematic_.size() > 0; }
  [[nodiscard]] SystematicSums& systematic_sums(std::size_t i) { return systematic_[i]; }
  /// The systematic part of the face with the larger weight. What the views share is their weighted
  /// mean, which their number does not reduce. What differs by view falls with their number, and
  /// counts as far as it exceeds the variance that was found between the views at this place.
  [[nodiscard]] float systematic_mm(std::size_t i) const;

  [[nodiscard]] std::size_t size() const { return all_.size(); }
  [[nodiscard]] HermiteAccumulator& operator[](std::size_t i) { return all_[i]; }
  [[nodiscard]] const HermiteAccumulator& operator[](std::size_t i) const { return all_[i]; }

  /// Returns the second face; an empty sum without one.
  [[nodiscard]] const HermiteAccumulator::PlaneSum& secondary(std::size_t i) const {
    const std::uint32_t second = all_[i].second;
    return second == 0 ? kNoPlane : secondary_[i / kChunk][second - 1];
  }
  /// Returns the second face and adds it when there is none. The next addition invalidates the
  /// reference.
  [[nodiscard]] HermiteAccumulator::PlaneSum& make_secondary(std::size_t i);

  /// Returns the face with the larger weight.
  [[nodiscard]] const HermiteAccumulator::PlaneSum& dominant(std::size_t i) const {
    return all_[i].first.weight < secondary(i).weight ? secondary(i) : all_[i].first;
  }
  /// Returns the face with the smaller weight.
  [[nodiscard]] const HermiteAccumulator::PlaneSum& lesser(std::size_t i) const {
    return all_[i].first.weight < secondary(i).weight ? all_[i].first : secondary(i);
  }
  /// The variance that differs by view at the face with the larger weight, for one observation: the
  /// weighted mean over the views.
  [[nodiscard]] float differing_variance(std::size_t i) const;
  /// Multiplies the variance that differs by view: local fits smooth a part of it away.
  void scale_differing(float factor) { differing_factor_ = factor; }

  /// Whether more weight supports a surface at the crossing than free space.
  [[nodiscard]] bool is_supported(std::size_t i) const {
    return all_[i].first.weight + secondary(i).weight > all_[i].free_space_weight;
  }

 private:
  [[nodiscard]] const SystematicSum& dominant_systematic(std::size_t i) const {
    return &dominant(i) == &all_[i].first ? systematic_[i].first : systematic_[i].second;
  }

  static const HermiteAccumulator::PlaneSum kNoPlane;

  ChunkedVector<HermiteAccumulator> all_;
  ChunkedVector<SystematicSums> systematic_;  ///< empty unless asked for
  float differing_factor_ = 1.0F;
  /// The weight of a view at a face near a crossing.
  struct NotedWeight {
    std::uint32_t crossing;
    std::uint16_t view;
    bool first;
    float weight;
  };
  std::vector<std::vector<NotedWeight>> noted_;  ///< one vector for each `kChunk`; empty: not kept
  std::size_t noted_stride_ = 1;                 ///< every how many crossings weights are kept
  std::vector<std::vector<HermiteAccumulator::PlaneSum>>
      secondary_;  ///< one vector for each `kChunk` crossings
};

/// Correlation of the errors at two points of one view: linear interpolation spreads a pixel's
/// error over a triangle, whose autocorrelation is the cubic B-spline. It is 0 from twice
/// `half_width_mm`.
[[nodiscard]] float correlation(float distance_mm, float half_width_mm);

/// Sets the common variance of each crossing to the variance between the views in excess of their
/// noise, estimated over the blocks around it: a systematic error of a view over a region does not
/// average out within it. The variance from lateral pixel error is the lower bound. Where a step or
/// the edge of a shadow lets the views see different surfaces, they disagree far more than in the
/// rest of the block: such outliers count only in cells of two voxels that touch theirs.
///
/// Where systematic parts that differ by view are known, their variance is scaled to what was found
/// between the views, over all blocks: the local fits have smoothed the rest away.
///
/// @source   random effects, DerSimonian & Laird 1986
void add_between_view_variance(HermiteAccumulators& hermite, const EdgeCrossings& crossings);

/// Position and normal of the surface at one crossing, from the face with the largest weight.
///
/// @units    mm, object frame
struct HermiteSample {
  Eigen::Vector3f point;   ///< on the surface, nearest to the crossing
  Eigen::Vector3f normal;  ///< unit
  float noise_mm;          ///< standard deviation from independent noise
  float spacing_mm;        ///< of pixels on the surface
  float common_variance;   ///< variance common to neighbouring crossings
  std::uint16_t views;
  bool supported;   ///< see `HermiteAccumulators::is_supported`; otherwise the rest is undefined
  bool has_lesser;  ///< a second face near the crossing has enough weight to count
};

using HermiteSamples = ChunkedVector<HermiteSample>;

/// Returns one sample for each crossing.
[[nodiscard]] HermiteSamples make_hermite_samples(const EdgeCrossings& crossings,
                                                  const HermiteAccumulators& hermite,
                                                  const HermiteParameters& parameters = {});

/// Returns the sample of the second face near a crossing, the one with less weight.
[[nodiscard]] HermiteSample lesser_sample(const EdgeCrossings& crossings,
                                          const HermiteAccumulators& hermite,
                                          std::size_t crossing);

}  // namespace frangia
