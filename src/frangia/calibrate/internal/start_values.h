#pragma once

#include <array>
#include <span>

#include "frangia/calibrate/board/board_view.h"
#include "frangia/calibrate/internal/artifact_model.h"
#include "frangia/calibrate/internal/rig_model.h"
#include "frangia/calibrate/solve/solve_rig.h"
#include "frangia/rig/board.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Values near enough for the adjustment to converge: principal points in the image centers, focal
/// lengths from the homographies of the board or, where they fit better, those of the given models;
/// poses from these.
///
/// @missing  a projector that is a label, and one without measured pixels, has none
/// @errors   Error(Input) that names the view whose points lie on one line or in mirrored order, or
///           a further camera that sees the board in too few poses
/// @source   Zhang 2000; OpenCV's initCameraMatrix2D and solvePnP
[[nodiscard]] RigParameters start_values(const Board& board,
                                         std::span<const BoardView> views,
                                         const Rig& known);

/// Returns the terms of the wavefront that would explain the residuals of a fit and are not yet
/// estimated: first the second order, then the third; none when the residuals are noise.
///
/// @source   score test, Rao 1948, at the optimum without them
[[nodiscard]] std::array<bool, Wavefront::kTerms> missing_wavefront_terms(
    const ArtifactProblem& problem,
    const ArtifactNoise& noise,
    const ArtifactParameters& parameters);

}  // namespace frangia
