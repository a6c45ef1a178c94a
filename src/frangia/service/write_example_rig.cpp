#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/error.h"
#include "frangia/core/write_text_file.h"
#include "frangia/service/example_rigs.h"
#include "frangia/service/simulated_rig.h"

namespace frangia {
namespace {

const ExampleRig* find_example(const std::string& name) {
  const auto& all = example_rigs();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const ExampleRig& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

std::string description_of(const ExampleRig& rig) {
  std::istringstream lines(rig.text);
  std::string paragraph;
  for (std::string line; std::getline(lines, line) && line.starts_with("#");) {
    const std::size_t begin = line.find_first_not_of("# ");
    if (begin == std::string::npos) continue;
    if (!paragraph.empty()) paragraph += ' ';
    paragraph.append(line, begin);
  }
  return paragraph;
}

void write_example_rig(const std::filesystem::path& path, const std::string& name) {
  const ExampleRig* example = find_example(name);
  if (example == nullptr) {
    std::vector<std::string> names;
    for (const ExampleRig& one : example_rigs())
      names.push_back(one.name);
    throw Error(
        ErrorKind::Input,
        fmt::format("there is no example '{}'; choose one of {}", name, fmt::join(names, ", ")));
  }
  std::string text = example->text;
  const std::filesystem::path truth = true_rig_beside(path);
  for (const ExampleRig& other : example_rigs()) {
    const std::string named = fmt::format("true_rig = \"{}.toml\"", other.name);
    const std::size_t at = text.find(named);
    if (at == std::string::npos) continue;
    text.replace(at, named.size(), fmt::format("true_rig = \"{}\"", truth.filename().string()));
    write_text_file(truth, other.text);
  }
  write_text_file(path, text);
}

}  // namespace frangia
