#include "frangia/frames/internal/draw_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

/// A letter of a single-stroke font. Units: capitals are 10 high, small letters 7, descenders reach
/// -3.
struct StrokeGlyph {
  char letter;
  double width;
  /// Strokes separated by ';': "L x y x y ..." is a polyline, "A cx cy rx ry from to" an elliptical
  /// arc between two angles in degrees.
  std::string_view strokes;
};

constexpr StrokeGlyph kBox{'\0', 6.0, "L 0 0 6 0 6 10 0 10 0 0"};

// Drawn for this project. Digits, + and - have one width, so that columns of numbers align.
constexpr std::array kGlyphs{
    StrokeGlyph{' ', 2.6, ""},
    StrokeGlyph{'!', 1.0, "L .5 10 .5 3;L .5 .3 .5 0"},
    StrokeGlyph{'"', 2.4, "L .4 10 .4 7.4;L 2 10 2 7.4"},
    StrokeGlyph{'#', 6.4, "L 2.4 10 1 0;L 5.4 10 4 0;L .4 6.6 6.4 6.6;L 0 3.4 6 3.4"},
    StrokeGlyph{'%', 8.4, "A 1.7 7.8 1.7 2.2 0 360;A 6.7 2.2 1.7 2.2 0 360;L 7 10 1.4 0"},
    StrokeGlyph{'&',
                7.2,
                "L 7.2 0 1.6 6.6;A 3 8 1.9 2 225 -35;L 4.6 6.9 1.2 4.6;A 2.9 2.4 2.9 2.4 140 350"},
    StrokeGlyph{'\'', .8, "L .4 10 .4 7.4"},
    StrokeGlyph{'(', 2.2, "A 4.2 4.2 4.2 7.6 120 240"},
    StrokeGlyph{')', 2.2, "A -2 4.2 4.2 7.6 60 -60"},
    StrokeGlyph{'*', 4.4, "L 2.2 10 2.2 5;L 0 8.8 4.4 6.2;L 4.4 8.8 0 6.2"},
    StrokeGlyph{'+', 6.0, "L 3 2 3 8;L 0 5 6 5"},
    StrokeGlyph{',', 1.0, "L .8 .4 .1 -1.8"},
    StrokeGlyph{'-', 6.0, "L .3 5 5.7 5"},
    StrokeGlyph{'.', 1.0, "L .5 .3 .5 0"},
    StrokeGlyph{'/', 4.4, "L 0 -1 4.4 10.6"},
    StrokeGlyph{'0', 6.0, "A 3 5 3 5 0 360"},
    StrokeGlyph{'1', 6.0, "L 1 7.9 3.5 10 3.5 0"},
    StrokeGlyph{'2', 6.0, "A 3 7.1 2.8 2.9 165 -40;L 5.14 5.24 .2 0 6 0"},
    StrokeGlyph{'3', 6.0, "A 2.9 7.6 2.5 2.4 150 -90;A 2.9 2.6 3 2.6 90 -150"},
    StrokeGlyph{'4', 6.0, "L 4.5 0 4.5 10 0 2.9 6 2.9"},
    StrokeGlyph{'5', 6.0, "L 5.4 10 1.2 10 .7 5.6;A 2.9 3.25 3 3.25 136 -150"},
    StrokeGlyph{'6', 6.0, "A 3 3.2 3 3.2 0 360;A 6 3.2 6 6.9 180 105"},
    StrokeGlyph{'7', 6.0, "L 0 10 6 10 2.2 0"},
    StrokeGlyph{'8', 6.0, "A 3 7.6 2.5 2.4 0 360;A 3 2.6 3 2.6 0 360"},
    StrokeGlyph{'9', 6.0, "A 3 6.8 3 3.2 0 360;A 0 6.8 6 6.9 0 -75"},
    StrokeGlyph{':', 1.0, "L .5 .3 .5 0;L .5 6.3 .5 6"},
    StrokeGlyph{';', 1.0, "L .8 .4 .1 -1.8;L .6 6.3 .6 6"},
    StrokeGlyph{'<', 5.4, "L 5.4 8.4 0 5 5.4 1.6"},
    StrokeGlyph{'=', 6.0, "L .2 3.4 5.8 3.4;L .2 6.6 5.8 6.6"},
    StrokeGlyph{'>', 5.4, "L 0 8.4 5.4 5 0 1.6"},
    StrokeGlyph{'?', 5.0, "A 2.5 7.4 2.5 2.6 170 -60;L 3.75 5.15 2.5 4 2.5 2.8;L 2.5 .3 2.5 0"},
    StrokeGlyph{'A', 7.2, "L 0 0 3.6 10 7.2 0;L 1.25 3.5 5.95 3.5"},
    StrokeGlyph{'B',
                6.2,
                "L 3.4 5.3 0 5.3 0 10 3.4 10;A 3.4 7.65 2.3 2.35 90 -90;L 0 5.3 0 0 3.5 0;A 3.5 "
                "2.65 2.7 2.65 90 -90"},
    StrokeGlyph{'C', 7.6, "A 4.4 5 4.4 5 46 314"},
    StrokeGlyph{'D', 7.2, "L 2.6 0 0 0 0 10 2.6 10;A 2.6 5 4.6 5 90 -90"},
    StrokeGlyph{'E', 5.4, "L 5.4 10 0 10 0 0 5.4 0;L 0 5.3 4.6 5.3"},
    StrokeGlyph{'F', 5.2, "L 5.2 10 0 10 0 0;L 0 5.2 4.4 5.2"},
    StrokeGlyph{'G', 8.6, "A 4.4 5 4.4 5 46 340;L 8.53 3.29 8.6 4.7 5.2 4.7"},
    StrokeGlyph{'H', 6.6, "L 0 0 0 10;L 6.6 0 6.6 10;L 0 5.2 6.6 5.2"},
    StrokeGlyph{'I', 1.0, "L .5 0 .5 10"},
    StrokeGlyph{'J', 3.8, "L 3.8 10 3.8 2.7;A 1.9 2.7 1.9 2.7 0 -165"},
    StrokeGlyph{'K', 6.4, "L 0 0 0 10;L 6 10 0 3.8;L 2.3 6.2 6.4 0"},
    StrokeGlyph{'L', 5.0, "L 0 10 0 0 5 0"},
    StrokeGlyph{'M', 8.0, "L 0 0 0 10 4 2.4 8 10 8 0"},
    StrokeGlyph{'N', 6.6, "L 0 0 0 10 6.6 0 6.6 10"},
    StrokeGlyph{'O', 8.8, "A 4.4 5 4.4 5 0 360"},
    StrokeGlyph{'P', 6.0, "L 0 0 0 10 3.3 10;A 3.3 7.3 2.7 2.7 90 -90;L 3.3 4.6 0 4.6"},
    StrokeGlyph{'Q', 8.8, "A 4.4 5 4.4 5 0 360;L 5.8 2.6 8.6 -.8"},
    StrokeGlyph{
        'R', 6.4, "L 0 0 0 10 3.3 10;A 3.3 7.3 2.7 2.7 90 -90;L 3.3 4.6 0 4.6;L 3.2 4.6 6.4 0"},
    StrokeGlyph{'S', 6.0, "A 3 7.5 2.7 2.5 35 270;A 3 2.5 3 2.5 90 -145"},
    StrokeGlyph{'T', 7.0, "L 0 10 7 10;L 3.5 10 3.5 0"},
    StrokeGlyph{'U', 6.6, "L 0 10 0 3.2;A 3.3 3.2 3.3 3.2 180 360;L 6.6 3.2 6.6 10"},
    StrokeGlyph{'V', 7.0, "L 0 10 3.5 0 7 10"},
    StrokeGlyph{'W', 10.0, "L 0 10 2.5 0 5 10 7.5 0 10 10"},
    StrokeGlyph{'X', 6.4, "L 0 10 6.4 0;L 6.4 10 0 0"},
    StrokeGlyph{'Y', 6.8, "L 0 10 3.4 4.8 6.8 10;L 3.4 4.8 3.4 0"},
    StrokeGlyph{'Z', 6.2, "L 0 10 6.2 10 0 0 6.2 0"},
    StrokeGlyph{'[', 2.0, "L 2 11 0 11 0 -2 2 -2"},
    StrokeGlyph{']', 2.0, "L 0 11 2 11 2 -2 0 -2"},
    StrokeGlyph{'^', 5.0, "L 0 7 2.5 10 5 7"},
    StrokeGlyph{'_', 6.0, "L 0 -1.6 6 -1.6"},
    StrokeGlyph{'a', 5.8, "A 2.9 3.5 2.9 3.5 0 360;L 5.8 7 5.8 0"},
    StrokeGlyph{'b', 5.8, "L 0 10 0 0;A 2.9 3.5 2.9 3.5 0 360"},
    StrokeGlyph{'c', 5.2, "A 3 3.5 3 3.5 48 312"},
    StrokeGlyph{'d', 5.8, "A 2.9 3.5 2.9 3.5 0 360;L 5.8 10 5.8 0"},
    StrokeGlyph{'e', 5.8, "L 0 3.6 5.8 3.6;A 2.9 3.5 2.9 3.5 0 318"},
    StrokeGlyph{'f', 3.4, "L 1.3 0 1.3 8;A 3.3 8 2 2 180 80;L 0 7 3.2 7"},
    StrokeGlyph{'g', 5.8, "A 2.9 3.5 2.9 3.5 0 360;L 5.8 7 5.8 -.2;A 2.9 -.2 2.9 2.8 0 -150"},
    StrokeGlyph{'h', 5.4, "L 0 10 0 0;A 2.7 4.2 2.7 2.8 180 0;L 5.4 4.2 5.4 0"},
    StrokeGlyph{'i', .8, "L .4 7 .4 0;L .4 9.8 .4 9.5"},
    StrokeGlyph{'j', 1.8, "L 1.4 7 1.4 -1.4;A 0 -1.4 1.4 1.6 0 -80;L 1.4 9.8 1.4 9.5"},
    StrokeGlyph{'k', 4.8, "L 0 10 0 0;L 4.4 7 0 2.6;L 1.7 4.3 4.8 0"},
    StrokeGlyph{'l', .8, "L .4 10 .4 0"},
    StrokeGlyph{'m',
                8.8,
                "L 0 7 0 0;A 2.2 4.7 2.2 2.3 180 0;L 4.4 4.7 4.4 0;A 6.6 4.7 2.2 2.3 180 0;L 8.8 "
                "4.7 8.8 0"},
    StrokeGlyph{'n', 5.4, "L 0 7 0 0;A 2.7 4.2 2.7 2.8 180 0;L 5.4 4.2 5.4 0"},
    StrokeGlyph{'o', 6.0, "A 3 3.5 3 3.5 0 360"},
    StrokeGlyph{'p', 5.8, "L 0 7 0 -3;A 2.9 3.5 2.9 3.5 0 360"},
    StrokeGlyph{'q', 5.8, "L 5.8 7 5.8 -3;A 2.9 3.5 2.9 3.5 0 360"},
    StrokeGlyph{'r', 3.2, "L 0 7 0 0;A 2.6 4.2 2.6 2.8 180 78"},
    StrokeGlyph{'s', 4.6, "A 2.3 5.25 2 1.75 35 270;A 2.3 1.75 2.2 1.75 90 -145"},
    StrokeGlyph{'t', 3.6, "L 1.4 9.2 1.4 2;A 3.4 2 2 2 180 275;L 0 7 3.4 7"},
    StrokeGlyph{'u', 5.4, "L 0 7 0 2.8;A 2.7 2.8 2.7 2.8 180 360;L 5.4 7 5.4 0"},
    StrokeGlyph{'v', 5.4, "L 0 7 2.7 0 5.4 7"},
    StrokeGlyph{'w', 8.4, "L 0 7 2.1 0 4.2 7 6.3 0 8.4 7"},
    StrokeGlyph{'x', 5.0, "L 0 7 5 0;L 5 7 0 0"},
    StrokeGlyph{'y', 5.4, "L 0 7 2.8 0;L 5.4 7 2.1 -1.8;A .7 -1.2 1.5 1.8 -25 -95"},
    StrokeGlyph{'z', 5.0, "L 0 7 5 7 0 0 5 0"},
    StrokeGlyph{'|', .8, "L .4 11 .4 -2"},
};

