#include "frangia/acquisition/internal/first_difference.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <vector>

#include <fmt/format.h>

namespace frangia {
namespace {

/// The lines of a text, each after its header and the header's number.
std::vector<std::string> lines_with_headers(const std::string& text) {
  std::vector<std::string> lines;
  std::map<std::string, int> counts;
  std::string prefix;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.empty()) continue;
    if (line.front() == '[') {
      const int number = ++counts[line];
      prefix = line.starts_with("[[") ? fmt::format("{} {}: ", line, number) : line + ": ";
    } else {
      lines.push_back(prefix + line);
    }
  }
  return lines;
}

/// The first of `lines` that `others` lack; empty without any.
std::string first_only_in(const std::vector<std::string>& lines,
                          const std::vector<std::string>& others) {
  const auto found = std::find_if(lines.begin(), lines.end(), [&](const std::string& line) {
    return std::find(others.begin(), others.end(), line) == others.end();
  });
  return found == lines.end() ? std::string() : *found;
}

}  // namespace

std::string first_difference(const std::string& before, const std::string& now) {
  const std::vector<std::string> old_lines = lines_with_headers(before);
  const std::vector<std::string> new_lines = lines_with_headers(now);
  const std::string had = first_only_in(old_lines, new_lines);
  const std::string has = first_only_in(new_lines, old_lines);
  if (had.empty() && has.empty()) return "has its lines in another order";
  if (had.empty()) return fmt::format("now has \"{}\"", has);
  if (has.empty()) return fmt::format("had \"{}\"", had);
  return fmt::format("had \"{}\" and now has \"{}\"", had, has);
}

}  // namespace frangia
