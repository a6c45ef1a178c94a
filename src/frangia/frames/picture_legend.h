#pragma once

#include <string>
#include <vector>

#include "frangia/core/image.h"
#include "frangia/frames/map_picture.h"

namespace frangia {

/// A color map with the values at its two ends.
struct ColorScale {
  ColorMap map = ColorMap::Viridis;  ///< colors from `range.low` to `range.high`
  ValueRange range;                  ///< values at the two ends
  std::string label;                 ///< the quantity and its unit: "deviation, mm"
  bool whole_numbers = false;        ///< no fractions at the ticks, as for counts
  /// Share of the values in equal intervals of the range, ascending, drawn beside the bar; empty:
  /// no histogram.
  std::vector<float> histogram{};
  std::vector<double> limits{};  ///< values that are marked by a line with their number
};

/// A color with a fixed meaning.
struct LegendEntry {
  Rgb color{};          ///< color in the picture
  std::string meaning;  ///< what the color marks
};

/// The color scales and the colors with a fixed meaning that a legend explains.
struct PictureLegend {
  std::vector<ColorScale> scales;    ///< drawn as bars with numbers
  std::vector<LegendEntry> entries;  ///< drawn below the scales
};

/// A labelled value of a color scale.
struct ScaleTick {
  double value = 0.0;  ///< position of the tick, in the unit of the scale
  std::string text;  ///< with as many decimals as the other ticks, and signed when any is negative
};

/// Round values between the ends of a scale, at steps of 1, 2 or 5 times a power of ten.
///
/// @shape    ascending; three to eleven ticks; one for a range of a single value
[[nodiscard]] std::vector<ScaleTick> scale_ticks(const ColorScale& scale);

/// The picture with a legend to its right: each scale as a bar with numbers, then the entries.
///
/// @shape    as high as the picture; an empty legend leaves the picture as it is
[[nodiscard]] Image<Rgb> add_legend(const Image<Rgb>& picture, const PictureLegend& legend);

}  // namespace frangia
