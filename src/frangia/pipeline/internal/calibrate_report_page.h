#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"

namespace frangia {

/// The beginning of a page that stands alone, up to the body.
[[nodiscard]] std::string report_head();

/// A grey picture for the attribute href of an image.
[[nodiscard]] std::string picture_data(const Image<std::uint8_t>& picture);

/// Color of an error relative to a large one: green, yellow, red.
[[nodiscard]] std::string color_of(double share);

/// A residual at a place of an image.
struct ResidualArrow {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();  ///< in the unit of the map
};

/// What a map of residuals shows.
struct ResidualMap {
  std::string title;  ///< of the caption
  int width = 0;      ///< of the image, px
  int height = 0;
  double rms = 0.0;         ///< of all residuals
  const char* unit = "px";  ///< of the residuals
  std::vector<ResidualArrow> arrows;
};

/// Arrows of all residuals over an image, as a figure with a caption.
[[nodiscard]] std::string residual_figure(const ResidualMap& map);

/// Writes a page that `report_head` began.
///
/// @errors   Error(File) when the file cannot be written
void write_report(const std::filesystem::path& path, const std::string& html);

}  // namespace frangia
