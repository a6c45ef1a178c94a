#include "frangia/diagnose/explanation.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace frangia {
namespace {

const double kNamed = std::log(100.0);  // odds from which on a cause is named
constexpr double kLargestExponent = 6.0;

/// "350 : 1", "above 10^6 : 1".
std::string odds_text(double log_odds) {
  const double exponent = log_odds / std::log(10.0);
  if (exponent > kLargestExponent) return fmt::format("above 10^{:.0f} : 1", kLargestExponent);
  return fmt::format("{:.3g} : 1", std::max(1.0, std::exp(log_odds)));
}

}  // namespace

bool Explanation::is_decided() const {
  return log_odds >= kNamed;
}

std::string describe(const Explanation& explanation) {
  std::string text = fmt::format("{}", fmt::join(explanation.best, ", or which is the same, "));
  if (explanation.second.empty()) return text;
  return text + fmt::format(" (odds {} against: {})",
                            odds_text(explanation.log_odds),
                            explanation.second.front());
}

}  // namespace frangia
