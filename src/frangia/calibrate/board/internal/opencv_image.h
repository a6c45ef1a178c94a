#pragma once

#include <opencv2/core.hpp>

#include "frangia/core/image.h"

namespace frangia {

/// The image as OpenCV has it, without a copy. OpenCV must only read it.
[[nodiscard]] cv::Mat opencv_view(const Image<float>& counts);

/// 8 bits with the gamma of a display, so that dark squares keep some levels.
[[nodiscard]] cv::Mat display_bytes(const cv::Mat& counts);

/// `display_bytes` with the contrast equalized locally. It recovers boards in shadow, but amplifies
/// the noise of a dark background, in which a board that is easy to see may be lost.
///
/// @source   contrast-limited adaptive histogram equalization, Zuiderveld 1994; OpenCV
[[nodiscard]] cv::Mat equalized(const cv::Mat& counts);

/// A part of an image whose white is equally bright everywhere.
struct EvenedWindow {
  cv::Mat counts;    ///< 32 bits; empty where nothing bright was found
  cv::Point origin;  ///< of the part in the image
};

/// Divides a square part of an image by a plane that is fitted to its bright pixels.
///
/// Light that falls off across the board adds a gradient to white squares and none to black ones,
/// which moves corners and centers that gradients determine: by 0.02 px where it changes by 0.4 % a
/// pixel.
///
/// @shape    2 `half` + 1 pixels along both sides, less what is outside of the image
[[nodiscard]] EvenedWindow even_light(const cv::Mat& counts,
                                      const cv::Point& center,
                                      const cv::Size& half);

/// Refines the place where four squares meet in evened light, in a window of 2 `reach` + 1 pixels
/// along both sides. It stays where it is when it would move by more than a pixel.
///
/// @units    pixels, (0, 0) at the center of the top-left one
/// @source   OpenCV's cornerSubPix: Foerstner's corner
[[nodiscard]] cv::Point2f refine_corner(const cv::Mat& counts,
                                        const cv::Point2f& corner,
                                        int reach);

}  // namespace frangia
