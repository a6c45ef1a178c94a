#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frangia/core/image.h"
#include "frangia/frames/color_map.h"
#include "frangia/frames/png.h"
#include "frangia/report/picture_labels.h"
#include "frangia/uncertainty/conformity.h"

namespace frangia {

/// What the colors of a picture mean.
struct PictureScale {
  std::string quantity;                    ///< with its unit: "deviation, mm"
  double low = 0.0;                        ///< value of the first color
  double high = 1.0;                       ///< value of the last color
  ColorMap color_map = ColorMap::Viridis;  ///< of the values
  std::optional<ToleranceLimits> limits;   ///< marked on the scale
};

/// A picture and what it shows.
struct ReportPicture {
  std::string caption;                ///< below the picture
  Image<Rgb> picture;                 ///< `kReportPictureWidth_px` wide, without a legend
  std::vector<PictureLabel> labels;   ///< of places in it, the most important first
  std::optional<PictureScale> scale;  ///< none: the colors mean nothing
};

/// Width and height of the pictures of a report.
inline constexpr int kReportPictureWidth_px = 720;
inline constexpr int kReportPictureHeight_px = 440;  ///< see `kReportPictureWidth_px`
/// Width of the columns of labels beside a picture.
inline constexpr double kLabelColumn_px = 170.0;

/// A picture with its labels, leader lines and scale, as HTML.
[[nodiscard]] std::string labelled_picture(const ReportPicture& picture);

}  // namespace frangia
