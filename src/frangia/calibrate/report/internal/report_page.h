#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "frangia/calibrate/report/residual_maps.h"
#include "frangia/core/image.h"

namespace frangia {

/// The beginning of a page that stands alone, up to the body.
[[nodiscard]] std::string report_head();

/// A grey picture for the attribute href of an image.
[[nodiscard]] std::string picture_data(const Image<std::uint8_t>& picture);

/// Color of an error relative to a large one: green, yellow, red.
[[nodiscard]] std::string color_of(double share);

/// Arrows of all residuals over an image, as a figure with a caption.
[[nodiscard]] std::string residual_figure(const ResidualMap& map);

/// Writes a page that `report_head` began.
///
/// @errors   Error(File) when the file cannot be written
void write_report(const std::filesystem::path& path, const std::string& html);

}  // namespace frangia