/// The glyph of a printable ASCII character; an empty box for others.
const StrokeGlyph& glyph_of(char letter) {
  const auto* const found =
      std::find_if(kGlyphs.begin(), kGlyphs.end(), [&](const StrokeGlyph& glyph) {
        return glyph.letter == letter;
      });
  return found == kGlyphs.end() ? kBox : *found;
}

using Eigen::Vector2d;

constexpr double kCapHeight = 10.0;    ///< of the font's units
constexpr double kLetterSpace = 2.5;   ///< between letters, font units
constexpr double kStrokeWidth = 1.15;  ///< font units
constexpr double kMinStrokePx = 1.1;   ///< thinner strokes fade

std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == ' ') {
      ++i;
      continue;
    }
    double number = 0.0;
    const char* const end = std::from_chars(text.data() + i, text.data() + text.size(), number).ptr;
    numbers.push_back(number);
    i = static_cast<std::size_t>(end - text.data());
  }
  return numbers;
}

/// The points of a stroke, font units.
std::vector<Vector2d> polyline_of(std::string_view stroke) {
  const std::vector<double> n = numbers_in(stroke.substr(1));
  std::vector<Vector2d> points;
  if (stroke[0] == 'L') {
    for (std::size_t i = 0; i + 1 < n.size(); i += 2)
      points.emplace_back(n[i], n[i + 1]);
    return points;
  }
  constexpr double kStep_deg = 12.0;
  const int steps = static_cast<int>(std::ceil(std::abs(n[5] - n[4]) / kStep_deg));
  for (int i = 0; i <= steps; ++i) {
    const double angle = rad_from_deg(n[4] + (n[5] - n[4]) * i / steps);
    points.emplace_back(n[0] + n[2] * std::cos(angle), n[1] + n[3] * std::sin(angle));
  }
  return points;
}

