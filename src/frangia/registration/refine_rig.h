#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/angles.h"
#include "frangia/core/run.h"
#include "frangia/pattern/pattern.h"
#include "frangia/registration/register_views.h"
#include "frangia/rig/rig.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// One parameter of a rig after the refinement.
struct RefinedParameter {
  std::string name;          ///< as in the covariance of the calibration
  double change = 0.0;       ///< from the given rig
  double prior_sigma = 0.0;  ///< of calibration and drift together
  double sigma = 0.0;        ///< after the refinement
  bool determined = false;   ///< `sigma` is less than a third of `prior_sigma`
};

/// A refined rig and how well the surfaces determine it.
struct RigRefinement {
  Rig rig;  ///< with axis and covariance; the given one, at most scaled, when `kept_rig`
  bool kept_rig = false;                     ///< the given rig fits as well
  std::vector<RefinedParameter> parameters;  ///< all that were free to change
  std::size_t directions = 0;                ///< independent changes of the parameters
  std::size_t held = 0;                      ///< of them, those that the surfaces do not determine
  /// Those that may have changed by more than twice what their standard deviations allow, by which
  /// the surfaces are better explained.
  std::vector<std::string> beyond_prior;
  double rms_before_mm = 0.0;  ///< of the distances between views, axis and angles refined alone
  double rms_after_mm = 0.0;   ///< the same with the refined rig
  std::vector<double> angles_rad;  ///< of each station, refined
  double axis_moved_mm = 0.0;      ///< distance of the refined axis from the given one
  double scale = 1.0;              ///< by which a known length changed all lengths of the rig

  /// The findings in words: clauses separated by semicolons.
  [[nodiscard]] std::string text() const;
};

/// How far a rig may drift after its calibration, as standard deviations, and limits.
///
/// The covariance of `[calibration]` is added to that of the drift.
struct RefineRigOptions {
  /// Of the projector about each axis through its center: a bracket that bends by 0.2 mm over
  /// 100 mm, when it warms up or is knocked.
  double rotation_sigma_rad = rad_from_deg(0.1);
  double relative_position_sigma = 0.001;   ///< of the projector along each axis, as a share of the
                                            ///< working distance: 0.5 mm at 500 mm
  double relative_focal_sigma = 3e-4;       ///< of both focal lengths: lenses of glass in aluminium
                                            ///< change by some 1e-5 a kelvin, over 30 kelvin
  double relative_principal_sigma = 5e-4;   ///< of both principal points, as a share of the width:
                                            ///< chips shift in their sockets by some micrometres
  double relative_distortion_sigma = 1e-4;  ///< of what k1 of both lenses displaces the ends of a
                                            ///< row by, as a share of the width: 0.2 px of 2000
  RegisterOptions table;                    ///< prior of axis and angles, reach and iterations
  int max_rounds = 6;                       ///< each triangulates all points again
  double min_gain = 1.0;  ///< information of the surfaces in units of the prior's, below which a
                          ///< direction of the parameters is held
  /// Known distance of the centers of the two balls of a ball bar in the scan: it fixes the scale.
  std::optional<double> ball_distance_mm{};
  double relative_length_sigma = 1e-4;  ///< of that distance: 7 um of 70 mm
  double max_scale_error = 0.05;        ///< beyond it the balls are not those of the known distance
  double as_good_as_given = 1.02;       ///< the given rig stays unless it fits worse by this factor

  /// @errors   Error(Input) that names the value which is out of its range
  void check() const;
};

/// The surfaces that the views of a scan measured with fringes of one direction.
struct RigSurfaces {
  const ViewStore& views;             ///< points that the given rig triangulated
  Pattern pattern;                    ///< any fringe pattern in the direction of the fringes
  std::vector<std::size_t> stations;  ///< of each view: the index of its station
};

/// Refines the pose of the projector, the focal lengths and principal points of projector and
/// camera and the first term of their distortion, the axis of the turntable and the angles of the
/// stations, all at once, so that the surfaces agree that different views and both directions of
/// fringes measured.
///
/// Every point stays on its camera pixel and its absolute phase and is triangulated by the trial
/// rig. A direction of the parameters that the surfaces do not determine is held. The scale is one
/// of them: no surface determines it. Where the surfaces are better explained by a lens or a
/// pose that is farther off than its standard deviations allow, these are widened.
///
/// @shape    the views of all `surfaces` are those of `stations`; stations of different setups are
///           not compared
/// @units    mm, rad
/// @errors   Error(Input) when no two views can be compared: a rig without a turntable needs both
///           directions of fringes; when `ball_distance_mm` is given and the scan holds no ball bar
///           of about that distance; and as `RefineRigOptions::check`
/// @source   point-to-plane bundle adjustment by `minimize_robustly` with Gaussian priors
[[nodiscard]] RigRefinement refine_rig(const Rig& rig,
                                       std::span<const RigSurfaces> surfaces,
                                       std::span<const Station> stations,
                                       const RefineRigOptions& options = {},
                                       const Run& run = {});

}  // namespace frangia
