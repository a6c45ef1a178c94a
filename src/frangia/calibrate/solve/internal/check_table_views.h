#pragma once

#include <span>

#include "frangia/calibrate/board/board_view.h"

namespace frangia {

/// @errors   Error(Input) for views of a turning board that are too few or span too small an angle
void check_table_views(std::span<const BoardView> views, std::span<const double> angles_rad);

}  // namespace frangia
