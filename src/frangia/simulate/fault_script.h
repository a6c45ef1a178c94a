#pragma once

#include <string>
#include <vector>

namespace frangia {

/// Faults that a simulated device is to show, each a line of words such as "lost 1 fringe 2".
///
/// A word of a line must equal that asked for; a line may be shorter, and then holds for all:
/// "incomplete 1" for every frame of view 1.
class FaultScript {
 public:
  FaultScript() = default;
  explicit FaultScript(const std::vector<std::string>& lines);

  /// Whether a line begins `words`.
  [[nodiscard]] bool holds(const std::vector<std::string>& words) const;
  /// The lines' first words, for whoever checks that they are known.
  [[nodiscard]] std::vector<std::string> kinds() const;

 private:
  std::vector<std::vector<std::string>> lines_;
};

}  // namespace frangia
