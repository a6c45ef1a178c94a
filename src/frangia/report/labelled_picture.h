#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/frames/map_picture.h"
#include "frangia/frames/png.h"
#include "frangia/inspect/render_mesh.h"
#include "frangia/inspection/inspect_part.h"
#include "frangia/report/report_words.h"
#include "frangia/uncertainty/conformity.h"

namespace frangia {

/// The largest deviation on a color scale, mm: `scale_mm`, or 1.5 times the tolerance where it is
/// 0.
[[nodiscard]] double deviation_scale_mm(double scale_mm, const ToleranceLimits& limits);

/// Options of a picture of the deviations of a mesh, with the tolerance band and the histogram.
/// `scale_mm` is as in `deviation_scale_mm`.
[[nodiscard]] RenderOptions deviation_picture(const Mesh& mesh,
                                              const SurfaceInspection& surface,
                                              double scale_mm = 0.0);

/// Options of a picture of the thickness, with its histogram. The scale ends at `scale_mm`, or
/// where it is 0 a tenth above 95 % of the area.
[[nodiscard]] RenderOptions thickness_picture(const Mesh& mesh,
                                              const MeasuredWalls& walls,
                                              double scale_mm = 0.0);

/// A label of a place in a picture.
struct PictureLabel {
  std::string text;                      ///< value and uncertainty, such as "+0.153 ± 0.021 mm"
  std::string detail;                    ///< what it is: "largest", or the name of a characteristic
  std::optional<Conformity> conformity;  ///< its color; none: has no tolerance
  Eigen::Vector2d at_px = Eigen::Vector2d::Zero();  ///< the place, from the upper left
};

/// The box of a label beside a picture.
struct LabelBox {
  std::size_t label = 0;  ///< index
  bool right = false;     ///< in the column at the right
  double top_px = 0.0;    ///< of the box, from the top of the picture
};

/// Size of the boxes, and the distance that they keep.
struct LabelLayout {
  double height_px = 38.0;  ///< of a box
  double gap_px = 6.0;      ///< between boxes
  std::size_t most = 12;    ///< labels of a picture
};

/// Puts labels into the columns at the left and right of a picture, each as near to the height of
/// its place as the others allow, in the order of their places, so that leader lines do not cross
/// within a column. The first labels are kept where there is no room for all.
///
/// @units    pixels
[[nodiscard]] std::vector<LabelBox> place_labels(const std::vector<PictureLabel>& labels,
                                                 double width_px,
                                                 double height_px,
                                                 const LabelLayout& layout = {});

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
  double azimuth_deg = 0.0;           ///< of the viewer, as in RenderOptions
  double elevation_deg = 0.0;         ///< of the viewer, as in RenderOptions
};

/// Width and height of the pictures of a report.
inline constexpr int kReportPictureWidth_px = 720;
inline constexpr int kReportPictureHeight_px = 440;  ///< see `kReportPictureWidth_px`
/// Width of the columns of labels beside a picture.
inline constexpr double kLabelColumn_px = 170.0;

/// A picture with its labels, leader lines and scale, as HTML.
[[nodiscard]] std::string labelled_picture(const ReportPicture& picture,
                                           const ReportWords& words = ReportWords());

}  // namespace frangia
