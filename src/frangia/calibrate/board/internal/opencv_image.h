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

}  // namespace frangia
