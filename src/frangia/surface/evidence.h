#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/surface/crossings.h"
#include "frangia/surface/local_planes.h"

namespace frangia {

/// What the views say about one point of the surface.
///
/// units    mm, object frame; weights 1/mm^2
struct Evidence {
  float weight = 0.0F;          ///< sum of w over the views that saw the surface here
  float weight_squared = 0.0F;  ///< sum of w^2
  float offset = 0.0F;  ///< sum of w d, d how far the point lies in front of the view's surface
  float offset_squared = 0.0F;  ///< sum of w d^2
  float noise = 0.0F;           ///< sum of w v, v the variance of d
  float noise_squared = 0.0F;   ///< sum of w^2 v
  float vertex_noise = 0.0F;    ///< sum of w^2 v', v' the variance left in the mean over a cell
  float against = 0.0F;         ///< sum of w over the views that see through
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< sum of w n
  std::uint16_t views = 0;

  [[nodiscard]] bool holds() const { return weight > against; }
  /// How far to move along the normal to reach the surface.
  [[nodiscard]] float shift_mm() const { return -offset / weight; }
  [[nodiscard]] float vertex_variance() const { return vertex_noise / (weight * weight); }
};

struct EvidenceOptions {
  double near_mm = 0.0;     ///< a view that saw the surface farther off speaks of another one
  double through_mm = 0.0;  ///< a view that saw the surface farther behind looks through the point
};

/// Asks one view about every crossing. It speaks against one only with clear sight all around.
void add_evidence(std::vector<Evidence>& evidence,
                  const Crossings& crossings,
                  const LocalPlanes& view,
                  const CameraRays& camera,
                  const EvidenceOptions& options);

/// Adds to the variance of each crossing what the views disagree by beyond their noise, taken
/// together over its block: an error that a view makes all over a region does not average away
/// within it.
///
/// source   random effects, DerSimonian & Laird 1986
void add_disagreement(std::vector<Evidence>& evidence, const Crossings& crossings);

}  // namespace frangia
