#include <algorithm>
#include <cmath>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/registration/explain/internal/describe_explanation.h"
#include "frangia/registration/explain/internal/turn_fits.h"
#include "frangia/registration/internal/assess_fit.h"
#include "frangia/registration/internal/explain_angles.h"

namespace frangia {
namespace {

/// Turns of a view against another one that are compared, and their distance.
constexpr double kMostTurned_rad = rad_from_deg(12.0);
constexpr double kStep_rad = rad_from_deg(0.25);
constexpr int kSteps = 48;

/// Compares the views near to where the table was refined to.
TurnFits fits_near(const Registration& work) {
  constexpr std::size_t kSome = 3000;  // surfels of a view
  constexpr double kNear = 0.1;        // of the reach: axis and rig are near to where they belong
  Bundle near = work.bundle;
  near.gate_mm = std::max(near.min_gate_mm, kNear * work.reach_mm);
  return {near, {kStep_rad, kSteps, kSome, near.gate_mm, free_space_margin_mm(near)}};
}

/// Changes of the angles from those of a state, and what they are.
struct Turns {
  std::vector<double> turned_rad;
  PoseExplanation as{};
  double fit = 0.0;
};

class TurnSearch {
 public:
  explicit TurnSearch(const Registration& work)
      : fits_(fits_near(work)),
        given_(work.bundle.given.angles_rad),
        state_(work.bundle.state.angles_rad) {}

  [[nodiscard]] double fit_as_refined() const {
    return fits_.fit_of(std::vector<double>(given_.size(), 0.0));
  }
  [[nodiscard]] Turns turned(std::size_t first, double by_rad) const {
    Turns turns = from_given();
    for (std::size_t view = first; view < given_.size(); ++view)
      turns.turned_rad[view] += by_rad;
    turns.as.best = by_rad == 0.0 ? PoseCause::AsStated : PoseCause::Turned;
    turns.as.views = {first};
    turns.as.turned_rad = by_rad;
    turns.fit = fits_.fit_of(turns.turned_rad);
    return turns;
  }
  [[nodiscard]] Turns scaled(double by) const {
    Turns turns = from_given();
    for (std::size_t view = 0; view < given_.size(); ++view)
      turns.turned_rad[view] += by * (given_[view] - given_[0]);
    turns.as.best = PoseCause::AnglesScaled;
    turns.as.scale = 1.0 + by;
    turns.fit = fits_.fit_of(turns.turned_rad);
    return turns;
  }
  /// The best of what `at` makes of a number up to a limit, by steps and then ever finer.
  template <class At>
  [[nodiscard]] Turns best_of(double limit, double step, const At& at) const {
    constexpr double kFinest = 0.1;  // of a step
    Turns best = at(0.0);
    double center = 0.0;
    const auto try_at = [&](double value) {
      Turns next = at(value);
      if (next.fit <= best.fit) return;
      best = std::move(next);
      center = value;
    };
    const int steps = static_cast<int>(limit / step);
    for (int i = -steps; i <= steps; ++i)
      try_at(i * step);
    for (double finer = 0.5 * step; finer > kFinest * step; finer *= 0.5) {
      const double from = center;
      try_at(from - finer);
      try_at(from + finer);
    }
    return best;
  }
  [[nodiscard]] double range_rad() const {
    const auto [least, most] = std::minmax_element(given_.begin(), given_.end());
    return *most - *least;
  }
  [[nodiscard]] std::size_t views() const { return given_.size(); }

 private:
  [[nodiscard]] Turns from_given() const {
    Turns turns{given_};
    for (std::size_t view = 0; view < given_.size(); ++view)
      turns.turned_rad[view] -= state_[view];
    return turns;
  }

  TurnFits fits_;
  const std::vector<double>& given_;
  const std::vector<double>& state_;
};

}  // namespace

std::optional<ExplainedAngles> explain_turns(const Registration& work) {
  constexpr double kLeast_rad = 2.0 * kStep_rad;  // smaller ones are to be expected
  constexpr double kSuspicious = 0.0005;  // share of points in front of what another view measured
  constexpr double kBetter = 25.0;        // gain of the fit, in pairs, which edges do not reach
  constexpr double kShare = 0.1;          // of the fit that is reached
  constexpr double kRemaining = 0.4;      // of the contradictions
  constexpr double kAlike = 0.1;          // of the gain
  const std::vector<double>& given = work.bundle.given.angles_rad;
  if (!work.bundle.given.part_poses.empty() || given.size() < 3) return std::nullopt;
  Bundle bundle = work.bundle;
  const double violation = free_space_violation(sum(bundle, work.surfels));
  if (violation < kSuspicious) return std::nullopt;
  const TurnSearch search(work);
  const double range_rad = search.range_rad();
  if (!(range_rad > kMostTurned_rad)) return std::nullopt;
  std::vector<Turns> all{search.best_of(kMostTurned_rad / range_rad,
                                        kStep_rad / range_rad,
                                        [&](double by) { return search.scaled(by); })};
  for (std::size_t view = 1; view < search.views(); ++view)
    all.push_back(search.best_of(
        kMostTurned_rad, kStep_rad, [&](double by) { return search.turned(view, by); }));
  Turns best = *std::max_element(
      all.begin(), all.end(), [](const Turns& a, const Turns& b) { return a.fit < b.fit; });
  PoseExplanation& found = best.as;
  const double turned_rad = found.best == PoseCause::AnglesScaled
                                ? std::abs(found.scale - 1.0) * range_rad
                                : std::abs(found.turned_rad);
  const double gain = best.fit - search.fit_as_refined();
  if (turned_rad < kLeast_rad || turned_rad > kMostTurned_rad - kLeast_rad) return std::nullopt;
  if (gain < kBetter || gain < kShare * std::abs(best.fit)) return std::nullopt;
  for (const Turns& other : all) {
    if (other.fit < best.fit - kAlike * gain ||
        (other.as.best == found.best && other.as.views == found.views))
      continue;
    found.decided = false;
    found.second = other.as.best;
  }
  std::vector<double>& angles_rad = bundle.state.angles_rad;
  for (std::size_t view = 0; view < angles_rad.size(); ++view)
    angles_rad[view] += best.turned_rad[view];
  // Better angles than those stated may still be far from the right ones.
  if (free_space_violation(sum(bundle, work.surfels)) > kRemaining * violation) return std::nullopt;
  ExplainedAngles explained{std::move(angles_rad), std::move(found)};
  PoseExplanation& as = explained.explanation;
  as.text = describe(as, [&](std::size_t view) { return work.name_of(view); });
  as.remedy = remedy_of(as, work.options.wrong_rig);
  return explained;
}

}  // namespace frangia
