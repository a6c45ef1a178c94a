#include <algorithm>
#include <optional>
#include <vector>

#include "frangia/exchange/internal/storage_formats.h"

namespace frangia {
namespace {

/// Opened less closed brackets of a line, outside of quotes and comments.
int open_brackets(std::string_view line) {
  int open = 0;
  char quote = '\0';
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char letter = line[i];
    if (quote != '\0') {
      if (letter == quote) quote = '\0';
    } else if (letter == '"' || letter == '\'') {
      quote = letter;
    } else if (letter == '#' && (i == 0 || line[i - 1] == ' ')) {
      break;
    } else {
      open += letter == '[' || letter == '{' ? 1 : letter == ']' || letter == '}' ? -1 : 0;
    }
  }
  return open;
}

std::string_view trimmed(std::string_view line) {
  const std::size_t end = line.find_last_not_of(" \r");
  return line.substr(0, end == std::string_view::npos ? 0 : end + 1);
}

std::string_view without_comment(std::string_view line) {
  const std::size_t comment = line.find(" #");
  return trimmed(line.substr(0, comment));
}

/// The lines, with blanks for the tabs in front and a list of several lines as one.
std::vector<std::string> joined_lines(std::string_view text) {
  std::vector<std::string> lines;
  int open = 0;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    std::string line(trimmed(text.substr(start, end - start)));
    start = end + 1;
    const std::size_t content = std::min(line.find_first_not_of(" \t"), line.size());
    std::replace(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(content), '\t', ' ');
    const int more = open_brackets(line);
    if (open > 0) {
      lines.back() += " " + std::string(without_comment(line.substr(content)));
    } else {
      lines.push_back(more > 0 ? std::string(without_comment(line)) : line);
    }
    open = std::max(open + more, 0);
  }
  return lines;
}

/// "name": as name:, where the name needs no quotes.
std::string without_quotes(const std::string& line) {
  const std::size_t begin = std::min(line.find_first_not_of(" -"), line.size());
  if (begin == line.size() || (line[begin] != '"' && line[begin] != '\'')) return line;
  const std::size_t end = line.find(line[begin], begin + 1);
  if (end == std::string::npos || line.substr(end + 1, 1) != ":") return line;
  const std::string name = line.substr(begin + 1, end - begin - 1);
  if (name.empty() || name.find_first_of(":#{}[],&*!|>%@`") != std::string::npos) return line;
  return line.substr(0, begin) + name + line.substr(end + 1);
}

bool is_number(std::string_view word) {
  constexpr std::string_view kLetters = "0123456789+-.eEnNaAiIfF";
  return word.find_first_not_of(kLetters) == std::string_view::npos;
}

bool is_list_of_numbers(std::string_view word) {
  constexpr std::string_view kLetters = "0123456789+-.eEnNaAiIfF[], \t";
  return word.starts_with('[') && word.ends_with(']') && open_brackets(word) == 0 &&
         word.find_first_not_of(kLetters) == std::string_view::npos;
}

/// A list that is written item by item, "- 1.0", with lists inside: "- - 1.0", "- [1.0, 0.0]".
class ItemList {
 public:
  /// Takes a line; false where it is no item of numbers.
  bool add(std::string_view line) {
    std::string text = text_;
    std::vector<std::size_t> columns = columns_;
    std::size_t at = std::min(line.find_first_not_of(' '), line.size());
    bool is_item = false;
    while (at < line.size() && line[at] == '-' && (at + 1 == line.size() || line[at + 1] == ' ')) {
      for (; !columns.empty() && columns.back() > at; columns.pop_back())
        text += "]";
      if (!columns.empty() && columns.back() == at) {
        text += ", ";
      } else {
        text += "[";
        columns.push_back(at);
      }
      is_item = true;
      at = std::min(line.find_first_not_of(' ', at + 1), line.size());
    }
    const std::string_view value = without_comment(line.substr(at));
    if (!is_item || !(is_number(value) || is_list_of_numbers(value))) return false;
    text_ = text.append(value);
    columns_ = std::move(columns);
    return true;
  }

  [[nodiscard]] std::string text() const { return text_ + std::string(columns_.size(), ']'); }

 private:
  std::string text_;
  std::vector<std::size_t> columns_;  ///< of the dashes of the open lists
};

/// The list that begins at a line; its text, and the number of its lines.
std::optional<std::pair<std::string, std::size_t>> list_at(const std::vector<std::string>& lines,
                                                           std::size_t first) {
  ItemList list;
  std::size_t count = 0;
  while (first + count < lines.size() && list.add(lines[first + count]))
    ++count;
  if (count == 0) return std::nullopt;
  return std::pair(list.text(), count);
}

}  // namespace

std::string storage_yaml(std::string_view text) {
  std::string result = "%YAML:1.0\n---\n";
  const std::vector<std::string> lines = joined_lines(text);
  for (std::size_t i = 0; i < lines.size();) {
    const std::string& line = lines[i];
    if (line.starts_with('%') || line == "---" || line == "...") {
      ++i;
    } else if (const auto list = list_at(lines, i)) {
      result.resize(result.find_last_not_of(" \n") + 1);
      result += " " + list->first + "\n";
      i += list->second;
    } else {
      result += without_quotes(line) + "\n";
      ++i;
    }
  }
  return result;
}

}  // namespace frangia
