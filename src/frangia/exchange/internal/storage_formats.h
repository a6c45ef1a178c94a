#pragma once

#include <string>
#include <string_view>

#include "frangia/exchange/internal/named_values.h"

// The two formats of OpenCV's FileStorage, before OpenCV sees them.

namespace frangia {

/// Reads the text of an .xml of OpenCV's FileStorage. Elements inside of structures other than
/// matrices are skipped. Of another .xml, each element that holds numbers or a text is a value; its
/// name is joined of those of its elements by dots, without the outermost one unless it is Camera
/// or Projector.
///
/// @errors   Error(Input) without the name of the file
[[nodiscard]] NamedValues read_opencv_xml(std::string_view text);

/// YAML as people and programs write it, as OpenCV's FileStorage takes it: lists of numbers that
/// stand in lines of their own, and lists of several lines, in brackets on one line; names without
/// quotes; tabs as blanks; with its own directive and without the mark of the end.
[[nodiscard]] std::string storage_yaml(std::string_view text);

}  // namespace frangia
