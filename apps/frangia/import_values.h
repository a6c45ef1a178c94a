#pragma once

#include <string>
#include <vector>

#include "frangia/dataset/import_frames.h"

namespace frangia {

/// Reads values of patterns: "64", or "fine=64" for the pattern "fine". `option` is for messages.
///
/// @errors   Error(Input) that names the option and the text
[[nodiscard]] std::vector<PatternValue> values_of(const std::vector<std::string>& texts,
                                                  const char* option);

/// Reads the size of a projector: "1280x800".
///
/// @errors   Error(Input) that names the text
[[nodiscard]] ProjectorSize projector_size_of(const std::string& text);

}  // namespace frangia
