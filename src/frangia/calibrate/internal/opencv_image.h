#pragma once

#include <opencv2/core.hpp>

#include "frangia/core/image.h"

namespace frangia {

/// The image as OpenCV has it, without a copy. OpenCV must only read it.
[[nodiscard]] cv::Mat opencv_view(const Image<float>& counts);

/// 8 bits with the contrast equalized locally, so that shadows and vignetting do not matter.
///
/// @source   contrast-limited adaptive histogram equalization, Zuiderveld 1994; OpenCV
[[nodiscard]] cv::Mat equalized(const cv::Mat& counts);

}  // namespace frangia
