#pragma once

#include <vector>

#include "frangia/calibrate/board/board_view.h"
#include "frangia/calibrate/solve/calibrate_rig.h"
#include "frangia/calibrate/solve/solve_rig.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"

namespace frangia {

/// Fails where the poses do not determine a parameter or contradict each other.
void check_solution(const RigSolution& solution,
                    const std::vector<BoardView>& views,
                    double max_rms_px);

/// Names a wrong square where rig.toml states the distance of two devices beforehand.
void warn_of_scale(const Scan& scan, const RigSolution& solution, double max_error, const Run& run);

/// The views whose reprojection error is far above the median of all views.
[[nodiscard]] std::vector<std::size_t> outlier_views(const std::vector<ResidualSummary>& by_view);

/// Names the poses whose reprojection error is far above that of the others.
void warn_of_outliers(const std::vector<BoardView>& views,
                      const RigSolution& solution,
                      const Run& run);

}  // namespace frangia
