#include "frangia/core/nearest_name.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace frangia {
namespace {

std::size_t edit_distance(std::string_view word, std::string_view name) {
  std::vector<std::size_t> row(name.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (const char letter : word) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < name.size(); ++j) {
      const std::size_t changed = diagonal + (letter == name[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view word,
                                        const std::vector<std::string>& names) {
  const auto nearest = std::min_element(
      names.begin(), names.end(), [&](const std::string& one, const std::string& other) {
        return edit_distance(word, one) < edit_distance(word, other);
      });
  const bool near = nearest != names.end() && 3 * edit_distance(word, *nearest) <= word.size() + 1;
  return near ? std::optional(*nearest) : std::nullopt;
}

}  // namespace frangia
