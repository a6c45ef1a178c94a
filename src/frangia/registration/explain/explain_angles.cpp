#include "frangia/registration/internal/explain_angles.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/core/statistics.h"
#include "frangia/registration/explain/internal/describe_explanation.h"
#include "frangia/registration/internal/assess_fit.h"

namespace frangia {
namespace {

/// How views fit with some angles.
struct Agreement {
  double violation = 0.0;  ///< share of the comparisons in front of what another view measured
  double surfels = 0.0;    ///< that lie on what another view measured

  /// What speaks for the angles. A hundredth of the comparisons that contradict outweighs all.
  [[nodiscard]] double support() const { return surfels * std::max(0.0, 1.0 - 100.0 * violation); }
};

Agreement agreement_of(Bundle& bundle,
                       const SurfelLists& surfels,
                       const std::vector<double>& angles_rad) {
  bundle.state.angles_rad = angles_rad;
  const BundleSums sums = sum(bundle, surfels);
  return {free_space_violation(sums),
          static_cast<double>(
              std::accumulate(sums.matched.begin(), sums.matched.end(), std::size_t{0}))};
}

std::vector<double> scaled(const std::vector<double>& angles_rad, double factor) {
  std::vector<double> all = angles_rad;
  for (double& angle : all)
    angle = angles_rad[0] + factor * (angle - angles_rad[0]);
  return all;
}

/// Largest relative error of the stated steps per turn that is searched. Half, double and reversed
/// angles are tried besides.
constexpr double kMostWrong = 0.12;

/// Factors of the commanded angles: half, double and the other direction, and those of a table
/// whose steps per turn are not as stated, near enough to each other that the last view fits.
std::vector<double> factors() {
  constexpr double kStep = 0.004;
  std::vector<double> all{0.5, 2.0, -1.0};
  for (int i = 1; i * kStep < kMostWrong; ++i)
    all.insert(all.end(), {1.0 - i * kStep, 1.0 + i * kStep});
  return all;
}

/// The turn to view `first` did not happen.
std::vector<double> without_turn(std::vector<double> angles_rad, std::size_t first) {
  const double turn = angles_rad[first] - angles_rad[first - 1];
  for (std::size_t view = first; view < angles_rad.size(); ++view)
    angles_rad[view] -= turn;
  return angles_rad;
}

/// Sums over the views of how their angles are related to those commanded.
struct AngleSums {
  double products = 0.0;     ///< of difference and commanded angle
  double squares = 0.0;      ///< of the commanded angles
  double differences = 0.0;  ///< squares

