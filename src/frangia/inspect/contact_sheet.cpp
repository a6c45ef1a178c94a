#include "frangia/inspect/contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "frangia/core/error.h"

namespace frangia {
namespace {

/// Mean of the source pixels that a target pixel covers, weighted by area.
Rgb area_mean(const Image<Rgb>& picture, double x0, double x1, double y0, double y1) {
  std::array<double, 3> sum{};
  double weight = 0.0;
  for (int y = static_cast<int>(y0); y < std::min<double>(picture.height(), std::ceil(y1)); ++y) {
    const double rows = std::min(y1, y + 1.0) - std::max<double>(y0, y);
    for (int x = static_cast<int>(x0); x < std::min<double>(picture.width(), std::ceil(x1)); ++x) {
      const double area = rows * (std::min(x1, x + 1.0) - std::max<double>(x0, x));
      weight += area;
      for (std::size_t channel = 0; channel < sum.size(); ++channel)
        sum[channel] += area * picture(x, y)[channel];
    }
  }
  Rgb mean{};
  for (std::size_t channel = 0; channel < sum.size(); ++channel)
    mean[channel] = static_cast<std::uint8_t>(std::lround(sum[channel] / weight));
  return mean;
}

int scaled_width(const Image<Rgb>& picture, int height_px) {
  return std::max(1, picture.width() * height_px / picture.height());
}

void draw_scaled(const Image<Rgb>& picture, int left, int top, int height_px, Image<Rgb>& sheet) {
  const int width_px = scaled_width(picture, height_px);
  const double across = static_cast<double>(picture.width()) / width_px;
  const double down = static_cast<double>(picture.height()) / height_px;
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      sheet(left + x, top + y) =
          area_mean(picture, x * across, (x + 1) * across, y * down, (y + 1) * down);
    }
  }
}

}  // namespace

Image<Rgb> contact_sheet(const std::vector<std::vector<Image<Rgb>>>& rows,
                         int row_height_px,
                         int gap_px) {
  int width = 0;
  for (const auto& row : rows) {
    int row_width = gap_px;
    for (const auto& picture : row) {
      require(!picture.empty(), "a picture of the contact sheet is empty");
      row_width += scaled_width(picture, row_height_px) + gap_px;
    }
    width = std::max(width, row_width);
  }
  require(width > gap_px, "a contact sheet needs at least one picture");
  const int height = gap_px + static_cast<int>(rows.size()) * (row_height_px + gap_px);
  Image<Rgb> sheet(width, height, Rgb{255, 255, 255});
  int top = gap_px;
  for (const auto& row : rows) {
    int left = gap_px;
    for (const auto& picture : row) {
      draw_scaled(picture, left, top, row_height_px, sheet);
      left += scaled_width(picture, row_height_px) + gap_px;
    }
    top += row_height_px + gap_px;
  }
  return sheet;
}

Image<Rgb> crop_to_content(const Image<Rgb>& picture, int margin_px) {
  constexpr int kDark = 12;
  int left = picture.width();
  int right = -1;
  int top = picture.height();
  int bottom = -1;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (*std::max_element(picture(x, y).begin(), picture(x, y).end()) <= kDark) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  if (right < left) return picture;
  left = std::max(0, left - margin_px);
  top = std::max(0, top - margin_px);
  right = std::min(picture.width() - 1, right + margin_px);
  bottom = std::min(picture.height() - 1, bottom + margin_px);
  Image<Rgb> out(right - left + 1, bottom - top + 1);
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x)
      out(x - left, y - top) = picture(x, y);
  }
  return out;
}

}  // namespace frangia
