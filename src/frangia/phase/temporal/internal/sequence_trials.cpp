#include "frangia/phase/temporal/internal/sequence_trials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

/// Starts that projectors and captures confuse, degrees.
constexpr std::array<double, 3> kStarts{180.0, 90.0, 270.0};

/// An angle from 0 to below 360 degrees, to a hundredth.
double rounded_deg(double rad) {
  const double hundredths = std::round(100.0 * deg_from_rad(rad));
  const double turn = 36'000.0;
  return (hundredths - turn * std::floor(hundredths / turn)) / 100.0;
}

std::vector<double> degrees_of(const std::vector<double>& shifts_rad) {
  std::vector<double> degrees;
  degrees.reserve(shifts_rad.size());
  for (const double shift : shifts_rad)
    degrees.push_back(rounded_deg(shift));
  return degrees;
}

std::vector<double> shifted(std::vector<double> shifts_rad, double by_rad) {
  for (double& shift : shifts_rad)
    shift += by_rad;
  return shifts_rad;
}

std::vector<double> reversed_direction(std::vector<double> shifts_rad) {
  const double first = shifts_rad.front();
  for (double& shift : shifts_rad)
    shift = 2.0 * first - shift;
  return shifts_rad;
}

std::string start_text(const Pattern& pattern, double by_rad) {
  const double declared = pattern.shifts_rad.front();
  return fmt::format("a start of {:g} degrees, not {:g} degrees",
                     rounded_deg(declared + by_rad),
                     rounded_deg(declared));
}

/// Trials of one map; those with equal shifts are joined.
class ShiftTrials {
 public:
  ShiftTrials(const Pattern& declared, std::size_t map)
      : declared_(declared), map_(map), known_{degrees_of(declared.shifts_rad)} {}

  void add(SequenceFaultKind kind, std::string what, std::vector<double> shifts_rad) {
    const std::vector<double> degrees = degrees_of(shifts_rad);
    for (std::size_t i = 0; i < known_.size(); ++i) {
      if (known_[i] != degrees) continue;
      if (i > 0) trials[i - 1].fault.same_as.push_back(std::move(what));
      return;
    }
    known_.push_back(degrees);
    SequenceTrial trial;
    trial.fault = {kind,
                   {declared_.name},
                   std::move(what),
                   {},
                   fmt::format("shifts_deg = [{:g}]", fmt::join(degrees, ", "))};
    trial.fault.shifts_rad = shifts_rad;
    Pattern changed = declared_;
    changed.shifts_rad = std::move(shifts_rad);
    trial.changes.push_back({map_, std::move(changed), map_});
    trials.push_back(std::move(trial));
  }

  std::vector<SequenceTrial> trials;

 private:
  const Pattern& declared_;
  std::size_t map_;
  std::vector<std::vector<double>> known_;
};

/// The place in time of the declared frame k is `order[k]`.
std::vector<double> reordered(const std::vector<double>& shifts_rad,
                              const std::vector<std::size_t>& order) {
  std::vector<double> out(shifts_rad.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    out[order[k]] = shifts_rad[k];
  return out;
}

void add_orders(const Pattern& pattern, ShiftTrials& out) {
  const std::size_t frames = pattern.shifts_rad.size();
  std::vector<std::size_t> order(frames);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = 0; i < frames; ++i) {
    for (std::size_t k = i + 1; k < frames; ++k) {
      std::vector<std::size_t> swapped = order;
      std::swap(swapped[i], swapped[k]);
      out.add(SequenceFaultKind::Order,
              fmt::format("frames {} and {} exchanged", i, k),
              reordered(pattern.shifts_rad, swapped));
    }
  }
  std::vector<std::size_t> backwards(order.rbegin(), order.rend());
  out.add(SequenceFaultKind::Order,
          "frames in the opposite order",
          reordered(pattern.shifts_rad, backwards));
  for (std::size_t by = 1; by < frames; ++by) {
    std::vector<std::size_t> rotated = order;
    std::rotate(rotated.begin(), rotated.begin() + static_cast<std::ptrdiff_t>(by), rotated.end());
    std::vector<double> shifts_rad;
    for (const std::size_t k : rotated)
      shifts_rad.push_back(pattern.shifts_rad[k]);
    out.add(SequenceFaultKind::Order,
            fmt::format("frames that begin with frame {} of the declared order", by),
            std::move(shifts_rad));
  }
}

std::string period_text(const Pattern& pattern) {
  if (pattern.fringes_per_degree > 0.0)
    return fmt::format("{:.6g} fringes per degree", pattern.fringes_per_degree);
  return fmt::format("a period of {:.6g} px", pattern.period_px);
}

}  // namespace

