#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "frangia/pattern/pattern.h"

namespace frangia {

/// Width and height of a projector in its pixels.
using ProjectorSize = std::array<int, 2>;

/// The patterns that another program projects, and which of its images show them.
struct ImportLayout {
  std::vector<Pattern> patterns;  ///< in the order of projection
  /// Pattern and frame of each image, in the order of their numbers; empty: an image that a scan
  /// does not hold.
  std::vector<std::optional<std::pair<std::size_t, std::size_t>>> images;
};

/// A program whose sequences are known.
struct KnownLayout {
  std::string_view name;     ///< as the user types it
  std::string_view names;    ///< template of the file names
  std::string_view meaning;  ///< the sequence in words
};

/// The layouts, by their names.
///
/// @source   OpenCV contrib, structured_light: graycodepattern.cpp and samples/cap_pattern.cpp;
///           scan3d-capture (Moreno and Taubin): ProjectorWidget.cpp, CaptureDialog.cpp,
///           structured_light.cpp; 3DUNDERWORLD-SLS: GrayCode.cpp, FileReader.cpp; SLStudio:
///           CodecGrayCode.cpp, CodecPhaseShift3.cpp, CodecPhaseShift2x3.cpp, pstools.cpp,
///           SLScanWorker.cpp
[[nodiscard]] const std::vector<KnownLayout>& known_layouts();

/// Returns the layout with a name; nullptr for an unknown one.
[[nodiscard]] const KnownLayout* find_layout(std::string_view name);

/// Returns the sequence of a layout for a projector.
///
/// @errors   Error(Input) that names the layout when the number of images does not fit it, with the
///           number that would
[[nodiscard]] ImportLayout make_layout(const KnownLayout& layout,
                                       std::size_t images,
                                       const ProjectorSize& projector_px);

}  // namespace frangia
