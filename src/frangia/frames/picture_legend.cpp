#include "frangia/frames/picture_legend.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "frangia/frames/internal/draw_text.h"

namespace frangia {
namespace {

constexpr Rgb kPaper{244, 245, 247};
constexpr Rgb kInk{42, 47, 56};
constexpr Rgb kHistogramColor{126, 134, 148};
constexpr Rgb kLimitColor{176, 24, 24};
constexpr double kBarWidth = 1.7;  ///< lengths of the layout are in heights of capitals
constexpr double kTickLength = 0.45;
constexpr double kGap = 0.7;
constexpr double kPadding = 1.6;
constexpr double kHistogramWidth = 5.0;
constexpr double kLine = 2.1;  ///< from one entry to the next

double step_for(double width, bool whole_numbers) {
  constexpr double kMaxSteps = 6.0;
  const double least = width / kMaxSteps;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= least * (1.0 - 1e-9)) step = factor * power;
  return whole_numbers ? std::max(1.0, step) : step;
}

std::string tick_text(double value, int decimals, bool is_signed) {
  if (decimals > 6 || std::abs(value) >= 1e7) return fmt::format("{:.3g}", value);
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool zero = text.find_first_of("123456789") == std::string::npos;
  if (zero) return text[0] == '-' ? text.substr(1) : text;
  return is_signed && value > 0.0 ? "+" + text : text;
}

void fill(
    Image<Rgb>& picture, double left, double top, double right, double bottom, const Rgb& color) {
  const auto pixel = [](double edge) { return static_cast<int>(std::lround(edge)); };
  for (int y = std::max(0, pixel(top)); y < std::min(picture.height(), pixel(bottom)); ++y) {
    for (int x = std::max(0, pixel(left)); x < std::min(picture.width(), pixel(right)); ++x)
      picture(x, y) = color;
  }
}

double widest_tick(const ColorScale& scale, double em) {
  double widest = 0.0;
  for (const ScaleTick& tick : scale_ticks(scale))
    widest = std::max(widest, text_width(tick.text, em));
  return widest;
}

/// A limit with enough digits to tell it from its neighbours.
std::string limit_text(double value) {
  return fmt::format("{:+.4g}", value);
}

/// Width of the histogram and of the numbers of the limits, with the gaps before them.
double extra_width(const ColorScale& scale, double em) {
  double widest = 0.0;
  for (const double limit : scale.limits)
    widest = std::max(widest, text_width(limit_text(limit), em) + kGap * em);
  return (scale.histogram.empty() ? 0.0 : em * (kHistogramWidth + kGap)) + widest;
}

double legend_width(const PictureLegend& legend, double em) {
  double width = 0.0;
  for (const ColorScale& scale : legend.scales) {
    const double beside =
        em * (kBarWidth + kTickLength + kGap) + widest_tick(scale, em) + extra_width(scale, em);
    width = std::max({width, text_width(scale.label, em), beside});
  }
  for (const LegendEntry& entry : legend.entries)
    width = std::max(width, em * (kBarWidth + kGap) + text_width(entry.meaning, em));
  return width + 2.0 * kPadding * em;
}

/// Where the bar of a scale stands.
struct ScaleBar {
  double left, right, top, bottom;

