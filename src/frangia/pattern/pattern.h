#pragma once

#include <string>
#include <vector>

namespace frangia {

enum class PatternKind {
  Fringe,  ///< sinusoidal fringes, one frame a shift
  Line     ///< the single plane of light, one frame
};

/// Which way the fringes run. Vertical fringes number the projector's columns.
enum class FringeDirection { Vertical, Horizontal };

/// One thing the projector shows, in one or more frames: a [[pattern]] of scan.toml.
struct Pattern {
  std::string name;  ///< also the beginning of its files' names
  PatternKind kind = PatternKind::Fringe;
  FringeDirection direction = FringeDirection::Vertical;
  double fringes_per_degree = 0.0;  ///< angular projector; 0 for a pinhole one
  double period_px = 0.0;           ///< pinhole projector; 0 for an angular one
  std::vector<double> shifts_rad;   ///< sigma_i of the paper's equation (1), one a frame

  /// Fringes per degree, or per projector pixel.
  [[nodiscard]] double fringes_per_unit() const {
    return fringes_per_degree > 0.0 ? fringes_per_degree : 1.0 / period_px;
  }
  [[nodiscard]] int frame_count() const {
    return kind == PatternKind::Line ? 1 : static_cast<int>(shifts_rad.size());
  }
};

}  // namespace frangia
