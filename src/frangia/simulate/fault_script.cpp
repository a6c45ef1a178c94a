#include "frangia/simulate/fault_script.h"

#include <algorithm>
#include <sstream>

namespace frangia {

FaultScript::FaultScript(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;)
      words.push_back(word);
    if (!words.empty()) lines_.push_back(words);
  }
}

bool FaultScript::holds(const std::vector<std::string>& words) const {
  return std::any_of(lines_.begin(), lines_.end(), [&](const auto& line) {
    return line.size() <= words.size() && std::equal(line.begin(), line.end(), words.begin());
  });
}

std::vector<std::string> FaultScript::kinds() const {
  std::vector<std::string> kinds;
  for (const auto& line : lines_)
    kinds.push_back(line.front());
  return kinds;
}

}  // namespace frangia
