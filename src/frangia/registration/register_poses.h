#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/registration/view_motions.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Start, stopping rule and overlap limit of the refinement of poses.
struct RegisterPosesOptions {
  double reach_mm = 0.0;      ///< largest distance of corresponding surfaces at the start; 0 takes
                              ///< `default_reach_mm`
  int max_iterations = 60;    ///< free poses converge more slowly than a turntable
  double tolerance = 0.1;     ///< of the last step, in standard deviations of the poses
  double min_overlap = 0.05;  ///< share of the points that match another view; fewer are chance
  /// Standard deviation of the given poses, as the way of a view's points; 0 takes the reach, and
  /// where that is not stated either, what the surfaces show of it.
  double prior_mm = 0.0;

  /// @errors   Error(Input) that names the value which is out of its range
  void check() const;
};

/// Result of the refinement of poses.
struct PosesReport {
  double rms_before_mm = 0.0;  ///< distance between surfaces of different views, along the normal
  double rms_after_mm = 0.0;   ///< the same with the final poses
  double overlap = 0.0;        ///< share of the points that lie on a surface of another view
  int iterations = 0;          ///< 0: the given poses are kept
  ViewMotions motions;         ///< of the views by what their overlap leaves open
  /// Standard deviation of the given poses: stated, assumed, or what the surfaces show of it.
  double given_sigma_mm = 0.0;

  [[nodiscard]] std::string text() const;  ///< the result as a sentence
};

/// 3 % of the size of a view's surface, the median over all views: 3 mm for views of 100 mm.
///
/// @missing  0 when no view has a surface
[[nodiscard]] double default_reach_mm(std::span<const SurfelMap> maps);

/// Refines the rigid poses of all views at once; that of the first is held. Sets the poses of
/// `views`.
///
/// @shape    `maps`: one a view, as make_surfel_maps makes them
/// @missing  views that do not overlap keep their poses, with a warning
/// @errors   Error(Input) when the numbers of maps and views differ, and as
///          `RegisterPosesOptions::check`
/// @source   projective association: Blais & Levine 1995; symmetric point-to-plane distance:
///          Rusinkiewicz 2019; solved by `minimize_robustly`
[[nodiscard]] PosesReport register_poses(ViewStore& views,
                                         std::span<const SurfelMap> maps,
                                         const CameraModel& camera,
                                         const RegisterPosesOptions& options = {},
                                         const Run& run = {});

}  // namespace frangia
