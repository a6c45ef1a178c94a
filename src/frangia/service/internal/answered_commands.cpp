#include "frangia/service/internal/answered_commands.h"

#include <algorithm>

#include "frangia/core/error.h"

namespace frangia {

const nlohmann::ordered_json* AnsweredCommands::find(const CommandKey& key) const {
  if (key.id.empty()) return nullptr;
  const auto found = std::find_if(
      last_.begin(), last_.end(), [&](const auto& one) { return one.first.id == key.id; });
  if (found == last_.end()) return nullptr;
  require_same_command(key, found->first);
  return &found->second;
}

void AnsweredCommands::keep(const CommandKey& key, nlohmann::ordered_json answer) {
  if (key.id.empty()) return;
  if (last_.size() >= kMost) last_.pop_front();
  last_.emplace_back(key, std::move(answer));
}

void require_same_command(const CommandKey& asked, const CommandKey& known) {
  require(asked == known,
          "id: belongs to another command; send each command with an id of its own");
}

}  // namespace frangia
