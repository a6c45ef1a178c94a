#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "frangia/core/image.h"

namespace frangia {

/// Parameters of one frame: the projected light, the camera settings and the noise stream.
struct Shot {
  double cos_shift = 1.0;
  double sin_shift = 0.0;
  std::uint64_t stream = 0;
  double light = 1.0;         ///< factor on the scene's exposure
  double projector = 1.0;     ///< share of the projector's light that is on
  double lamp = 0.0;          ///< ambient light of another lamp, as `SimulateOptions::ambient`
  double gain = 1.0;          ///< factor on the scene's counts per electron
  double black_counts = 0.0;  ///< added to all pixels
  int clips_at_counts = 0;    ///< no pixel has more; 0: no such limit
  /// Picture of a digital projector that replaces the pattern, linear, 0 to 1.
  const Image<float>* picture = nullptr;
  /// Pictures that a part of the exposure saw instead: a share of it each.
  std::vector<std::pair<const Image<float>*, double>> before = {};
};

}  // namespace frangia
