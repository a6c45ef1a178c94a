#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "frangia/service/internal/command_arguments.h"

namespace frangia {

/// The last commands that had an id and were accepted, with their answers: a client whose
/// connection broke before the answer sends the same command again. Those that changed a surface
/// are in SurfaceVersions as well, which outlives the program.
class AnsweredCommands {
 public:
  static constexpr std::size_t kMost = 256;

  /// The answer to a command; null when it was not given yet.
  ///
  /// @errors   Error(Input) when the id was that of another command
  [[nodiscard]] const nlohmann::ordered_json* find(const CommandKey& key) const;
  void keep(const CommandKey& key, nlohmann::ordered_json answer);

 private:
  std::deque<std::pair<CommandKey, nlohmann::ordered_json>> last_;
};

/// @errors   Error(Input) unless both are the same command
void require_same_command(const CommandKey& asked, const CommandKey& known);

}  // namespace frangia
