#pragma once

#include <span>

#include "frangia/calibrate/board_view.h"
#include "frangia/calibrate/internal/rig_model.h"
#include "frangia/calibrate/solve_rig.h"
#include "frangia/rig/board.h"

namespace frangia {

/// Values near enough for the adjustment to converge: principal points in the image centers, focal
/// lengths from the homographies of the board or, where they fit better, those of the given models;
/// poses from these.
///
/// @errors   Error(Input) that names the view whose points lie on one line or in mirrored order
/// @source   Zhang 2000; OpenCV's initCameraMatrix2D and solvePnP
[[nodiscard]] RigParameters start_values(const Board& board,
                                         std::span<const BoardView> views,
                                         const CameraModel& camera,
                                         const CameraModel& projector);

}  // namespace frangia
