#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/uncertainty/conformity.h"

namespace frangia {

/// A label of a place in a picture.
struct PictureLabel {
  std::string text;    ///< value and uncertainty, such as "+0.153 ± 0.021 mm"
  std::string detail;  ///< what it is: "largest", or the name of a characteristic
  Conformity conformity = Conformity::Undecided;    ///< its color
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

}  // namespace frangia
