#include "alike_lines.h"

#include <cstddef>
#include <map>
#include <regex>
#include <string_view>

#include <fmt/format.h>

namespace frangia {
namespace {

/// A line about one view: "warning: VIEW: SENTENCE".
struct LineOfView {
  std::string head;      ///< with the view
  std::string sentence;  ///< behind it
};

LineOfView parts_of(const std::string& line) {
  constexpr std::string_view kWarning = "warning: ";
  const std::size_t from = line.starts_with(kWarning) ? kWarning.size() : 0;
  const std::size_t colon = line.find(": ", from);
  if (colon == std::string::npos) return {{}, line};
  return {line.substr(0, colon), line.substr(colon)};
}

}  // namespace

std::vector<std::string> with_alike_put_together(const std::vector<std::string>& lines) {
  constexpr std::size_t kFewest = 3;
  static const std::regex kNumber(R"(-?[0-9][0-9.]*(e[+-]?[0-9]+|\^[0-9]+)?)");
  std::map<std::string, std::vector<std::size_t>> alike;  // by what is left without the numbers
  std::vector<std::string> keys;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const LineOfView parts = parts_of(lines[i]);
    const std::string what = std::regex_replace(parts.sentence, kNumber, "#");
    // Lines without a view differ by what they say alone.
    keys.push_back(parts.head.empty() ? lines[i] : "\n" + what);
    alike[keys.back()].push_back(i);
  }
  std::vector<std::string> out;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::vector<std::size_t>& all = alike.at(keys[i]);
    const LineOfView parts = parts_of(lines[i]);
    if (parts.head.empty() || all.size() < kFewest) {
      out.push_back(lines[i]);
    } else if (all.front() == i) {
      out.push_back(fmt::format(
          "{}, and {} more alike (--verbose){}", parts.head, all.size() - 1, parts.sentence));
    }
  }
  return out;
}

}  // namespace frangia
