#pragma once

#include <string>
#include <string_view>

namespace frangia {

/// YAML as people and programs write it, as OpenCV's FileStorage takes it: lists of numbers that
/// stand in lines of their own, and lists of several lines, in brackets on one line; names without
/// quotes; tabs as blanks; with its own directive and without the mark of the end.
[[nodiscard]] std::string storage_yaml(std::string_view text);

}  // namespace frangia
