#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "frangia/calibrate/board/board_view.h"
#include "frangia/calibrate/solve/solve_rig.h"
#include "frangia/rig/board.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Axis of a turntable, with its uncertainty.
struct TurntableSolution {
  Turntable turntable;                 ///< the point is at the height of the board's lowest point
  Eigen::Isometry3d rig_from_board{};  ///< pose of the board at table angle 0
  double axis_sigma_rad = 0.0;         ///< standard deviation of the direction, the larger of two
  double point_sigma_mm = 0.0;  ///< standard deviation of the place at the board, the larger of two
  double angle_rms_rad = 0.0;   ///< of the deviations of the views from their stated angles
  ResidualSummary camera_residuals;     ///< of all camera pixels
  ResidualSummary projector_residuals;  ///< of all projector pixels
};

/// Finds the axis of a turntable from views of a board that stands on it, by a calibrated camera
/// and projector. The direction of the axis is that about which the angles are counted.
///
/// @shape    one angle per view
/// @units    rad, mm
/// @errors   Error(Input) for fewer than three views, angles within 20 degrees, or an
///           angular projector; Error(Numeric) when the adjustment fails
/// @source   least squares of the reprojection errors by Levenberg and Marquardt's method
[[nodiscard]] TurntableSolution solve_turntable(const Board& board,
                                                std::span<const BoardView> views,
                                                std::span<const double> angles_rad,
                                                const Rig& rig);

}  // namespace frangia
