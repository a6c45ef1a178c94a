#pragma once

#include <span>
#include <string>
#include <vector>

#include "frangia/calibrate/board/check_board_views.h"

namespace frangia {

/// The first names and the number of the others.
[[nodiscard]] std::string list_of(const std::vector<std::string>& names);

/// Names of the poses for which `holds` is true.
template <typename Condition>
[[nodiscard]] std::vector<std::string> names_of(std::span<const PoseCapture> poses,
                                                const Condition& holds) {
  std::vector<std::string> names;
  for (const PoseCapture& pose : poses)
    if (holds(pose)) names.push_back(pose.view.name);
  return names;
}

/// Sentences that name a fault of some poses; `names` are those of `poses` that have it.
[[nodiscard]] std::string describe_dark(const std::vector<std::string>& names,
                                        const PoseCheckOptions& options);
[[nodiscard]] std::string describe_overexposed(const std::vector<std::string>& names,
                                               const PoseCheckOptions& options);
[[nodiscard]] std::string describe_swapped(std::span<const PoseCapture> poses,
                                           const std::vector<std::string>& names);
[[nodiscard]] std::string describe_blurred(std::span<const PoseCapture> poses,
                                           const std::vector<std::string>& names);
[[nodiscard]] std::string describe_exchanged(std::span<const PoseCapture> poses,
                                             const std::vector<std::string>& names);
[[nodiscard]] std::string describe_moved(std::span<const PoseCapture> poses,
                                         const std::vector<std::string>& names);

/// Names of the poses whose points are those of an earlier pose, to the last digit: copied files.
/// Noise tells two captures of one pose apart.
[[nodiscard]] std::vector<std::string> copies_of_others(std::span<const PoseCapture> poses);
[[nodiscard]] std::string describe_copies(const std::vector<std::string>& names);

/// The poses without the board whose images are as bright as the others and less sharp.
[[nodiscard]] std::vector<std::string> blurred_unseen(std::span<const PoseCapture> poses);

/// Whether the board is out of focus, or moved during single frames.
[[nodiscard]] inline bool is_blurred(const PoseCapture& pose, const PoseCheckOptions& options) {
  return pose.blur_px > options.max_blur_px;
}

/// Median distance of the projector's pixels from a homography of the board.
[[nodiscard]] double plane_misfit_px(const Board& board, const BoardView& view);

/// Warns of what makes a calibration inaccurate but does not prevent it.
void warn_of_quality(std::span<const PoseCapture> poses,
                     const PoseCheckOptions& options,
                     PoseChecks& checks);

}  // namespace frangia