double distance_to_segment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d ab = b - a;
  const double length2 = ab.squaredNorm();
  const double along = length2 > 0.0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - a - along * ab).norm();
}

/// Raises the coverage of the pixels near a segment.
void cover(Image<float>& coverage, const Vector2d& a, const Vector2d& b, double half_width) {
  const double reach = half_width + 1.0;
  const int left = std::max(0, static_cast<int>(std::floor(std::min(a.x(), b.x()) - reach)));
  const int right =
      std::min(coverage.width() - 1, static_cast<int>(std::ceil(std::max(a.x(), b.x()) + reach)));
  const int top = std::max(0, static_cast<int>(std::floor(std::min(a.y(), b.y()) - reach)));
  const int bottom =
      std::min(coverage.height() - 1, static_cast<int>(std::ceil(std::max(a.y(), b.y()) + reach)));
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const double distance = distance_to_segment({x + 0.5, y + 0.5}, a, b);
      const double share = std::clamp(half_width + 0.5 - distance, 0.0, 1.0);
      coverage(x, y) = std::max(coverage(x, y), static_cast<float>(share));
    }
  }
}

template <typename Use>
void for_each_stroke(std::string_view strokes, const Use& use) {
  while (!strokes.empty()) {
    const std::size_t end = std::min(strokes.find(';'), strokes.size());
    use(polyline_of(strokes.substr(0, end)));
    strokes.remove_prefix(std::min(end + 1, strokes.size()));
  }
}

}  // namespace

