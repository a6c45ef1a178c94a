#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/fringe_order/resolve_regions.h"
#include "frangia/pattern/pattern.h"
#include "frangia/rig/rig.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Pixels that share one unknown fringe order, and their phase at order 0.
struct FringePixels {
  std::vector<std::uint32_t> pixel;  ///< y * width + x
  std::vector<float> phase_rad;      ///< phase at fringe order 0, one for each pixel
};

/// The points of a pixel set at one candidate order, and how other views agree with them.
struct FringeOrderCandidate {
  int order = 0;                           ///< 2 pi times it is added to the phase
  std::vector<Eigen::Vector3f> points_mm;  ///< object frame
  double spacing_mm = 0.0;                 ///< depth between this order and the next
  int agree = 0;       ///< comparisons in which another view measured the surface at the point
  int violations = 0;  ///< comparisons in which the point lies in front of that surface
  int unseen = 0;      ///< comparisons in which the other view measured nothing at that pixel

  /// A free-space violation counts twice: an agreement can be a coincidence.
  [[nodiscard]] int score() const { return agree - 2 * violations; }
};

/// The inputs that convert a scan's phase into points.
struct FringeOptics {
  const Pattern& pattern;              ///< pattern of the phase
  const Rig& rig;                      ///< calibration of camera and projector
  const Image<Eigen::Vector2f>& rays;  ///< of the camera's pixels
};

/// `FringeOptics` and the options of the comparison with other views.
struct FringeComparison : FringeOptics {
  double tolerance = 0.06;  ///< distance that counts as agreement, per fringe spacing in depth
  int max_samples = 400;    ///< maximum number of compared points of a pixel set
};

/// Lists every fringe order that keeps more than half of the set in the projector's field, with the
/// points at that order.
///
/// @units    mm, object frame
[[nodiscard]] std::vector<FringeOrderCandidate> fringe_order_candidates(
    const FringePixels& pixels,
    const Eigen::Isometry3d& rig_from_object,
    const FringeComparison& comparison);

/// Compares a candidate's points with the depths of one view and adds to the candidate's counts.
///
/// A point within the tolerance of the measured surface agrees. A point more than twice the
/// tolerance in front of it violates the free space that the view observed.
void compare_with(const Image<float>& depth_mm,
                  const Eigen::Isometry3d& rig_from_object,
                  const FringeComparison& comparison,
                  FringeOrderCandidate& candidate);

/// An unresolved region and the view that it belongs to.
struct UnresolvedViewRegion {
  std::size_t view = 0;     ///< index of the view
  UnresolvedRegion region;  ///< region in that view
};

/// Numbers of points whose fringe order other views decided.
struct ResolveByViewsResult {
  std::size_t resolved_points = 0;  ///< points that received a fringe order and joined their view
  std::size_t removed_points = 0;   ///< points whose fringe order stays unknown
};

/// Determines the fringe orders of unresolved regions from the surface that other views measured.
///
/// The order wins at which other views confirm most of the region without a free-space violation.
/// A resolved region is added to its view and helps to resolve the next one. Regions that remain
/// unresolved stay missing.
[[nodiscard]] ResolveByViewsResult resolve_by_views(
    ViewStore& views,
    const std::vector<UnresolvedViewRegion>& unresolved,
    const FringeOptics& optics,
    const Run& run = {});

}  // namespace frangia
