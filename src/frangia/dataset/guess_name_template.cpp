#include <algorithm>
#include <cctype>
#include <cstddef>
#include <iterator>
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

/// A text cut into its numbers and what stands between them.
struct NumberedText {
  std::vector<std::string> texts;    ///< one more than numbers; the first and last may be empty
  std::vector<std::string> numbers;  ///< in their order
};

NumberedText cut_at_numbers(const std::string& text) {
  NumberedText out{{""}, {}};
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_decimal(text[i])) {
      out.texts.back() += text[i];
    } else if (i > 0 && is_decimal(text[i - 1])) {
      out.numbers.back() += text[i];
    } else {
      out.numbers.emplace_back(1, text[i]);
      out.texts.emplace_back();
    }
  }
  return out;
}

/// Whether the numbers of all names, in one place of them, count by one.
bool counts_by_one(const std::vector<NumberedText>& cuts, std::size_t place) {
  constexpr std::size_t kMostDigits = 9;
  std::set<unsigned long> values;
  for (const NumberedText& cut : cuts) {
    if (cut.numbers[place].size() > kMostDigits) return false;
    values.insert(std::stoul(cut.numbers[place]));
  }
  return values.size() == cuts.size() && *values.rbegin() - *values.begin() + 1 == values.size();
}

/// The template of names in which several numbers differ: a frame's and those of its time. Empty
/// where the names differ otherwise.
std::string template_with_times(const std::vector<std::string>& files) {
  std::vector<NumberedText> cuts;
  for (const std::string& file : files) {
    const std::size_t dot = std::min(file.rfind('.'), file.size());
    cuts.push_back(cut_at_numbers(file.substr(0, dot)));
    cuts.back().texts.back() += file.substr(dot);
    if (cuts.back().texts != cuts.front().texts) return {};
  }
  std::size_t frame = cuts.front().numbers.size();
  unsigned long first = 0;
  for (std::size_t place = 0; place < cuts.front().numbers.size(); ++place) {
    if (!counts_by_one(cuts, place)) continue;
    unsigned long begin = std::stoul(cuts.front().numbers[place]);
    for (const NumberedText& cut : cuts)
      begin = std::min(begin, std::stoul(cut.numbers[place]));
    // A counter begins earlier than seconds or minutes do.
    if (frame < cuts.front().numbers.size() && begin >= first) continue;
    frame = place;
    first = begin;
  }
  std::string out = with_doubled_braces(cuts.front().texts.front());
  for (std::size_t place = 0; place < cuts.front().numbers.size(); ++place) {
    const std::string& number = cuts.front().numbers[place];
    const bool same = std::all_of(cuts.begin(), cuts.end(), [&](const NumberedText& cut) {
      return cut.numbers[place] == number;
    });
    if (place == frame) {
      std::vector<CutText> numbers;
      for (const NumberedText& cut : cuts)
        numbers.push_back({"", cut.numbers[place], ""});
      out += number_field("frame", numbers);
    } else {
      out += same ? number : "{*}";
    }
    out += with_doubled_braces(cuts.front().texts[place + 1]);
  }
  return out;
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
  // Patterns have several frames; where most names begin by themselves, it is a time that differs.
  if (prefixes.size() > 2 && 2 * prefixes.size() > files.size()) {
    if (std::string timed = template_with_times(files); !timed.empty()) return timed;
  }
  return "{pattern}" + separator + end;
}

/// Whether a folder is called like a camera: left, right, cam0, camera-b.
bool is_camera_name(const std::string& folder) {
  std::string name;
  for (const char letter : folder)
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return name == "left" || name == "right" || name == "l" || name == "r" || name.starts_with("cam");
}

/// Whether a folder is called like a kind of pattern with its number: fringes64, period_20.
bool is_pattern_name(const CutText& folder) {
  std::string word;
  for (const char letter : folder.before)
    if (std::isalpha(static_cast<unsigned char>(letter)) != 0)
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  for (const char* kind : {"pattern", "fringe", "fringes", "period", "freq", "frequency"})
    if (word == kind) return true;
  return false;
}