double text_width(std::string_view text, double cap_height) {
  double width = text.empty() ? 0.0 : -kLetterSpace;
  for (const char letter : text)
    width += glyph_of(letter).width + kLetterSpace;
  return width * cap_height / kCapHeight;
}

void draw_text(Image<Rgb>& picture,
               std::string_view text,
               const TextPlacement& placement,
               const Rgb& color) {
  const double scale = placement.cap_height / kCapHeight;
  const double half_width = 0.5 * std::max(kMinStrokePx, kStrokeWidth * scale);
  Image<float> coverage(picture.width(), picture.height(), 0.0F);
  double pen = placement.x;
  for (const char letter : text) {
    const StrokeGlyph& glyph = glyph_of(letter);
    for_each_stroke(glyph.strokes, [&](const std::vector<Vector2d>& points) {
      const auto at = [&](const Vector2d& p) {
        return Vector2d(pen + scale * p.x(), placement.baseline - scale * p.y());
      };
      for (std::size_t i = 0; i + 1 < points.size(); ++i)
        cover(coverage, at(points[i]), at(points[i + 1]), half_width);
    });
    pen += scale * (glyph.width + kLetterSpace);
  }
  for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
    const float share = coverage.pixels()[i];
    if (share <= 0.0F) continue;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      std::uint8_t& value = picture.pixels()[i][channel];
      value = static_cast<std::uint8_t>(std::lround((1.0F - share) * static_cast<float>(value) +
                                                    share * static_cast<float>(color[channel])));
    }
  }
}

}  // namespace frangia
