#pragma once

#include <string_view>

#include "frangia/exchange/internal/named_values.h"

namespace frangia {

/// Reads the text of an .xml of OpenCV's FileStorage. Elements inside of structures other than
/// matrices are skipped.
///
/// @errors   Error(Input) without the name of the file
[[nodiscard]] NamedValues read_opencv_xml(std::string_view text);

}  // namespace frangia