/// What one level of folders stands for: a name that all have, cameras, views or patterns.
std::string template_of_folders(const std::vector<std::string>& folders,
                                bool has_pattern,
                                const std::vector<std::string>& names) {
  const std::set<std::string> different(folders.begin(), folders.end());
  if (different.size() == 1) return with_doubled_braces(folders.front());
  if (std::all_of(different.begin(), different.end(), is_camera_name)) return "{camera}";
  std::vector<CutText> cuts;
  bool numbered = true;
  for (const std::string& folder : different) {
    cuts.push_back(cut_at_last_number(folder));
    numbered = numbered && !cuts.back().number.empty() &&
               cuts.back().before == cuts.front().before && cuts.back().after == cuts.front().after;
  }
  if (numbered && (has_pattern || !is_pattern_name(cuts.front()))) {
    return with_doubled_braces(cuts.front().before) + number_field("view", cuts) +
           with_doubled_braces(cuts.front().after);
  }
  if (has_pattern) refuse_names(names);
  return "{pattern}";
}

std::vector<std::string> folders_of(const std::string& path) {
  std::vector<std::string> folders;
  for (std::size_t begin = 0; begin < path.size();) {
    const std::size_t slash = std::min(path.find('/', begin), path.size());
    folders.push_back(path.substr(begin, slash - begin));
    begin = slash + 1;
  }
  return folders;
}

std::string guess(const std::vector<std::string>& names) {
  std::map<std::string, std::vector<std::string>> files;  // of each folder
  for (const std::string& name : names) {
    const std::size_t slash = name.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : name.substr(0, slash);
    files[folder].push_back(slash == std::string::npos ? name : name.substr(slash + 1));
  }
  std::string of_files;
  for (const auto& [folder, inside] : files) {
    const std::string guessed = template_of_files(inside, names);
    if (!of_files.empty() && guessed != of_files) refuse_names(names);
    of_files = guessed;
  }
  std::vector<std::vector<std::string>> levels;  // of the folders, from the top
  for (const auto& [folder, inside] : files) {
    const std::vector<std::string> path = folders_of(folder);
    if (levels.empty()) levels.resize(path.size());
    if (path.size() != levels.size()) refuse_names(names);
    for (std::size_t i = 0; i < path.size(); ++i)
      levels[i].push_back(path[i]);
  }
  std::string out;
  bool has_pattern = of_files.find("{pattern}") != std::string::npos;
  for (const std::vector<std::string>& level : levels) {
    const std::string of_level = template_of_folders(level, has_pattern, names);
    has_pattern = has_pattern || of_level == "{pattern}";
    out += of_level + "/";
  }
  return out + of_files;
}

/// The names without those few whose texts between numbers no other name has.
std::vector<std::string> without_odd_names(const std::vector<std::string>& names) {
  constexpr std::size_t kMostOdd = 3;
  constexpr std::size_t kLeastOthers = 4;  // for each of them
  std::map<std::vector<std::string>, std::size_t> alike;
  for (const std::string& name : names)
    ++alike[cut_at_numbers(name).texts];
  std::vector<std::string> kept;
  std::copy_if(names.begin(), names.end(), std::back_inserter(kept), [&](const auto& name) {
    return alike[cut_at_numbers(name).texts] > 1;
  });
  const std::size_t odd = names.size() - kept.size();
  return odd <= kMostOdd && kept.size() >= kLeastOthers * odd ? kept : names;
}

}  // namespace

std::string guess_name_template(const std::vector<std::string>& names) {
  require(!names.empty(), "there are no images whose names could be guessed");
  if (names.size() == 1) return with_doubled_braces(names.front());
  const std::vector<std::string> most = without_odd_names(names);
  if (most.size() == names.size()) return guess(names);
  try {
    return guess(names);
  } catch (const Error&) {
    return guess(most);
  }
}

}  // namespace frangia
