#pragma once

#include <string>
#include <vector>

namespace frangia {

/// A column of a text table.
struct TextColumn {
  std::string title;                ///< with the unit of the values
  std::vector<std::string> values;  ///< one for each row
  bool numbers = true;              ///< aligned right; words are aligned left
};

/// Lays out columns under their titles, with two spaces between them and none at the end of a line.
/// Values are printed as `terminal_text` returns them.
///
/// @shape    columns of the same length
[[nodiscard]] std::string text_table(std::vector<TextColumn> columns);

}  // namespace frangia
