#include "option_names.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace frangia {
namespace {

bool is_option_name(std::string_view word) {
  const auto is_lower = [](char letter) { return letter >= 'a' && letter <= 'z'; };
  const auto fits = [&](char letter) {
    return is_lower(letter) || (letter >= '0' && letter <= '9') || letter == '_';
  };
  return !word.empty() && is_lower(word.front()) && std::all_of(word.begin(), word.end(), fits);
}

/// "voxel_mm" becomes "--voxel": a flag has no unit.
std::string flag_of(std::string_view name) {
  constexpr std::array<std::string_view, 6> kUnits = {"_mm", "_px", "_rad", "_deg", "_ms", "_s"};
  for (const std::string_view unit : kUnits) {
    if (name.size() <= unit.size() || name.substr(name.size() - unit.size()) != unit) continue;
    name.remove_suffix(unit.size());
    break;
  }
  std::string flag = "--" + std::string(name);
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

}  // namespace

std::string with_flags(const std::string& sentence,
                       const std::function<bool(const std::string&)>& has_flag) {
  std::string out;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t open = sentence.find('`', begin);
    const std::size_t close = open == std::string::npos ? open : sentence.find('`', open + 1);
    if (close == std::string::npos) return out + sentence.substr(begin);
    const std::string word = sentence.substr(open + 1, close - open - 1);
    out += sentence.substr(begin, open - begin);
    begin = close + 1;
    const std::string flag = is_option_name(word) ? flag_of(word) : "";
    out += flag.empty() || (has_flag && !has_flag(flag)) ? '`' + word + '`' : flag;
  }
}

}  // namespace frangia
