#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/chunked_vector.h"
#include "frangia/fusion/internal/edge_crossings.h"
#include "frangia/local_fit/local_planes.h"

namespace frangia {

/// What the views say about one point of the surface.
///
/// units    mm, object frame; weights 1/mm^2
struct HermiteAccumulator {
  /// One plane near the point, from the views that agree on how it slopes.
  struct PlaneSum {
    float weight;            ///< sum of w
    float weight_squared;    ///< sum of w^2
    float offset;            ///< sum of w d, the point's distance in front
    float offset_squared;    ///< sum of w d^2
    float noise;             ///< sum of w v, v the variance of d
    float noise_squared;     ///< sum of w^2 v
    float lateral_squared;   ///< sum of w^2 l, l the variance of d by what pixels are off
    float spacing;           ///< sum of w times the distance of pixels
    Eigen::Vector3f normal;  ///< sum of w n
    std::uint16_t views;

    [[nodiscard]] float distance_mm() const { return offset / weight; }
  };

  PlaneSum first;
  float free_space_weight;  ///< sum of 1/sigma^2 over the views that see through
  float common_variance;    ///< variance that does not average away between neighbouring points
  std::uint32_t other;      ///< face, as points near an edge have: its number + 1, or 0
};

/// One for each point; few have another face.
class HermiteAccumulators {
 public:
  /// Points whose other faces are kept together: one thread at a time may make such.
  static constexpr std::size_t kChunk = 4096;

  /// Of points that no view has spoken of yet.
  explicit HermiteAccumulators(std::size_t count);

  [[nodiscard]] std::size_t size() const { return all_.size(); }
  [[nodiscard]] HermiteAccumulator& operator[](std::size_t i) { return all_[i]; }
  [[nodiscard]] const HermiteAccumulator& operator[](std::size_t i) const { return all_[i]; }

  /// The other face, one that nobody speaks for where there is none.
  [[nodiscard]] const HermiteAccumulator::PlaneSum& secondary(std::size_t i) const {
    const std::uint32_t other = all_[i].other;
    return other == 0 ? kNoPlane : secondary_[i / kChunk][other - 1];
  }
  /// The other face, made where there is none; it moves when the next is made.
  [[nodiscard]] HermiteAccumulator::PlaneSum& make_secondary(std::size_t i);

  /// The face that most weight speaks for.
  [[nodiscard]] const HermiteAccumulator::PlaneSum& dominant(std::size_t i) const {
    return all_[i].first.weight < secondary(i).weight ? secondary(i) : all_[i].first;
  }
  [[nodiscard]] const HermiteAccumulator::PlaneSum& lesser(std::size_t i) const {
    return all_[i].first.weight < secondary(i).weight ? all_[i].first : secondary(i);
  }
  [[nodiscard]] bool is_supported(std::size_t i) const {
    return all_[i].first.weight + secondary(i).weight > all_[i].free_space_weight;
  }

 private:
  static const HermiteAccumulator::PlaneSum kNoPlane;

  ChunkedVector<HermiteAccumulator> all_;
  std::vector<std::vector<HermiteAccumulator::PlaneSum>> secondary_;  ///< of `kChunk` points each
};

/// How much the mean over pixels at one point has to do with the mean at another: linear
/// interpolation spreads a pixel over a triangle, whose autocorrelation is the cubic spline.
[[nodiscard]] float correlation(float distance_mm, float spacing_mm);

struct HermiteOptions {
  double near_mm = 0.0;  ///< a view that saw the surface farther off speaks of another one
  double free_space_mm =
      0.0;  ///< a view that saw the surface farther behind looks through the point
};

/// Asks one view about every crossing. It speaks against one only with clear sight all around.
void accumulate_view(HermiteAccumulators& hermite,
                     const EdgeCrossings& crossings,
                     const LocalPlanes& view,
                     const CameraRays& camera,
                     const HermiteOptions& options);

/// Adds to the variance of each crossing what the views disagree by beyond their noise, taken
/// together over its block: an error that a view makes all over a region does not average away
/// within it. It is not less than what places in the picture are off by.
///
/// source   random effects, DerSimonian & Laird 1986
void add_between_view_variance(HermiteAccumulators& hermite, const EdgeCrossings& crossings);

}  // namespace frangia
