#include "text_table.h"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "terminal_text.h"

namespace frangia {
namespace {

std::size_t width_of(const TextColumn& column) {
  std::size_t width = column.title.size();
  for (const std::string& value : column.values)
    width = std::max(width, value.size());
  return width;
}

void add_cell(std::string& line, bool numbers, const std::string& value, std::size_t width) {
  line += line.empty() ? "" : "  ";
  line += numbers ? fmt::format("{:>{}}", value, width) : fmt::format("{:<{}}", value, width);
}

std::string without_spaces_at_end(const std::string& line) {
  return line.substr(0, line.find_last_not_of(' ') + 1);
}

}  // namespace

std::string text_table(std::vector<TextColumn> columns) {
  std::string titles;
  std::vector<std::size_t> widths;
  for (TextColumn& column : columns) {
    for (std::string& value : column.values)
      value = terminal_text(value);
    widths.push_back(width_of(column));
    add_cell(titles, column.numbers, column.title, widths.back());
  }
  std::string text = without_spaces_at_end(titles) + '\n';
  const std::size_t rows = columns.empty() ? 0 : columns.front().values.size();
  for (std::size_t row = 0; row < rows; ++row) {
    std::string line;
    for (std::size_t i = 0; i < columns.size(); ++i)
      add_cell(line, columns[i].numbers, columns[i].values[row], widths[i]);
    text += without_spaces_at_end(line) + '\n';
  }
  return text;
}

}  // namespace frangia
