#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/missing.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// What the registration of a turntable's views found, and how well.
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
  double overlap = 0.0;        ///< share of the points that another view saw, too
  double condition = 0.0;      ///< of the equations, the prior among them
  double weakest = 0.0;        ///< how many times better the weakest unknown is known than before
  double axis_sigma_mm = 0.0;  ///< standard deviation of the axis where it is known least
  std::vector<std::string> undetermined;  ///< what the part does not determine
  std::vector<std::size_t> outliers;      ///< views that fit no other, emptied
  /// How the part stands in each further setup: what takes it from its place in the first setup,
  /// both at angle 0, in the frame of the refined table.
  std::vector<Eigen::Isometry3d> part_poses;
  int iterations = 0;
  bool kept_rig = false;  ///< the given axis and angles fit as well, and stay

  [[nodiscard]] double axis_moved_mm() const;
  [[nodiscard]] double axis_turned_rad() const;
  [[nodiscard]] double largest_turn_rad() const;  ///< of a view
  /// One or more sentences with the figures.
  [[nodiscard]] std::string text() const;
};

}  // namespace frangia
