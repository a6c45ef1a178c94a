#pragma once

#include <set>
#include <string>
#include <vector>

#include "frangia/devices/device_settings.h"

namespace frangia {

/// Scripted faults of a simulated device, each a line of words such as "lost 1 fringe 2".
///
/// A line matches an event whose first words equal the line's: "incomplete 1" matches every frame
/// of view 1. A fault triggers once per matching event and not at the next attempt, unless the line
/// ends with "always".
class FaultScript {
 public:
  FaultScript() = default;
  explicit FaultScript(const std::vector<std::string>& lines);

  /// Whether a fault triggers now.
  [[nodiscard]] bool triggers(const std::vector<std::string>& words);
  /// Whether a line matches, without triggering it.
  [[nodiscard]] bool matches(const std::vector<std::string>& words) const;
  /// The first words of all lines, to be checked against the known ones.
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
/// @errors   Error(Input) that names file and key when a line begins with none of `known`
[[nodiscard]] FaultScript read_faults(DeviceSettings& settings,
                                      const std::vector<std::string>& known);

}  // namespace frangia
