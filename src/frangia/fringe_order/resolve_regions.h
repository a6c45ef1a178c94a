#pragma once

#include <cstdint>
#include <vector>

#include "frangia/phase/phase_map.h"
#include "frangia/range/laser_profile.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// A region whose whole number of fringes is not known yet: its pixels and what they hold.
struct UnresolvedRegion {
  std::vector<std::uint32_t> pixel;  ///< y * width + x
  std::vector<float> phase_rad;
  std::vector<float> sigma_rad;
};

struct FringeOrderOptions {
  int min_crossings = 3;        ///< of the line with a region
  double min_agreement = 0.7;   ///< share of them that ask for the same fringe
  double max_departure = 0.25;  ///< median distance from a whole number of fringes
};

struct ResolvedPhase {
  AbsolutePhase phase;  ///< regions that the line fixed; the others are Unanchored
  std::vector<UnresolvedRegion> unresolved;  ///< those others, from the largest
};

/// Fixes the whole number of fringes of each region with the object's profile in the plane of
/// light.
///
/// missing  a region that the line does not touch, or on which its crossings disagree, is
/// unresolved source   the paper, section 2: a profile with a single plane of light for each view
[[nodiscard]] ResolvedPhase resolve_by_laser_sheet(const RelativePhase& phase,
                                                   const std::vector<ProfilePoint>& profile,
                                                   const Projector& projector,
                                                   const FringeOrderOptions& options = {});

/// Calls the largest region's fringe the one that puts it nearest to `distance_mm`, where the
/// paper's axes cross, and the other regions' likewise: relative to the fringe through the
/// projection axis.
[[nodiscard]] ResolvedPhase resolve_by_distance(const RelativePhase& phase,
                                                const Rig& rig,
                                                const Image<Eigen::Vector2f>& rays,
                                                double distance_mm);

}  // namespace frangia
