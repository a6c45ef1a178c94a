#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/run.h"
#include "frangia/registration/registration_report.h"
#include "frangia/rig/rig.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// What is known beforehand, as standard deviations, and how hard to try. What the part's shape
/// does not determine (a round part looks the same from all sides) stays where these put it.
struct RegisterOptions {
  double angle_sigma_rad = rad_from_deg(0.2);  ///< of each commanded table angle
  double tilt_sigma_rad = rad_from_deg(1.0);   ///< of the given axis
  double shift_sigma_mm = 2.0;                 ///< of the given axis
  double reach_mm = 3.0;         ///< how far surfaces that are one may lie apart at the start
  double systematic_mm = 0.002;  ///< what a view is off by over a whole region: no number of points
                                 ///< makes the views fit better than that
  int max_iterations = 30;
  /// Where to start from: how the part stands in each further setup, as the report tells it.
  std::vector<Eigen::Isometry3d> part_poses{};
};

/// One station of the turntable.
struct Station {
  double angle_rad = 0.0;  ///< commanded
  std::string name;        ///< for warnings; empty is its number
  std::size_t setup = 0;   ///< the part was turned over or tilted between setups
};

/// The turntable as the rig says it is, and its stations, one a view.
struct TurntableStations {
  const Turntable& table;
  std::span<const Station> stations;
};

/// All views at once: the axis of the turntable, the angle of each view, and how the part stands in
/// each setup but the first, so that the surfaces that they saw agree. The first view's angle is
/// held. Sets the poses of `views`: the object frame is that of the refined axis, in the first
/// setup.
///
/// A view that fits no other, as when the part was moved, is named, warned of and emptied. One view
/// alone, or views that do not overlap, keep the poses of the rig, with a warning.
///
/// errors   Error(Input) when there are not as many stations as views, or no part pose for a round
/// source   bundle of projective point-to-plane distances, by Gauss-Newton
[[nodiscard]] RegistrationReport register_views(ViewStore& views,
                                                const CameraModel& camera,
                                                const TurntableStations& given,
                                                const RegisterOptions& options = {},
                                                const Run& run = {});

}  // namespace frangia
