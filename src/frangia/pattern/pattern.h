#pragma once

#include <string>
#include <vector>

namespace frangia {

enum class PatternKind {
  Fringe,  ///< sinusoidal fringes, one frame a shift
  Line,    ///< the single plane of light, one frame
  Gray,    ///< Gray code of the projector's columns or rows, one frame a bit
  Ramp     ///< the whole field evenly lit, one frame a level
};

/// Which way the fringes run. Vertical fringes number the projector's columns.
enum class FringeDirection { Vertical, Horizontal };

/// One thing the projector shows, in one or more frames: a [[pattern]] of scan.toml.
struct Pattern {
  std::string name;  ///< also the beginning of its files' names
  PatternKind kind = PatternKind::Fringe;
  FringeDirection direction = FringeDirection::Vertical;
  double fringes_per_degree = 0.0;   ///< angular projector; 0 for a pinhole one
  double period_px = 0.0;            ///< pinhole projector; 0 for an angular one
  std::vector<double> shifts_rad;    ///< sigma_i of the paper's equation (1), one a frame
  int bits = 0;                      ///< of Gray code, the most significant shown first
  double stripe_px = 1.0;            ///< Gray code: columns that share a number
  bool inverted = false;             ///< Gray code: all frames follow once more, inverted
  std::vector<double> levels;        ///< of a ramp, as shares of full light
  std::vector<double> exposures_ms;  ///< each frame is taken at each; empty: at one, not told

  /// Fringes per degree, or per projector pixel.
  [[nodiscard]] double fringes_per_unit() const {
    return fringes_per_degree > 0.0 ? fringes_per_degree : 1.0 / period_px;
  }
  /// Frames at one exposure.
  [[nodiscard]] int frame_count() const {
    switch (kind) {
      case PatternKind::Line:
        return 1;
      case PatternKind::Gray:
        return inverted ? 2 * bits : bits;
      case PatternKind::Ramp:
        return static_cast<int>(levels.size());
      case PatternKind::Fringe:
        break;
    }
    return static_cast<int>(shifts_rad.size());
  }
  [[nodiscard]] int exposure_count() const {
    return exposures_ms.empty() ? 1 : static_cast<int>(exposures_ms.size());
  }
};

}  // namespace frangia