  AngleSums(const std::vector<double>& commanded_rad, const std::vector<double>& found_rad) {
    for (std::size_t view = 1; view < commanded_rad.size(); ++view) {
      const double commanded = commanded_rad[view] - commanded_rad[0];
      const double off = found_rad[view] - found_rad[0] - commanded;
      products += off * commanded;
      squares += commanded * commanded;
      differences += off * off;
    }
  }
  /// How far they are off in proportion.
  [[nodiscard]] double share() const { return products / std::max(1e-300, squares); }
};

/// The share of the commanded angles by which those are off to which the table was refined; none
/// where they are to be expected, or are off otherwise.
std::optional<double> share_of_angles(const Bundle& bundle) {
  constexpr std::size_t kFewest = 4;  // views: through fewer any share may go
  constexpr double kLogOdds = 13.0;   // 100 : 1, over its rarity and the price of a share
  constexpr double kRest = 0.2;       // of the differences, which the share leaves
  if (bundle.given.angles_rad.size() < kFewest) return std::nullopt;
  const AngleSums sums(bundle.given.angles_rad, bundle.state.angles_rad);
  const double explained = sums.share() * sums.products;
  constexpr Eigen::Index kFirstAngle = 4;
  const double variance = std::pow(bundle.prior_sigma[kFirstAngle], 2);
  if (0.5 * explained / variance < kLogOdds) return std::nullopt;
  if (sums.differences - explained > kRest * kRest * sums.differences) return std::nullopt;
  return sums.share();
}

/// The factor near another one that the angles follow to which the table is refined from there.
double refined_factor(const Registration& work, double factor) {
  constexpr int kTurns = 3;  // the prior of the angles holds them back
  Bundle bundle = work.bundle;
  bundle.gate_mm = work.reach_mm;
  const std::vector<double>& given = work.bundle.given.angles_rad;
  bundle.state = bundle.given;  // the refined axis is that of the wrong angles
  for (int turn = 0; turn < kTurns; ++turn) {
    bundle.given.angles_rad = scaled(given, factor);
    bundle.state.angles_rad = bundle.given.angles_rad;
    optimize_bundle(bundle, work.surfels, work.options.max_iterations, work.run);
    factor = 1.0 + AngleSums(given, bundle.state.angles_rad).share();
  }
  return factor;
}

/// Median distance of the views about the stated axis. Angles that slid along faces of the part,
/// which do not hold them, make it no smaller.
float apart_mm(const Registration& work, const std::vector<double>& angles_rad) {
  Bundle bundle = work.bundle;
  bundle.gate_mm = work.reach_mm;
  bundle.state = bundle.given;
  bundle.state.angles_rad = angles_rad;
  return median(sum(bundle, work.surfels).distances_mm);
}

PoseExplanation scaled_by(double factor) {
  PoseExplanation scale;
  scale.best = PoseCause::AnglesScaled;
  scale.scale = factor;
  return scale;
}

/// With its sentence.
ExplainedAngles worded(ExplainedAngles found, const Registration& work) {
  found.explanation.text =
      describe(found.explanation, [&](std::size_t view) { return work.name_of(view); });
  found.explanation.remedy = remedy_of(found.explanation, work.options.wrong_rig);
  return found;
}

}  // namespace

std::optional<ExplainedAngles> explain_angles(const Registration& work) {
  // Edges and stray points cause up to 0.002, but other angles then fit no more of the part; of a
  // gear, the sides of the teeth alone contradict.
  constexpr double kSuspicious = 0.0005;
  constexpr double kRemaining = 0.4;  // of the violations, with the angles as they were
  constexpr double kMore = 1.005;     // times the surfels that agree with the angles as they were
  constexpr float kMuch = 2.0F;       // times as far apart by the commanded angles
  constexpr double kOpen = 0.3;       // of the reach: where the stated axis may place views
  constexpr std::size_t kFew = 500;   // surfels of a view
  constexpr int kFine = 7;
  constexpr double kFineStep = 0.0005;
  constexpr double kAsMany = 0.998;
  Bundle bundle = work.bundle;
  const SurfelLists surfels = pick_all_surfels(bundle.maps, kFew);
  bundle.gate_mm = kOpen * work.reach_mm;
  const std::vector<double>& given = bundle.given.angles_rad;
  const Agreement commanded = agreement_of(bundle, surfels, bundle.state.angles_rad);
  if (commanded.violation < kSuspicious) {
    const auto share = share_of_angles(work.bundle);
    if (!share || std::abs(*share) > kMostWrong) return std::nullopt;
    const double factor = refined_factor(work, 1.0 + *share);
    const std::vector<double> turned = scaled(given, factor);
    if (apart_mm(work, given) < kMuch * apart_mm(work, turned)) return std::nullopt;
    return worded({turned, scaled_by(factor)}, work);
  }
  bundle.state = bundle.given;  // the refined axis is that of the wrong angles
  ExplainedAngles best{given, {}};
  const double few = kRemaining * commanded.violation;
  double most = 0.0;
  // The refined axis slid, where the stated one places the views with the angles as they are.
  if (agreement_of(bundle, surfels, given).violation < few) return std::nullopt;
  const auto try_angles = [&](std::vector<double> angles_rad, const PoseExplanation& as) {
    const Agreement agreement = agreement_of(bundle, surfels, angles_rad);
    // Of parts that repeat themselves, other angles fit, too, but the right ones fit more of it.
    if (agreement.violation > few || agreement.surfels < kMore * commanded.surfels ||
        agreement.support() <= most)
      return;
    most = agreement.support();
    best = {std::move(angles_rad), as};
  };
  for (const double factor : factors())
    try_angles(scaled(given, factor), scaled_by(factor));
  const double found = best.explanation.scale;
  if (best.explanation.best == PoseCause::AnglesScaled && std::abs(found - 1.0) < kMostWrong) {
    for (int i = -kFine; i <= kFine; ++i)
      try_angles(scaled(given, found + i * kFineStep), scaled_by(found + i * kFineStep));
    // Where the part holds the angles of the views, their fit is better than any step.
    const double factor = refined_factor(work, best.explanation.scale);
    if (agreement_of(bundle, surfels, scaled(given, factor)).support() >= kAsMany * most)
      best = {scaled(given, factor), scaled_by(factor)};
  }
  for (std::size_t view = 1; view < given.size(); ++view) {
    PoseExplanation lost;
    lost.best = PoseCause::Turned;
    lost.views = {view};
    lost.turned_rad = given[view - 1] - given[view];
    try_angles(without_turn(given, view), lost);
  }
  if (best.explanation.best == PoseCause::AsStated) return std::nullopt;
  return worded(std::move(best), work);
}

}  // namespace frangia
