#include "frangia/decode/explain/find_ceiling.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

namespace frangia {
namespace {

constexpr int kStride = 3;             ///< px between samples
constexpr double kLeastShare = 0.002;  ///< of the samples; fewer do not matter
constexpr double kOverNeighbours = 4.0;
constexpr double kLeastNoise = 0.35;  ///< counts; less leaves all equal pixels at one level
constexpr int kNeighbours = 12;       ///< levels below the ceiling that are compared
/// Odds of a ceiling below the white level before the data.
constexpr double kPriorCeiling = 0.01;

/// How often each level occurs.
std::map<int, double> count_levels(std::span<const FrameStack> stacks) {
  std::map<int, double> levels;
  for (const FrameStack& stack : stacks) {
    if (stack.pattern.kind != PatternKind::Fringe) continue;
    for (const Frame& frame : stack.frames) {
      std::visit(
          [&](const auto& image) {
            for (int y = kStride / 2; y < image.height(); y += kStride)
              for (int x = kStride / 2; x < image.width(); x += kStride)
                levels[static_cast<int>(image(x, y))] += 1.0;
          },
          frame);
    }
  }
  return levels;
}

}  // namespace

std::optional<Ceiling> find_ceiling(std::span<const FrameStack> stacks, const NoiseModel& noise) {
  const std::map<int, double> levels = count_levels(stacks);
  if (levels.empty()) return std::nullopt;
  const auto [ceiling, at] = *levels.rbegin();
  if (ceiling >= stacks.front().white_level) return std::nullopt;
  if (ceiling == 0) return std::nullopt;  // black frames
  if (std::sqrt(noise.variance(ceiling)) < kLeastNoise) return std::nullopt;
  double all = 0.0;
  double most = 1.0;
  for (const auto& [level, count] : levels) {
    all += count;
    if (level < ceiling && level >= ceiling - kNeighbours) most = std::max(most, count);
  }
  if (at < kLeastShare * all || at < kOverNeighbours * most) return std::nullopt;
  // Poisson counts of the mean `most` against the count that was found.
  const double log_odds = at * std::log(at / most) - (at - most) + std::log(kPriorCeiling);
  if (log_odds < std::log(100.0)) return std::nullopt;
  return Ceiling{ceiling, at / all, log_odds};
}

}  // namespace frangia
