#include "frangia/simulate/internal/fault_script.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace frangia {

FaultScript::FaultScript(const std::vector<std::string>& lines) {
  for (const std::string& text : lines) {
    std::istringstream stream(text);
    Line line;
    for (std::string word; stream >> word;)
      line.words.push_back(word);
    line.always = !line.words.empty() && line.words.back() == "always";
    if (line.always) line.words.pop_back();
    if (!line.words.empty()) lines_.push_back(line);
  }
}

bool FaultScript::triggers(const std::vector<std::string>& words) {
  const Line* line = find(words);
  return line != nullptr && (line->always || triggered_.insert(words).second);
}

bool FaultScript::matches(const std::vector<std::string>& words) const {
  return find(words) != nullptr;
}

std::vector<std::string> FaultScript::kinds() const {
  std::vector<std::string> kinds;
  for (const Line& line : lines_)
    kinds.push_back(line.words.front());
  return kinds;
}

const FaultScript::Line* FaultScript::find(const std::vector<std::string>& words) const {
  const auto found = std::find_if(lines_.begin(), lines_.end(), [&](const Line& line) {
    return line.words.size() <= words.size() &&
           std::equal(line.words.begin(), line.words.end(), words.begin());
  });
  return found == lines_.end() ? nullptr : &*found;
}

FaultScript read_faults(DeviceSettings& settings, const std::vector<std::string>& known) {
  FaultScript script(settings.texts_or("faults", {}));
  for (const std::string& kind : script.kinds()) {
    if (std::find(known.begin(), known.end(), kind) != known.end()) continue;
    settings.fail(
        "faults",
        fmt::format("holds \"{}\"; each must begin with one of {}", kind, fmt::join(known, ", ")));
  }
  return script;
}

}  // namespace frangia
