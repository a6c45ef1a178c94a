#pragma once

#include <set>
#include <string>
#include <vector>

#include "frangia/devices/device_settings.h"

namespace frangia {

/// Faults that a simulated device is to show, each a line of words such as "lost 1 fringe 2".
///
/// A line's words must equal the first of those asked for, so that a shorter line holds for more:
/// "incomplete 1" for every frame of view 1. A fault happens once for each thing that it holds for,
/// and is gone at the next attempt; a line that ends with "always" stays.
class FaultScript {
 public:
  FaultScript() = default;
  explicit FaultScript(const std::vector<std::string>& lines);

  /// Whether a fault triggers now.
  [[nodiscard]] bool triggers(const std::vector<std::string>& words);
  /// Whether a line holds for this, without it being used up.
  [[nodiscard]] bool matches(const std::vector<std::string>& words) const;
  /// The lines' first words, for whoever checks that they are known.
  [[nodiscard]] std::vector<std::string> kinds() const;

 private:
  struct Line {
    std::vector<std::string> words;
    bool always = false;
  };
  [[nodiscard]] const Line* find(const std::vector<std::string>& words) const;

  std::vector<Line> lines_;
  std::set<std::vector<std::string>> triggered_;
};

/// The key `faults` of a simulated device.
///
/// errors   Error(Input) that names file and key when a line begins with none of `known`
[[nodiscard]] FaultScript read_faults(DeviceSettings& settings,
                                      const std::vector<std::string>& known);

}  // namespace frangia
