#include "frangia/frames/internal/draw_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/angles.h"
#include "frangia/frames/internal/stroke_font.h"

namespace frangia {
namespace {

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
