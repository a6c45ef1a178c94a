#include "frangia/exchange/internal/storage_formats.h"

#include <algorithm>
#include <optional>
#include <vector>

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

// OpenCV's own reader of XML follows broken pointers in damaged files (4.6), so Expat reads them.
#include <charconv>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/xml_parser.h"

namespace frangia {
namespace {

constexpr std::size_t kMaxXmlDepth = 64;       // a calibration has four levels
constexpr std::size_t kMaxXmlValues = 10'000;  // a calibration has twenty
constexpr std::size_t kMaxXmlNumbers = 1000;   // of a matrix that is kept
constexpr std::string_view kBlank = " \t\r\n";
constexpr std::string_view kBetween = " \t\r\n,;";  // numbers

/// The numbers of a text; nothing when it holds something else.
std::optional<Eigen::MatrixXd> numbers_of(std::string_view text) {
  std::vector<double> numbers;
  for (std::size_t at = text.find_first_not_of(kBetween); at != std::string_view::npos;
       at = text.find_first_not_of(kBetween, at)) {
    const std::string_view word = text.substr(at, text.find_first_of(kBetween, at) - at);
    double number = 0.0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (fault != std::errc() || end != word.data() + word.size()) return std::nullopt;
    if (numbers.size() == kMaxXmlNumbers) return std::nullopt;
    numbers.push_back(number);
    at += word.size();
  }
  if (numbers.empty()) return std::nullopt;
  return Eigen::Map<const Eigen::RowVectorXd>(numbers.data(),
                                              static_cast<Eigen::Index>(numbers.size()));
}

std::string text_of(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(kBlank) - first + 1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
    text = text.substr(1, text.size() - 2);
  return std::string(text);
}

/// A whole number of a field; 0 when it is something else.
Eigen::Index whole_number_of(std::string_view text) {
  const std::string word = text_of(text);
  int number = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), number);
  return fault == std::errc() && end == word.data() + word.size() ? number : 0;
}

/// Collects the values below <opencv_storage>.
class StorageElements {
 public:
  void begin(std::string_view name, const XmlAttributes& attributes) {
    if (path_.empty()) is_storage_ = name == "opencv_storage";
    if (path_.size() == kMaxXmlDepth) {
      throw Error(ErrorKind::Input,
                  fmt::format("its elements are nested more than {} deep; it is no calibration",
                              kMaxXmlDepth));
    }
    path_.emplace_back(name);
    text_.clear();
    // A lens model may be stated beside its numbers: <Camera model="fisheye">.
    for (const char* key :
         {"model", "type", "projection", "distortion", "distortion_model", "fisheye"}) {
      const std::string_view value = attributes.value(key);
      if (!value.empty())
        values.texts.emplace(fmt::format("{}.{}", name_of_element(), key), std::string(value));
    }
    if (path_.size() == 2) fields_.clear();
    if (!is_storage_ && values.matrices.size() + values.texts.size() > kMaxXmlValues) {
      throw Error(ErrorKind::Input,
                  fmt::format("it holds more than {} values; it is no calibration", kMaxXmlValues));
    }
  }

  void text(std::string_view piece) { text_ += piece; }

  void end() {
    if (!is_storage_) {
      fields_.clear();
      add_value(name_of_element());
      path_.pop_back();
      text_.clear();
      return;
    }
    if (path_.size() == 3) fields_.emplace(path_.back(), std::move(text_));
    if (path_.size() == 2) add_value(path_.back());
    path_.pop_back();
    text_.clear();
  }

  NamedValues values;

 private:
  /// "Camera.Matrix" of <Calibration><Camera><Matrix>, whatever is around it.
  [[nodiscard]] std::string name_of_element() const {
    std::size_t first = path_.size() == 1 ? 0 : 1;
    for (std::size_t i = 0; i < path_.size(); ++i) {
      if (path_[i] == "Camera" || path_[i] == "Projector") first = i;
      if (path_[i] == "Calibration" && i + 1 < path_.size()) first = i + 1;
    }
    std::string name;
    for (std::size_t i = first; i < path_.size(); ++i)
      name += (name.empty() ? "" : ".") + path_[i];
    return name.size() > kMaxNameBytes ? name.substr(0, kMaxNameBytes) : name;
  }

  void add_value(const std::string& name) {
    if (!fields_.empty()) {
      const auto list = numbers_of(fields_["data"]);
      if (!list) return;
      Eigen::MatrixXd matrix =
          rows_of_list(*list, whole_number_of(fields_["rows"]), whole_number_of(fields_["cols"]));
      if (matrix.size() > 0) values.matrices.emplace(name, std::move(matrix));
    } else if (auto list = numbers_of(text_)) {
      values.matrices.emplace(name, std::move(*list));
    } else if (std::string text = text_of(text_); !text.empty()) {
      values.texts.emplace(name, std::move(text));
    }
  }

  bool is_storage_ = true;                     ///< whether FileStorage wrote it
  std::vector<std::string> path_;              ///< names of the open elements
  std::string text_;                           ///< since the last tag
  std::map<std::string, std::string> fields_;  ///< texts of the elements inside of a value
};

}  // namespace

NamedValues read_opencv_xml(std::string_view text) {
  StorageElements storage;
  XmlParser elements([&](std::string_view name,
                         const XmlAttributes& attributes) { storage.begin(name, attributes); },
                     [&](std::string_view) { storage.end(); },
                     [&](std::string_view piece) { storage.text(piece); });
  elements.feed(text);
  elements.finish();
  return std::move(storage.values);
}

}  // namespace frangia
