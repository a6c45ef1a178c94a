#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "frangia/core/run.h"

namespace frangia {

/// Holds back the messages of an attempt until it is known whether its result is used. It must
/// outlive the attempt.
class HeldMessages {
 public:
  /// A run for the attempt, whose warnings and notes are held back.
  [[nodiscard]] Run in_place_of(const Run& run) {
    Run held = run;
    held.on_warning = [this](const std::string& text) { texts_.emplace_back(true, text); };
    held.on_note = [this](const std::string& text) { texts_.emplace_back(false, text); };
    return held;
  }
  /// Makes an attempt, a function of a run, with its messages held back. Where it throws, they are
  /// given to `run`, since they may say why.
  ///
  /// @errors   those of the attempt
  template <typename Attempt>
  decltype(auto) during(const Run& run, const Attempt& attempt) {
    try {
      return attempt(in_place_of(run));
    } catch (...) {
      pass_on(run);
      throw;
    }
  }
  /// Gives them to `run`, in their order.
  void pass_on(const Run& run) const {
    for (const auto& [is_warning, text] : texts_)
      is_warning ? run.warn(text) : run.note(text);
  }
  /// Forgets those that begin with a text, which was said before.
  void forget(std::string_view beginning) {
    std::erase_if(texts_, [&](const auto& one) { return one.second.starts_with(beginning); });
  }

 private:
  std::vector<std::pair<bool, std::string>> texts_;
};

}  // namespace frangia
