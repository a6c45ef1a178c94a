#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {

/// Reads the lines of comma-separated values of a covariance.
class CovarianceReader {
 public:
  CovarianceReader(const std::filesystem::path& path, std::string text)
      : path_(path), text_(std::move(text)), rest_(text_) {}

  [[noreturn]] void fail(const std::string& why) const {
    throw Error(ErrorKind::Input,
                fmt::format("{}: {}; calibrate the rig again, or remove the key covariance from "
                            "[calibration] of its rig.toml",
                            path_.string(),
                            why));
  }

  /// Returns the next line that is not empty; empty at the end.
  std::vector<std::string_view> line() {
    std::vector<std::string_view> values;
    while (!rest_.empty() && values.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      std::string_view one = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      if (one.ends_with('\r')) one.remove_suffix(1);
      if (one.empty()) continue;
      while (true) {
        const std::size_t comma = std::min(one.find(','), one.size());
        values.push_back(one.substr(0, comma));
        if (comma == one.size()) break;
        one.remove_prefix(comma + 1);
      }
    }
    return values;
  }

  [[nodiscard]] double number(std::string_view word, std::string_view row) const {
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      fail(fmt::format("the value '{}' in the row of {} is not a finite number", word, row));
    }
    return value;
  }

 private:
  const std::filesystem::path& path_;
  std::string text_;
  std::string_view rest_;
};

}  // namespace frangia
