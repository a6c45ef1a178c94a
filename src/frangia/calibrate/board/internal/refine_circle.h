#pragma once

#include <opencv2/core.hpp>

namespace frangia {

/// Refines the center of the ellipse that a dark circle on a bright ground shows. `along` and
/// `across` are the steps to the next circles; the ground half way to them belongs to the circle.
/// It stays where it is when it would move by more than a tenth of a step.
///
/// @units    pixels, (0, 0) at the center of the top-left one
/// @source   Ouellet & Hebert 2009, Precise ellipse estimation without contour point extraction:
///           the dual conic to which the gradient lines of all pixels are tangent
[[nodiscard]] cv::Point2f refine_circle(const cv::Mat& counts,
                                        const cv::Point2f& center,
                                        const cv::Point2f& along,
                                        const cv::Point2f& across);

}  // namespace frangia
