#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace frangia {

/// What explains data that contradict their description, chosen by evidence among hypotheses.
struct Explanation {
  /// The hypotheses of the best class, the simplest first: they predict the data alike.
  std::vector<std::string> best;
  std::vector<std::string> second;  ///< of the next class; empty without one
  double log_odds = 0.0;  ///< natural logarithm of the odds of the best class to the others
  /// RMS of what the best hypothesis leaves beyond the noise, relative to the signal.
  double unexplained = 0.0;
  std::string remedy{};       ///< what to do or to declare; empty if nothing
  std::size_t likeliest = 0;  ///< of the scored hypotheses: the most likely one of the best class

  /// Whether the best class wins by 100 : 1, so that its cause may be named.
  [[nodiscard]] bool is_decided() const;
};

/// Formats an explanation as one clause without a full stop: "frame 2 is black (odds above 10^6 : 1
/// against frame 2 at 0.05 of the light)". All hypotheses of a class are named.
[[nodiscard]] std::string describe(const Explanation& explanation);

}  // namespace frangia
