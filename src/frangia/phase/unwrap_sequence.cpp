#include "frangia/phase/unwrap_sequence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/rig/phase_range.h"

namespace frangia {
namespace {

constexpr std::size_t kChunk = 1 << 14;

/// A step of a ladder is planned for this chance; what each pixel really has is computed for it.
constexpr double kPlannedChance = 1e-6;

/// Fringes that the whole field may hold and still be one, by rounding.
constexpr double kOneFringe = 1.0 + 1e-6;

/// Maps and beats, coarse to fine.
std::vector<LadderStep> all_rungs(std::span<const Pattern> patterns) {
  std::vector<LadderStep> rungs;
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    rungs.push_back({i, -1, patterns[i].fringes_per_unit()});
    for (std::size_t j = 0; j < patterns.size(); ++j) {
      const double beat = patterns[i].fringes_per_unit() - patterns[j].fringes_per_unit();
      if (beat > 1e-9 * patterns[i].fringes_per_unit())
        rungs.push_back({i, static_cast<int>(j), beat});
    }
  }
  std::stable_sort(rungs.begin(), rungs.end(), [](const LadderStep& a, const LadderStep& b) {
    return a.per_unit < b.per_unit;
  });
  return rungs;
}

double rung_sigma(const LadderStep& rung, double sigma_rad) {
  return rung.less < 0 ? sigma_rad : sigma_rad * std::numbers::sqrt2;
}

/// What one pixel knows on its way up.
struct Climb {
  double rad = 0.0;
  double sigma = 0.0;
  double chance = 0.0;  ///< that an order was wrong so far
};

class Ladder {
 public:
  Ladder(std::span<const WrappedPhase> maps, std::vector<LadderStep> steps, double centre_rad)
      : maps_(maps), steps_(std::move(steps)), centre_rad_(centre_rad) {}

  /// Absolute phase of the finest map at pixel i, by all maps.
  [[nodiscard]] Climb climb(std::size_t i) const {
    Climb at = rung(steps_.front(), i);
    const double from_centre = wrap_rad(at.rad - centre_rad_);
    at.rad = centre_rad_ + from_centre;
    at.chance = std::erfc((kPi - std::abs(from_centre)) / (at.sigma * std::numbers::sqrt2));
    for (std::size_t k = 1; k < steps_.size(); ++k) {
      const double ratio = steps_[k].per_unit / steps_[k - 1].per_unit;
      const Climb finer = rung(steps_[k], i);
      const double chance =
          at.chance + wrong_order_chance(std::hypot(ratio * at.sigma, finer.sigma));
      at = {lift(finer.rad, ratio * at.rad), finer.sigma, chance};
    }
    return slope(at, i);
  }

 private:
  [[nodiscard]] Climb rung(const LadderStep& step, std::size_t i) const {
    const WrappedPhase& map = maps_[step.map];
    const double rad = map.phase_rad.pixels()[i];
    const double sigma = map.sigma_rad.pixels()[i];
    if (step.less < 0) return {rad, sigma};
    const WrappedPhase& other = maps_[static_cast<std::size_t>(step.less)];
    return {rad - static_cast<double>(other.phase_rad.pixels()[i]),
            std::hypot(sigma, static_cast<double>(other.sigma_rad.pixels()[i]))};
  }
  [[nodiscard]] static double lift(double wrapped, double expected) {
    return wrapped + kTurn * std::round((expected - wrapped) / kTurn);
  }
  /// Every map lifted by the finest, and the slope of phase over frequency through all of them.
  [[nodiscard]] Climb slope(const Climb& finest, std::size_t i) const {
    const double top = maps_.back().pattern.fringes_per_unit();
    double weights = 0.0;
    double sum = 0.0;
    for (const WrappedPhase& map : maps_) {
      const double ratio = map.pattern.fringes_per_unit() / top;
      const double sigma = map.sigma_rad.pixels()[i];
      const double weight = ratio / (sigma * sigma);
      sum += weight * lift(map.phase_rad.pixels()[i], ratio * finest.rad);
      weights += weight * ratio;
    }
    return {sum / weights, 1.0 / std::sqrt(weights), finest.chance};
  }

