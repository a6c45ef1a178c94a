#include "text_table.h"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

namespace frangia {
namespace {

std::size_t width_of(const TextColumn& column) {
  std::size_t width = column.title.size();
  for (const std::string& value : column.values)
    width = std::max(width, value.size());
  return width;
}

void add_cell(std::string& line, const TextColumn& column, const std::string& value) {
  const std::size_t width = width_of(column);
  line += line.empty() ? "" : "  ";
  line +=
      column.numbers ? fmt::format("{:>{}}", value, width) : fmt::format("{:<{}}", value, width);
}

std::string without_spaces_at_end(const std::string& line) {
  return line.substr(0, line.find_last_not_of(' ') + 1);
}

}  // namespace

std::string text_table(const std::vector<TextColumn>& columns) {
  std::string titles;
  for (const TextColumn& column : columns)
    add_cell(titles, column, column.title);
  std::string text = without_spaces_at_end(titles) + '\n';
  const std::size_t rows = columns.empty() ? 0 : columns.front().values.size();
  for (std::size_t row = 0; row < rows; ++row) {
    std::string line;
    for (const TextColumn& column : columns)
      add_cell(line, column, column.values[row]);
    text += without_spaces_at_end(line) + '\n';
  }
  return text;
}

}  // namespace frangia
