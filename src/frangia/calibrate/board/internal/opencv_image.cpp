#include "frangia/calibrate/board/internal/opencv_image.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace frangia {

cv::Mat opencv_view(const Image<float>& counts) {
  return {counts.height(),
          counts.width(),
          CV_32F,
          const_cast<float*>(counts.pixels().data())};  // NOLINT(*-const-cast) it is only read
}

cv::Mat display_bytes(const cv::Mat& counts) {
  double brightest = 0.0;
  cv::minMaxLoc(counts, nullptr, &brightest);
  constexpr double kGamma = 0.6;
  cv::Mat bright;
  cv::pow(cv::max(counts, 0.0) / std::max(brightest, 1.0), kGamma, bright);
  cv::Mat bytes;
  bright.convertTo(bytes, CV_8U, 255.0);
  return bytes;
}

cv::Mat equalized(const cv::Mat& counts) {
  cv::Mat bytes = display_bytes(counts);
  constexpr double kClipLimit = 4.0;
  cv::createCLAHE(kClipLimit, cv::Size(8, 8))->apply(bytes, bytes);
  return bytes;
}

}  // namespace frangia
