#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace frangia {

/// The text of a file as the readers take it: without a byte order mark, UTF-16 with or without one
/// as UTF-8 where it is ASCII ('?' for other letters), line ends of old Macs (CR alone) as LF, and
/// without zeros and Ctrl-Z at the end, as programs that write whole blocks leave them.
[[nodiscard]] std::string plain_text(std::string bytes);

/// Whether a file begins as text in UTF-16.
[[nodiscard]] bool is_utf16(std::string_view bytes);

/// A text for HTML and SVG: the characters that have a meaning there are replaced by entities.
[[nodiscard]] std::string html_escaped(std::string_view text);

/// A share as percent with two decimals, such as "12.34 %". What is not all or nothing does not
/// read as if it were: "under 0.01 %", "over 99.99 %".
/// @shape  `share` from 0 to 1
[[nodiscard]] inline std::string percent_text(double share) {
  if (share > 0.0 && share < 0.0001) return "under 0.01 %";
  if (share < 1.0 && share > 0.9999) return "over 99.99 %";
  return fmt::format("{:.2f} %", 100.0 * share);
}

/// The extension of a file name in lower case, with its dot: ".stl" for "Part.STL". Empty when the
/// name has no extension.
[[nodiscard]] inline std::string lowercase_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

/// Returns the name that takes the fewest inserted, deleted or replaced letters to become `word`
/// (Levenshtein 1966); of several the first. A name that needs more than a third of the letters of
/// `word` is not near.
///
/// @missing  nullopt: no name is near
[[nodiscard]] std::optional<std::string> nearest_name(std::string_view word,
                                                      const std::vector<std::string>& names);

}  // namespace frangia
