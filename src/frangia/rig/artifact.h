#pragma once

#include <optional>
#include <string>
#include <variant>

namespace frangia {

/// A monitor or tablet that shows fringes of its own in both directions.
struct Screen {
  int width_px = 0;       ///< columns of the monitor
  int height_px = 0;      ///< rows of the monitor
  double pixel_mm = 0.0;  ///< distance of neighboring pixels, the same along rows and columns
};

/// A plain flat plate.
struct Plate {};

/// One ball, or the two balls of a ball bar.
struct Balls {
  double diameter_mm = 0.0;          ///< of each ball
  std::optional<double> spacing_mm;  ///< of the two centers; none: a single ball
};

/// A calibration artifact without printed points; the `[board]` table of scan.toml holds it or a
/// `Board`.
using Artifact = std::variant<Screen, Plate, Balls>;

/// Name of an artifact as scan.toml has it: "screen", "plate", "ball" or "ball-bar".
[[nodiscard]] std::string name_of(const Artifact& artifact);

/// Checks the numbers of an artifact.
///
/// @errors   Error(Input) that names the key: a size that is not above 0, or balls that overlap
void check_artifact(const Artifact& artifact);

}  // namespace frangia
