#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/core/run.h"
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
};

/// One stop of the turntable.
struct RegisteredView {
  double angle_rad = 0.0;  ///< commanded
  std::string name;        ///< for warnings; empty is its number
};

struct RegistrationReport {
  Turntable table;  ///< refined; its point is the one nearest to the given one
  Turntable given;
  std::vector<double> angles_rad;  ///< refined; the first is held
  std::vector<double> given_angles_rad;
  double rms_before_mm = 0.0;  ///< between the surfaces of different views, along the normal
  double rms_after_mm = 0.0;
  /// By how much the last view would have to be turned on to meet the first one: a turntable that
  /// turns too far at each step shows here first. NaN when they do not overlap.
  double closure_before_rad = kMissing;
  double closure_after_rad = kMissing;
  double overlap = 0.0;    ///< share of the points that another view saw, too
  double condition = 0.0;  ///< of the equations, the prior among them
  double weakest = 0.0;    ///< how many times better the weakest unknown is known than before
  std::vector<std::string> open;      ///< what the part does not determine
  std::vector<std::size_t> outliers;  ///< views that fit no other, emptied
  int iterations = 0;

  [[nodiscard]] double axis_moved_mm() const;
  [[nodiscard]] double axis_turned_rad() const;
  [[nodiscard]] double largest_turn_rad() const;  ///< of a view
  /// One or more sentences with the figures.
  [[nodiscard]] std::string text() const;
};

/// All views at once: the axis of the turntable and the angle of each view, so that the surfaces
/// that they saw agree. The first view's angle is held. Sets the poses of `views`: the object frame
/// is that of the refined axis.
///
/// A view that fits no other, as when the part was moved, is named, warned of and emptied. One view
/// alone, or views that do not overlap, keep the poses of the rig, with a warning. shape
/// `stops`: one a view errors   Error(Input) when there are not as many stops as views source
/// bundle of projective point-to-plane distances, by Gauss-Newton
[[nodiscard]] RegistrationReport register_views(ViewStore& views,
                                                const Lens& camera,
                                                const Turntable& given,
                                                std::span<const RegisteredView> stops,
                                                const RegisterOptions& options = {},
                                                const Run& run = {});

}  // namespace frangia
