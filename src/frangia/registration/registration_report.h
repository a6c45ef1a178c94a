#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/missing.h"
#include "frangia/registration/explain/pose_explanation.h"
#include "frangia/registration/view_motions.h"
#include "frangia/rig/rig.h"
#include "frangia/rig/rig_covariance.h"

namespace frangia {

/// Unknowns of a registration, in words.
inline constexpr const char* kTiltOfAxis = "the tilt of the axis";
inline constexpr const char* kPositionOfAxis = "the position of the axis";  ///< see `kTiltOfAxis`
inline constexpr const char* kAnglesOfViews = "the angles of the views";    ///< see `kTiltOfAxis`

/// Result of the registration of a turntable's views.
///
/// @units    mm, rad
struct RegistrationReport {
  Turntable table;  ///< refined; its point is the point of the axis nearest to the given one
  Turntable given;  ///< axis as the rig gives it
  std::vector<double> angles_rad;        ///< refined; the first is held
  std::vector<double> given_angles_rad;  ///< commanded angles
  double rms_before_mm = 0.0;  ///< distance between surfaces of different views, along the normal
  double rms_after_mm = 0.0;   ///< the same after registration
  /// Rotation of the last view that would align it with the first one: the accumulated error of the
  /// angle steps. NaN when these views do not overlap.
  double closure_before_rad = kMissing;
  double closure_after_rad = kMissing;  ///< the same after registration
  double overlap = 0.0;         ///< share of the points that lie on a surface of another view
  double condition = 0.0;       ///< condition number of the equations, with the prior
  double weakest = 0.0;         ///< factor by which the views improve on the prior in the direction
                                ///< that they determine worst; 1 is no improvement
  double axis_sigma_mm = 0.0;   ///< standard deviation of the axis in its weakest direction
  double axis_sigma_rad = 0.0;  ///< of its tilt, at most: by that much at the radius of the part
  std::vector<std::string> undetermined;  ///< unknowns that the part's shape does not determine
  std::vector<std::size_t> outliers;      ///< views that fit no other; they are emptied
  /// Of each further setup: the part's pose relative to the first setup, both at angle 0, in the
  /// frame of the refined table.
  std::vector<Eigen::Isometry3d> part_poses;
  /// Largest share of a view's points that lie in front of the surface that another view measured
  /// there. About 0.002 for a part that did not move.
  double contradiction = 0.0;
  bool trustworthy = true;  ///< false when `contradiction` exceeds the limit of the options
  int iterations = 0;       ///< of the refinement; each linearizes once
  bool kept_rig = false;    ///< the given axis and angles fit as well and are kept
  /// The overlap of the views says nothing of their places, which are those of the rig.
  bool rests_on_rig = false;
  TurntableSigma sigma;  ///< of the given axis and angles
  ViewMotions motions;   ///< of the views by what their overlap leaves open; empty for one view
  /// Median distance of the views where they overlap, if their places rest on the rig. NaN, as the
  /// two that follow, where fewer than 50 points overlap.
  double disagreement_mm = kMissing;
  double disagreement_over_noise = kMissing;  ///< median of the distances over their noise
  double disagreement_over_sigma = kMissing;  ///< the same over noise and `sigma`
  /// How far the rig may be from what it states by what the views disagree about, where that may
  /// be its fault; empty: it is not.
  RigCovariance rig_open{};
  PoseExplanation explanation;  ///< of what the views disagree about, but for noise

  /// Distance from `given.point_mm` to `table.point_mm`.
  [[nodiscard]] double axis_moved_mm() const;
  [[nodiscard]] double axis_turned_rad() const;   ///< angle between the given and the refined axis
  [[nodiscard]] double largest_turn_rad() const;  ///< largest correction of an angle
  /// The findings in words: one sentence, or clauses separated by semicolons.
  [[nodiscard]] std::string text() const;
  /// The same without the explanation.
  [[nodiscard]] std::string fit_text() const;
  /// What the places of the views rest on where it is the rig alone, as a sentence.
  [[nodiscard]] std::string rig_alone_text() const;
  /// Why the registration must not be trusted, as one clause; empty when it is trustworthy.
  [[nodiscard]] std::string untrusted_reason() const;
};

}  // namespace frangia
