#pragma once

#include <cstdio>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json_fwd.hpp>

#include "terminal_text.h"

namespace frangia {

/// Writes a text to standard output as it is.
///
/// @errors   Error(File) when standard output cannot be written
void write_output(std::string_view text);

/// Writes what is buffered for standard output. The program ends with it.
///
/// @errors   Error(File) when standard output could not be written, now or before
void flush_output();

/// Prints JSON to standard output, in ASCII. Bytes that are not UTF-8, such as those in the name
/// of a file, become the replacement character.
///
/// @errors   as write_output
void print_json(const nlohmann::ordered_json& json);

/// A value as `print_text` formats it: text as `terminal_text` returns it, other values as they
/// are.
template <typename T>
[[nodiscard]] decltype(auto) terminal_value(const T& value) {
  if constexpr (std::is_convertible_v<const T&, std::string_view>) {
    return terminal_text(value);
  } else {
    return (value);
  }
}

/// Prints to standard output as fmt::print does. Text in the arguments cannot begin a new line or
/// control the terminal.
///
/// @errors   as write_output
template <typename... Args>
void print_text(fmt::format_string<decltype(terminal_value(std::declval<const Args&>()))...> format,
                const Args&... arguments) {
  write_output(fmt::format(format, terminal_value(arguments)...));
}

}  // namespace frangia
