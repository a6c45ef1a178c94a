#pragma once

#include <Eigen/Core>

#include "frangia/rig/board.h"

namespace frangia {

/// Reflectance of a printed board at a point of its plane, relative to the middle of its grid.
///
/// @units    mm; 1 is white paper
[[nodiscard]] double board_albedo(const Board& board, const Eigen::Vector2d& point_mm);

}  // namespace frangia
