#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/calibrate/board/board_view.h"
#include "frangia/calibrate/internal/rig_model.h"
#include "frangia/calibrate/internal/rig_residuals.h"
#include "frangia/rig/board.h"

namespace frangia {

/// One coordinate pair of the measurements, as the adjustment has it.
struct RigObservation {
  std::size_t view = 0;
  std::size_t point = 0;  ///< of the camera in the view
  BoardSite site;
  std::size_t camera = 0;         ///< 0: the reference camera, then the further ones
  bool by_projector = false;      ///< the projector pixel that the camera reads
  bool is_label = false;          ///< its difference from the one that the reference camera reads
  double circle_radius_mm = 0.0;  ///< of a board of circles
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Vector2d sigma_px = Eigen::Vector2d::Ones();
  PhaseReading reading{};    ///< of the camera, by_projector only
  PhaseReading reference{};  ///< of the reference camera, is_label only

  /// The scale of its standard deviation.
  [[nodiscard]] double scale(const RigNoise& noise) const {
    return (by_projector ? noise.projector : noise.camera)[camera];
  }
};

/// All observations of all views by all cameras; those of the projector where it was measured. With
/// a label, these are the differences of what two cameras read.
[[nodiscard]] std::vector<RigObservation> observations_of(const Board& board,
                                                          std::span<const BoardView> views,
                                                          bool has_projector = true);

}  // namespace frangia
