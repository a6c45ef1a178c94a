#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/run.h"
#include "frangia/pattern/pattern.h"
#include "frangia/registration/point_tie.h"
#include "frangia/registration/registration_report.h"
#include "frangia/rig/rig.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// What follows from views that say that the rig is not as it states.
enum class WrongRig : std::uint8_t {
  AdviseRefinement,   ///< by the surfaces of the views
  IsRefined,          ///< the caller does so
  AdviseCalibration,  ///< the rig has been refined already
};

/// Prior knowledge as standard deviations, and limits. Relative lengths are shares of the working
/// distance, the median distance of the measured points from the camera, so that a rig of any size
/// behaves alike.
///
/// Unknowns that the part's shape does not determine (the angles of a round part, for example) stay
/// where the prior puts them.
struct RegisterOptions {
  double angle_sigma_rad = rad_from_deg(0.2);  ///< of each commanded table angle
  double tilt_sigma_rad = rad_from_deg(1.0);   ///< of the given axis
  double relative_shift_sigma = 0.004;         ///< of the given axis: 2 mm at 500 mm
  double relative_reach = 0.006;      ///< largest distance of corresponding surfaces at the start:
                                      ///< one and a half standard deviations of the axis' shift
  double relative_systematic = 4e-6;  ///< error of a view over a whole region, which no number of
                                      ///< points averages out: 2 um at 500 mm
  double outlier_overlap = 0.4;       ///< a view that matches less than this share of what the
                                      ///< median view matches fits no other
  double max_contradiction = 0.01;    ///< share of a view's points in front of another view's
                                      ///< surface, beyond which the result is not trustworthy: 5
                                      ///< times what edges and stray points cause; a gear whose
                                      ///< table lost a step has 0.016
  double as_good_as_given = 1.02;     ///< the given axis and angles stay unless they fit worse
                                      ///< than the refined ones by this factor, or by more than
                                      ///< noise explains where few points overlap
  double max_axis_sigma_px = 0.1;     ///< of the axis, in distances of neighbouring pixels' points,
                                      ///< beyond which a warning is given
  double unverified_share = 0.25;     ///< standard deviation of an axis and angles that the rig
                                      ///< does not state, as a share of the priors above, which
                                      ///< allow for a rig that was moved: 0.5 mm at 500 mm
  int max_iterations = 30;            ///< each linearizes once
  /// What is done, or advised, where the views say that the rig is not as it states.
  WrongRig wrong_rig = WrongRig::AdviseRefinement;
  /// Starting values: the part pose of each further setup, as `RegistrationReport` has them.
  std::vector<Eigen::Isometry3d> part_poses{};

  /// @errors   Error(Input) that names the value which is out of its range
  void check() const;
};

/// One position of the turntable.
struct Station {
  double angle_rad = 0.0;    ///< commanded
  std::string name;          ///< for warnings; empty is its number
  std::size_t setup = 0;     ///< the part was turned over or tilted between setups
  double time_s = kMissing;  ///< when its frames were taken, since the scan began; missing: the
                             ///< stations are taken for even in time

  /// What a sentence says behind "view": its number for "views/NUMBER", else its name; `view`, if
  /// it has none.
  [[nodiscard]] std::string label(std::size_t view) const;
};

/// The turntable as the rig gives it, and its stations, one a view.
struct TurntableStations {
  const Turntable& table;             ///< axis as the rig gives it
  std::span<const Station> stations;  ///< one for each view
  /// With its pattern: a rig that is not what it states is one of the explanations, too.
  const Rig* rig = nullptr;
  const Pattern* pattern = nullptr;  ///< any fringe pattern in the direction of the fringes
  /// Points that several views measured, which count beside the surfaces of the views.
  std::span<const PointTie> ties{};
};

/// Refines the turntable's axis, the angle of each view and the part pose of each setup but the
/// first, all at once, so that the surfaces of different views agree. The angle of the first view
/// is held. Sets the poses of `views`: the object frame is that of the refined axis, in the first
/// setup.
///
/// A view that fits no other, for example because the part was moved, is named in a warning and
/// emptied. When views contradict each other and no single view explains it, the report is marked
/// as not trustworthy.
///
/// @missing  one view alone, or views that do not overlap, keep the poses of the rig, with a
/// warning
/// @errors   Error(Input) when the numbers of stations and views differ, when a further setup has
///          no part pose, and as `RegisterOptions::check`
/// @source   bundle adjustment of projective point-to-plane distances by `minimize_robustly`
[[nodiscard]] RegistrationReport register_views(ViewStore& views,
                                                const CameraModel& camera,
                                                const TurntableStations& given,
                                                const RegisterOptions& options = {},
                                                const Run& run = {});

}  // namespace frangia