  std::span<const WrappedPhase> maps_;
  std::vector<LadderStep> steps_;
  double centre_rad_;  ///< phase of the first step in the middle of the field
};

/// The first fate that is not Measured, coarse to fine.
PixelFate fate_of(std::span<const WrappedPhase> maps, std::size_t i) {
  for (const WrappedPhase& map : maps) {
    if (map.fate.pixels()[i] != PixelFate::Measured) return map.fate.pixels()[i];
  }
  return PixelFate::Measured;
}

}  // namespace

std::vector<LadderStep> find_ladder(std::span<const Pattern> patterns,
                                    const Projector& projector,
                                    double sigma_rad) {
  if (patterns.empty()) return {};
  const auto rungs = all_rungs(patterns);
  const PhaseRange field = phase_range(patterns.back(), projector);
  const double units = field.width_rad() / kTurn / patterns.back().fringes_per_unit();
  std::vector<LadderStep> ladder;
  for (const LadderStep& rung : rungs) {  // the finest that is still one fringe
    if (rung.per_unit * units <= kOneFringe) ladder.assign(1, rung);
  }
  if (ladder.empty()) return {};
  const double top = patterns.back().fringes_per_unit();
  while (ladder.back().per_unit < top || ladder.back().less >= 0) {
    const LadderStep& here = ladder.back();
    const LadderStep* next = nullptr;
    for (const LadderStep& rung : rungs) {
      if (rung.per_unit < here.per_unit) continue;
      if (rung.per_unit == here.per_unit && (rung.less >= 0 || here.less < 0)) continue;
      const double ratio = rung.per_unit / here.per_unit;
      const double sigma =
          std::hypot(ratio * rung_sigma(here, sigma_rad), rung_sigma(rung, sigma_rad));
      // The finest that is safe, or else the very next one.
      if (next == nullptr || wrong_order_chance(sigma) < kPlannedChance) next = &rung;
    }
    if (next == nullptr) return {};
    ladder.push_back(*next);
  }
  return ladder;
}

AbsolutePhase unwrap_sequence(std::span<const WrappedPhase> coarse_to_fine,
                              const Projector& projector,
                              const TimeUnwrapOptions& options) {
  require(!coarse_to_fine.empty(), "unwrap_sequence: no phase given");
  std::vector<Pattern> patterns;
  for (const WrappedPhase& map : coarse_to_fine) {
    patterns.push_back(map.pattern);
    require(same_size(map.phase_rad, coarse_to_fine.front().phase_rad),
            "unwrap_sequence: the phases differ in size");
    require(map.pattern.fringes_per_unit() >= patterns.front().fringes_per_unit() &&
                std::isfinite(map.pattern.fringes_per_unit()),
            "unwrap_sequence: the phases must go from coarse to fine");
  }
  const std::vector<LadderStep> steps = find_ladder(patterns, projector);
  require(!steps.empty(),
          "the fringe patterns tell no absolute phase together: none of them, and no beat of two, "
          "holds one fringe or less over the field");
  const PhaseRange field = phase_range(patterns.back(), projector);
  const double scale = steps.front().per_unit / patterns.back().fringes_per_unit();
  const Ladder ladder(coarse_to_fine, steps, scale * field.centre_rad());
  const WrappedPhase& finest = coarse_to_fine.back();
  const int width = finest.phase_rad.width();
  const int height = finest.phase_rad.height();
  AbsolutePhase out{finest.pattern,
                    Image<float>(width, height, Unfilled{}),
                    Image<float>(width, height, Unfilled{}),
                    Image<PixelFate>(width, height, Unfilled{})};
  parallel_chunks(out.fate.pixels().size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      PixelFate fate = fate_of(coarse_to_fine, i);
      Climb found{kMissing, kMissing, 0.0};
      if (fate == PixelFate::Measured) found = ladder.climb(i);
      if (found.chance > options.max_wrong_order) {
        fate = PixelFate::Doubtful;
        found = {kMissing, kMissing, 0.0};
      }
      out.fate.pixels()[i] = fate;
      out.phase_rad.pixels()[i] = static_cast<float>(found.rad);
      out.sigma_rad.pixels()[i] = static_cast<float>(found.sigma);
    }
  });
  return out;
}

}  // namespace frangia
