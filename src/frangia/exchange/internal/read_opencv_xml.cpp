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
#include "frangia/exchange/internal/storage_formats.h"

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
