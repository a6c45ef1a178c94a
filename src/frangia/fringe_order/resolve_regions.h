#pragma once

#include <cstdint>
#include <vector>

#include "frangia/phase/wrap/phase_map.h"
#include "frangia/range/laser_profile.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// A region of unknown fringe order: its pixels and their relative phases.
struct UnresolvedRegion {
  std::vector<std::uint32_t> pixel;   ///< y * width + x
  std::vector<float> phase_rad;       ///< relative phase, one for each pixel
  std::vector<float> sigma_rad;       ///< standard deviation of `phase_rad`
  std::vector<float> systematic_rad;  ///< systematic part, one for each pixel; empty: none known
};

/// Criteria for the fringe order that the laser sheet gives a region.
struct FringeOrderOptions {
  double min_agreement = 0.7;  ///< minimum share of these points that vote for the same order
};

/// The absolute phase and the regions whose fringe order remains unknown.
struct ResolvedPhase {
  AbsolutePhase phase;  ///< pixels of unresolved regions are NaN and marked Unresolved
  std::vector<UnresolvedRegion> unresolved;  ///< from the largest
};

/// Determines the fringe order of each region from the object's laser profile.
///
/// @units    rad
/// @missing  a region without enough laser points, or whose points disagree, remains unresolved;
///          pixels at the border of two regions are NaN and marked MixedPixel
/// @source   the paper, section 2: one profile with a single laser sheet for each view
[[nodiscard]] ResolvedPhase resolve_by_laser_sheet(const RelativePhase& phase,
                                                   const std::vector<ProfilePoint>& profile,
                                                   const Projector& projector,
                                                   const FringeOrderOptions& options = {});

/// Gives each region the fringe order that puts it closest to the plane z = `distance_mm`, where
/// the axes of camera and projector cross. The orders are relative to the fringe through the
/// projection axis.
///
/// @units    mm, rad
/// @missing  a region outside of the projector's field remains unresolved
[[nodiscard]] ResolvedPhase resolve_by_distance(const RelativePhase& phase,
                                                const Rig& rig,
                                                const Image<Eigen::Vector2f>& rays,
                                                double distance_mm);

}  // namespace frangia
