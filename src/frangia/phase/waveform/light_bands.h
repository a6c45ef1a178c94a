#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frangia/frames/frame_stack.h"

namespace frangia {

/// Light that differs from row to row within a frame, by other amounts in each frame: a camera that
/// reads its rows one after the other sees a projector or a lamp that flickers as bands.
struct LightBands {
  /// What multiplies the light, minus 1; the mean over the frames of a pattern is 0.
  ///
  /// @shape    one list per frame, one value per image row
  std::vector<std::vector<float>> gains;
  double rms = 0.0;  ///< of the gains at rows with fringes
};

/// Finds bands in the frames of a fringe pattern.
///
/// A row of pixels shows fringes of all phases, so that its residuals from the fringes determine
/// the gains of the frames there: r = P (s g) with the fitted fringe s and the projector P onto
/// what no fringe explains. Gains of blocks of rows are fitted to every other column. They are
/// bands if they leave much less of the residuals of the columns between them, which they were not
/// fitted to, than gains and displacements of whole frames do.
///
/// @missing  nothing without bands, for fewer than four frames, for fringes along the rows, whose
///           phases a row does not show, and for gains of more than a third: such frames are torn
///           or covered
[[nodiscard]] std::optional<LightBands> find_light_bands(const FrameStack& fringes);

/// The frames at even light. Saturated pixels stay saturated.
[[nodiscard]] FrameStack without_bands(const FrameStack& fringes, const LightBands& bands);

/// A sentence: "pattern ...: the light differs from row to row by 5 % rms, ...".
[[nodiscard]] std::string describe(const LightBands& bands, const std::string& pattern);

}  // namespace frangia
