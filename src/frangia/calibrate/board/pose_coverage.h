#pragma once

#include <array>
#include <span>
#include <string>

#include "frangia/calibrate/board/board_view.h"
#include "frangia/rig/board.h"
#include "frangia/rig/camera_model.h"

namespace frangia {

/// What the next pose of a board should be.
struct PoseAdvice {
  /// What to do.
  enum class Kind {
    Repeat,      ///< the board was not found
    Sufficient,  ///< the coverage is; any other pose adds accuracy
    Move,        ///< to a place, and tilted
    Tilt,
    Nearer,
    Farther
  };
  Kind kind = Kind::Repeat;  ///< what to do
  std::string side;          ///< left, right, upper or lower: to tilt away from the camera
  std::string place;         ///< of the image: "upper left"; of Move only

  [[nodiscard]] std::string text() const;  ///< one clause
};

/// Which places of the field, distances and tilts the poses of a board cover.
struct PoseCoverage {
  /// Cells of a grid over the image, row by row, that hold a point of a board.
  std::array<bool, 12> cells{};
  static constexpr int kColumns = 4;  ///< of `cells`
  static constexpr int kRows = 3;     ///< of `cells`
  double nearest = 0.0;               ///< distance of the nearest board, relative to the mean
  double farthest = 0.0;              ///< distance of the farthest board, relative to the mean
  /// Largest tilts with the left, right, upper and lower side of the board away from the camera.
  std::array<double, 4> tilts_deg{};
  std::size_t poses = 0;  ///< that show the board
  PoseAdvice next;        ///< what the next pose should be

  [[nodiscard]] double field() const;     ///< share of the cells
  [[nodiscard]] double tilt_deg() const;  ///< largest tilt
  /// Whether the poses determine a rig well: at least the wanted tilts, cells and distances.
  [[nodiscard]] bool sufficient() const;
};

/// Measures what the poses cover so far, and decides what is wanted most.
///
/// @shape    `views` without points are poses in which the board was not found
/// @units    tilts in degrees; a camera of unknown focal length counts as one with a field of 40
///           degrees, which moves tilts by a few degrees
/// @source   pose of a plane from its homography: Zhang 2000
[[nodiscard]] PoseCoverage measure_pose_coverage(std::span<const BoardView> views,
                                                 const Board& board,
                                                 const CameraModel& camera);

}  // namespace frangia
