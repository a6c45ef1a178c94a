#pragma once

#include <string_view>

#include "frangia/exchange/internal/named_values.h"

namespace frangia {

/// Reads the text of an .xml of OpenCV's FileStorage. Elements inside of structures other than
/// matrices are skipped. Of another .xml, each element that holds numbers or a text is a value; its
/// name is joined of those of its elements by dots, without the outermost one unless it is Camera
/// or Projector.
///
/// @errors   Error(Input) without the name of the file
[[nodiscard]] NamedValues read_opencv_xml(std::string_view text);

}  // namespace frangia