  /// The row of a share of the range, 0 to 1.
  [[nodiscard]] double row(double share) const { return bottom - share * (bottom - top); }
};

/// Draws the histogram, whose longest bar has its full width, and the limits over all of it.
void draw_distribution(
    Image<Rgb>& picture, const ColorScale& scale, const ScaleBar& bar, double left, double em) {
  const auto& shares = scale.histogram;
  const double line = std::max(1.0, 0.1 * em);
  float most = 0.0F;
  for (const float share : shares)
    most = std::max(most, share);
  for (std::size_t i = 0; i < shares.size() && most > 0.0F; ++i) {
    const auto count = static_cast<double>(shares.size());
    const double length = kHistogramWidth * em * static_cast<double>(shares[i] / most);
    const double at = static_cast<double>(i);
    fill(picture,
         left,
         bar.row((at + 1.0) / count),
         left + length,
         bar.row(at / count),
         kHistogramColor);
  }
  if (!shares.empty()) fill(picture, left - line, bar.top, left, bar.bottom, kInk);
  const double right = left + (shares.empty() ? 0.0 : kHistogramWidth * em);
  for (const double limit : scale.limits) {
    const auto low = static_cast<double>(scale.range.low);
    const double share = (limit - low) / (static_cast<double>(scale.range.high) - low);
    if (!(share >= 0.0 && share <= 1.0)) continue;
    const double y = bar.row(share);
    fill(picture, bar.left, y - 0.5 * line, bar.right, y + 0.5 * line, kLimitColor);
    fill(picture, left, y - 0.5 * line, right, y + 0.5 * line, kLimitColor);
    draw_text(picture, limit_text(limit), {right + kGap * em, y + 0.5 * em, em}, kLimitColor);
  }
}

/// Draws a scale between two rows.
void draw_scale(Image<Rgb>& picture,
                const ColorScale& scale,
                double left,
                double top,
                double bottom,
                double em) {
  draw_text(picture, scale.label, {left, top + em, em}, kInk);
  const double bar_top = top + (scale.label.empty() ? 0.5 : 2.6) * em;
  const double bar_bottom = bottom - 0.5 * em;
  const double right = left + kBarWidth * em;
  const double line = std::max(1.0, 0.1 * em);
  fill(picture, left - line, bar_top - line, right + line, bar_bottom + line, kInk);
  for (int y = static_cast<int>(std::lround(bar_top)); y < std::lround(bar_bottom); ++y) {
    const double share = (bar_bottom - (y + 0.5)) / (bar_bottom - bar_top);
    fill(picture, left, y, right, y + 1, pixel_of(scale.map, static_cast<float>(share)));
  }
  const double low = static_cast<double>(scale.range.low);
  const double width = static_cast<double>(scale.range.high) - low;
  const double numbers_right = right + em * (kTickLength + kGap) + widest_tick(scale, em);
  for (const ScaleTick& tick : scale_ticks(scale)) {
    const double share = width > 0.0 ? (tick.value - low) / width : 0.5;
    const double y = bar_bottom - share * (bar_bottom - bar_top);
    fill(picture, right, y - 0.5 * line, right + kTickLength * em, y + 0.5 * line, kInk);
    draw_text(
        picture, tick.text, {numbers_right - text_width(tick.text, em), y + 0.5 * em, em}, kInk);
  }
  if (scale.histogram.empty() && scale.limits.empty()) return;
  const ScaleBar bar{left, right, bar_top, bar_bottom};
  draw_distribution(picture, scale, bar, numbers_right + kGap * em, em);
}

}  // namespace

std::vector<ScaleTick> scale_ticks(const ColorScale& scale) {
  const auto low = static_cast<double>(scale.range.low);
  const auto high = static_cast<double>(scale.range.high);
  if (!(high > low)) return {{low, tick_text(low, scale.whole_numbers ? 0 : 3, false)}};
  const double step = step_for(high - low, scale.whole_numbers);
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  std::vector<ScaleTick> ticks;
  const double tolerance = 1e-6;  // the ends are floats
  const auto last = static_cast<std::int64_t>(std::floor(high / step + tolerance));
  for (auto i = static_cast<std::int64_t>(std::ceil(low / step - tolerance)); i <= last; ++i) {
    const double value = static_cast<double>(i) * step;
    ticks.push_back({value, tick_text(value, decimals, low < 0.0)});
  }
  return ticks;
}

Image<Rgb> add_legend(const Image<Rgb>& picture, const PictureLegend& legend) {
  if (legend.scales.empty() && legend.entries.empty()) return picture;
  const double em = std::max(8.0, picture.height() / 50.0);
  const int strip = static_cast<int>(std::ceil(legend_width(legend, em)));
  Image<Rgb> out(picture.width() + strip, picture.height(), kPaper);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x)
      out(x, y) = picture(x, y);
  }
  const double left = picture.width() + kPadding * em;
  const double entries_height = kLine * em * static_cast<double>(legend.entries.size());
  const double bottom = picture.height() - kPadding * em - entries_height;
  double top = kPadding * em;
  const double height =
      (bottom - top) / std::max<double>(1.0, static_cast<double>(legend.scales.size()));
  for (const ColorScale& scale : legend.scales) {
    draw_scale(out, scale, left, top, top + height - kPadding * em, em);
    top += height;
  }
  if (legend.scales.empty()) top = kPadding * em;
  for (const LegendEntry& entry : legend.entries) {
    const double line = std::max(1.0, 0.1 * em);
    fill(out, left - line, top - line, left + kBarWidth * em + line, top + em + line, kInk);
    fill(out, left, top, left + kBarWidth * em, top + em, entry.color);
    draw_text(out, entry.meaning, {left + em * (kBarWidth + kGap), top + em, em}, kInk);
    top += kLine * em;
  }
  return out;
}

}  // namespace frangia
