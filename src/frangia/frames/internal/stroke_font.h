#pragma once

#include <span>
#include <string_view>

namespace frangia {

/// A letter of a single-stroke font. Units: capitals are 10 high, small letters 7, descenders reach
/// -3.
struct StrokeGlyph {
  char letter;
  double width;
  /// Strokes separated by ';': "L x y x y ..." is a polyline, "A cx cy rx ry from to" an elliptical
  /// arc between two angles in degrees.
  std::string_view strokes;
};

/// The glyph of a printable ASCII character; an empty box for others.
[[nodiscard]] const StrokeGlyph& glyph_of(char letter);

}  // namespace frangia
