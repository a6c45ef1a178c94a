#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/pattern/pattern.h"
#include "frangia/rig/rig.h"
#include "frangia/views/view.h"

namespace frangia {

/// Pixels that share one unknown whole number of fringes, and the phase they have with 0 of them.
struct FringePixels {
  std::vector<std::uint32_t> pixel;  ///< y * width + x
  std::vector<float> phase_rad;
};

/// Points of a pixel set, were it this many fringes farther on, and what other views say of them.
struct FringeOrderCandidate {
  int order = 0;
  std::vector<Eigen::Vector3f> points_mm;  ///< object frame
  double spacing_mm = 0.0;                 ///< depth from here to the next fringe
  int agree = 0;                           ///< another view measured the surface there
  int violations = 0;                      ///< another view sees through the point
  int unseen = 0;                          ///< another view measured nothing there

  [[nodiscard]] int score() const { return agree - 2 * violations; }
};

/// What turns a scan's phase into points.
struct FringeOptics {
  const Pattern& pattern;
  const Rig& rig;
  const Image<Eigen::Vector2f>& rays;  ///< of the camera's pixels
};

/// The same, and how points are compared with what other views measured.
struct FringeComparison : FringeOptics {
  double tolerance = 0.06;  ///< of the depth between two fringes: how near counts as agreeing
  int max_samples = 400;    ///< points of a pixel set that are compared
};

/// Every whole number of fringes that keeps most of the set in the lit field.
[[nodiscard]] std::vector<FringeOrderCandidate> fringe_order_candidates(
    const FringePixels& pixels,
    const Eigen::Isometry3d& rig_from_object,
    const FringeComparison& setting);

/// Adds what one view says of a candidate's points.
void compare_with(const View& view,
                  const FringeComparison& setting,
                  FringeOrderCandidate& candidate);

}  // namespace frangia
