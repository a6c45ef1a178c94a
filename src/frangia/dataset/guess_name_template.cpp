#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/dataset/name_template.h"

namespace frangia {
namespace {

/// A text cut at its last number: "p64_", "03", ".bmp".
struct CutText {
  std::string before;
  std::string number;
  std::string after;
};

bool is_decimal(char letter) {
  return letter >= '0' && letter <= '9';
}

CutText cut_at_last_number(const std::string& text) {
  std::size_t end = text.size();
  while (end > 0 && !is_decimal(text[end - 1]))
    --end;
  std::size_t begin = end;
  while (begin > 0 && is_decimal(text[begin - 1]))
    --begin;
  return {text.substr(0, begin), text.substr(begin, end - begin), text.substr(end)};
}

std::string with_doubled_braces(const std::string& text) {
  std::string out;
  for (const char letter : text)
    out += letter == '{' || letter == '}' ? std::string(2, letter) : std::string(1, letter);
  return out;
}

[[noreturn]] void refuse_names(const std::vector<std::string>& names) {
  throw Error(ErrorKind::Input,
              fmt::format("the names of the {} images, such as {}, do not show which frames they "
                          "are; set `names` to a template such as \"{{pattern}}_{{frame:02}}.png\"",
                          names.size(),
                          names.front()));
}

/// "{frame}", or "{frame:02}" where zeros pad the numbers to one width.
std::string number_field(const char* name, const std::vector<CutText>& cuts) {
  const std::size_t width = cuts.front().number.size();
  const bool one_width = std::all_of(
      cuts.begin(), cuts.end(), [&](const CutText& cut) { return cut.number.size() == width; });
  const bool padded = std::any_of(cuts.begin(), cuts.end(), [](const CutText& cut) {
    return cut.number.size() > 1 && cut.number.front() == '0';
  });
  return one_width && padded ? fmt::format("{{{}:0{}}}", name, width) : fmt::format("{{{}}}", name);
}

/// The ending of files that may each hold all frames of a pattern and are called by its name alone,
/// such as coarse.tif and fine.tif; empty for other names.
std::string ending_of_stacks(const std::vector<std::string>& files) {
  std::set<std::string> endings;
  for (const std::string& file : files) {
    const std::size_t dot = std::min(file.rfind('.'), file.size());
    if (!cut_at_last_number(file.substr(0, dot)).number.empty()) return {};
    endings.insert(file.substr(dot));
  }
  if (endings.size() != 1) return {};
  std::string ending;
  for (const char letter : *endings.begin())
    ending += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  const bool has_pages = ending == ".tif" || ending == ".tiff" || ending == ".npy";
  return has_pages ? *endings.begin() : std::string();
}

/// The template of the files of one folder.
std::string template_of_files(const std::vector<std::string>& files,
                              const std::vector<std::string>& names) {
  if (const std::string ending = ending_of_stacks(files); !ending.empty())
    return "{pattern}" + ending;
  std::vector<CutText> cuts;
  std::set<std::string> prefixes;
  for (const std::string& file : files) {
    const std::size_t dot = std::min(file.rfind('.'), file.size());  // raw files may have none
    cuts.push_back(cut_at_last_number(file.substr(0, dot)));
    cuts.back().after += file.substr(dot);
    prefixes.insert(cuts.back().before);
    if (cuts.back().number.empty() || cuts.back().after != cuts.front().after) refuse_names(names);
  }
  const std::string end = number_field("frame", cuts) + with_doubled_braces(cuts.front().after);
  if (prefixes.size() == 1) return with_doubled_braces(*prefixes.begin()) + end;
  // The separator before the number is not part of the pattern's name.
  const std::string& first = *prefixes.begin();
  std::string separator;
  if (!first.empty() && std::string("_-. ").find(first.back()) != std::string::npos) {
    const bool common = std::all_of(prefixes.begin(), prefixes.end(), [&](const std::string& text) {
      return text.size() > 1 && text.back() == first.back();
    });
    if (common) separator = first.substr(first.size() - 1);
  }
  if (prefixes.contains("")) refuse_names(names);
  return "{pattern}" + separator + end;
}

/// Whether a folder is called like a camera: left, right, cam0, camera-b.
bool is_camera_name(const std::string& folder) {
  std::string name;
  for (const char letter : folder)
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return name == "left" || name == "right" || name == "l" || name == "r" || name.starts_with("cam");
}

}  // namespace

std::string guess_name_template(const std::vector<std::string>& names) {
  require(!names.empty(), "there are no images whose names could be guessed");
  std::map<std::string, std::vector<std::string>> files;  // of each folder
  for (const std::string& name : names) {
    const std::size_t slash = name.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : name.substr(0, slash);
    files[folder].push_back(slash == std::string::npos ? name : name.substr(slash + 1));
  }
  if (names.size() == 1) return with_doubled_braces(names.front());
  std::string of_files;
  for (const auto& [folder, inside] : files) {
    const std::string guessed = template_of_files(inside, names);
    if (!of_files.empty() && guessed != of_files) refuse_names(names);
    of_files = guessed;
  }
  if (files.size() == 1) {
    const std::string& folder = files.begin()->first;
    return folder.empty() ? of_files : with_doubled_braces(folder) + "/" + of_files;
  }
  if (std::all_of(
          files.begin(), files.end(), [](const auto& one) { return is_camera_name(one.first); }))
    return "{camera}/" + of_files;
  std::vector<CutText> cuts;
  for (const auto& [folder, inside] : files) {
    cuts.push_back(cut_at_last_number(folder));
    if (cuts.back().number.empty() || cuts.back().before != cuts.front().before ||
        cuts.back().after != cuts.front().after)
      refuse_names(names);
  }
  return with_doubled_braces(cuts.front().before) + number_field("view", cuts) +
         with_doubled_braces(cuts.front().after) + "/" + of_files;
}

}  // namespace frangia
