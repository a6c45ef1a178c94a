#pragma once

#include <opencv2/core.hpp>

namespace frangia {

/// Refines the place where four squares meet in evened light, in a window of 2 `reach` + 1 pixels
/// along both sides. It stays where it is when it would move by more than a pixel.
///
/// @units    pixels, (0, 0) at the center of the top-left one
/// @source   OpenCV's cornerSubPix: Foerstner's corner
[[nodiscard]] cv::Point2f refine_corner(const cv::Mat& counts,
                                        const cv::Point2f& corner,
                                        int reach);

}  // namespace frangia