std::vector<SequenceTrial> shift_trials(std::span<const Pattern> patterns, std::size_t map) {
  const Pattern& pattern = patterns[map];
  ShiftTrials out(pattern, map);
  for (const double start_deg : kStarts) {
    out.add(SequenceFaultKind::Start,
            start_text(pattern, rad_from_deg(start_deg)),
            shifted(pattern.shifts_rad, rad_from_deg(start_deg)));
  }
  const std::vector<double> reversed = reversed_direction(pattern.shifts_rad);
  out.add(SequenceFaultKind::Direction, "shifts in the opposite direction", reversed);
  add_orders(pattern, out);
  const std::size_t simple = out.trials.size();
  for (const double start_deg : kStarts) {
    out.add(SequenceFaultKind::Direction,
            fmt::format("shifts in the opposite direction and {}",
                        start_text(pattern, rad_from_deg(start_deg))),
            shifted(reversed, rad_from_deg(start_deg)));
  }
  for (std::size_t i = simple; i < out.trials.size(); ++i)
    out.trials[i].fault.is_compound = true;
  return std::move(out.trials);
}

SequenceTrial start_trial(std::span<const Pattern> patterns, std::size_t map, double start_rad) {
  const Pattern& pattern = patterns[map];
  ShiftTrials out(pattern, map);
  out.add(SequenceFaultKind::Start,
          start_text(pattern, start_rad),
          shifted(pattern.shifts_rad, start_rad));
  return std::move(out.trials.front());
}

SequenceTrial period_trial(std::span<const Pattern> patterns, std::size_t map, double per_unit) {
  Pattern changed = patterns[map];
  const bool angular = changed.fringes_per_degree > 0.0;
  (angular ? changed.fringes_per_degree : changed.period_px) = angular ? per_unit : 1.0 / per_unit;
  SequenceTrial trial;
  trial.fault = {SequenceFaultKind::Period,
                 {changed.name},
                 fmt::format("{}, not {}", period_text(changed), period_text(patterns[map])),
                 {},
                 angular ? fmt::format("fringes_per_degree = {:.6g}", changed.fringes_per_degree)
                         : fmt::format("period_px = {:.6g}", changed.period_px)};
  trial.changes.push_back({map, std::move(changed), map});
  return trial;
}

std::vector<SequenceTrial> period_trials(std::span<const Pattern> patterns, std::size_t map) {
  const double declared = patterns[map].fringes_per_unit();
  std::vector<double> tried;
  for (std::size_t other = 0; other < patterns.size(); ++other)
    if (other != map) tried.push_back(patterns[other].fringes_per_unit());
  for (const double factor : {2.0, 3.0, 4.0, 5.0, 10.0, 1.5, 1.25, 4.0 / 3.0}) {
    tried.push_back(declared * factor);
    tried.push_back(declared / factor);
  }
  std::vector<SequenceTrial> trials;
  std::vector<double> used{declared};
  for (const double per_unit : tried) {
    const bool known = std::any_of(used.begin(), used.end(), [&](double other) {
      return std::abs(other - per_unit) < 1e-6 * other;
    });
    if (known) continue;
    used.push_back(per_unit);
    trials.push_back(period_trial(patterns, map, per_unit));
  }
  return trials;
}

std::vector<SequenceTrial> joint_trials(std::span<const Pattern> patterns) {
  std::vector<SequenceTrial> trials;
  for (std::size_t a = 0; a < patterns.size(); ++a) {
    for (std::size_t b = a + 1; b < patterns.size(); ++b) {
      if (patterns[a].shifts_rad.size() != patterns[b].shifts_rad.size()) continue;
      SequenceTrial trial;
      trial.fault = {SequenceFaultKind::Exchanged,
                     {patterns[a].name, patterns[b].name},
                     "the frames of each other",
                     {},
                     fmt::format("the names of both patterns exchanged")};
      trial.changes = {{a, patterns[a], b}, {b, patterns[b], a}};
      trials.push_back(std::move(trial));
    }
  }
  // Sequences that begin with another frame differ by a step in all patterns.
  const double step_deg = 360.0 / static_cast<double>(patterns.front().shifts_rad.size());
  std::vector<double> starts_deg(kStarts.begin(), kStarts.end());
  for (const double start_deg : {step_deg, 360.0 - step_deg})
    if (std::find(starts_deg.begin(), starts_deg.end(), start_deg) == starts_deg.end())
      starts_deg.push_back(start_deg);
  for (const double start_deg : starts_deg) {
    SequenceTrial trial;
    trial.fault.what = start_text(patterns.front(), rad_from_deg(start_deg));
    for (std::size_t map = 0; map < patterns.size(); ++map) {
      SequenceTrial one = start_trial(patterns, map, rad_from_deg(start_deg));
      trial.fault.patterns.push_back(patterns[map].name);
      if (map == 0) trial.fault.keys = one.fault.keys;
      trial.changes.push_back(std::move(one.changes.front()));
    }
    trials.push_back(std::move(trial));
  }
  return trials;
}

}  // namespace frangia
