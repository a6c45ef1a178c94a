#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/pieces.h"
#include "frangia/surface/crossings.h"
#include "frangia/views/local_planes.h"

namespace frangia {

/// What the views say about one point of the surface.
///
/// units    mm, object frame; weights 1/mm^2
struct Evidence {
  /// One plane near the point, from the views that agree on how it slopes.
  struct Face {
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

  Face first;
  float against;        ///< sum of 1/sigma^2 over the views that see through
  float common;         ///< variance that does not average away between neighbouring points
  std::uint32_t other;  ///< face, as points near an edge have: its number + 1, or 0
};

/// One for each point; few have another face.
class Evidences {
 public:
  /// Points whose other faces are kept together: one thread at a time may make such.
  static constexpr std::size_t kTogether = 4096;

  /// Of points that no view has spoken of yet.
  explicit Evidences(std::size_t count);

  [[nodiscard]] std::size_t size() const { return all_.size(); }
  [[nodiscard]] Evidence& operator[](std::size_t i) { return all_[i]; }
  [[nodiscard]] const Evidence& operator[](std::size_t i) const { return all_[i]; }

  /// The other face, one that nobody speaks for where there is none.
  [[nodiscard]] const Evidence::Face& other(std::size_t i) const {
    const std::uint32_t other = all_[i].other;
    return other == 0 ? kNoFace : others_[i / kTogether][other - 1];
  }
  /// The other face, made where there is none; it moves when the next is made.
  [[nodiscard]] Evidence::Face& make_other(std::size_t i);

  /// The face that most weight speaks for.
  [[nodiscard]] const Evidence::Face& main(std::size_t i) const {
    return all_[i].first.weight < other(i).weight ? other(i) : all_[i].first;
  }
  [[nodiscard]] const Evidence::Face& side(std::size_t i) const {
    return all_[i].first.weight < other(i).weight ? all_[i].first : other(i);
  }
  [[nodiscard]] bool holds(std::size_t i) const {
    return all_[i].first.weight + other(i).weight > all_[i].against;
  }

 private:
  static const Evidence::Face kNoFace;

  Pieces<Evidence> all_;
  std::vector<std::vector<Evidence::Face>> others_;  ///< of `kTogether` points each
};

/// How much the mean over pixels at one point has to do with the mean at another: linear
/// interpolation spreads a pixel over a triangle, whose autocorrelation is the cubic spline.
[[nodiscard]] float correlation(float distance_mm, float spacing_mm);

struct EvidenceOptions {
  double near_mm = 0.0;     ///< a view that saw the surface farther off speaks of another one
  double through_mm = 0.0;  ///< a view that saw the surface farther behind looks through the point
};

/// Asks one view about every crossing. It speaks against one only with clear sight all around.
void add_evidence(Evidences& evidence,
                  const Crossings& crossings,
                  const LocalPlanes& view,
                  const CameraRays& camera,
                  const EvidenceOptions& options);

/// Adds to the variance of each crossing what the views disagree by beyond their noise, taken
/// together over its block: an error that a view makes all over a region does not average away
/// within it. It is not less than what places in the picture are off by.
///
/// source   random effects, DerSimonian & Laird 1986
void add_disagreement(Evidences& evidence, const Crossings& crossings);

}  // namespace frangia
