#include "frangia/registration/internal/explain_angles.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "frangia/registration/explain/internal/describe_explanation.h"
#include "frangia/registration/internal/assess_fit.h"

namespace frangia {
namespace {

/// How views fit with some angles.
struct Agreement {
  double violation = 0.0;  ///< share of the comparisons in front of what another view measured
  double surfels = 0.0;    ///< that lie on what another view measured
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

/// The factor near one of `factors` with which most surfels agree.
double refined_factor(Bundle& bundle,
                      const SurfelLists& surfels,
                      const std::vector<double>& given,
                      double factor) {
  constexpr double kFinest = 3e-5;
  const double open_mm = bundle.gate_mm;
  for (double step = 0.002; step > kFinest; step *= 0.5) {
    // The farther off the factor, the farther apart the surfaces.
    bundle.gate_mm = std::max(bundle.min_gate_mm, 0.75 * bundle.gate_mm);
    double best = factor;
    double most = agreement_of(bundle, surfels, scaled(given, factor)).surfels;
    for (const double tried : {factor - step, factor + step}) {
      const double agree = agreement_of(bundle, surfels, scaled(given, tried)).surfels;
      if (agree > most) {
        most = agree;
        best = tried;
      }
    }
    factor = best;
  }
  bundle.gate_mm = open_mm;
  return factor;
}

/// The turn to view `first` did not happen.
std::vector<double> without_turn(std::vector<double> angles_rad, std::size_t first) {
  const double turn = angles_rad[first] - angles_rad[first - 1];
  for (std::size_t view = first; view < angles_rad.size(); ++view)
    angles_rad[view] -= turn;
  return angles_rad;
}

}  // namespace

std::optional<ExplainedAngles> explain_angles(const Registration& work) {
  constexpr double kSuspicious = 0.03;  // fifteen times what edges and stray points cause
  constexpr double kRemaining = 0.3;    // of the violations, with the angles as they were
  constexpr double kFewest = 0.5;       // of the surfels that agree with the commanded angles
  constexpr double kOpen = 0.3;         // of the reach: where the stated axis may place views
  constexpr std::size_t kFew = 500;     // surfels of a view
  Bundle bundle = work.bundle;
  const SurfelLists surfels = pick_all_surfels(bundle.maps, kFew);
  bundle.gate_mm = kOpen * work.reach_mm;
  const std::vector<double>& given = bundle.given.angles_rad;
  const Agreement commanded = agreement_of(bundle, surfels, bundle.state.angles_rad);
  if (commanded.violation < kSuspicious) return std::nullopt;
  bundle.state = bundle.given;  // the refined axis is that of the wrong angles
  ExplainedAngles best{given, {}};
  double least = kRemaining * commanded.violation;
  const auto try_angles = [&](std::vector<double> angles_rad, const PoseExplanation& as) {
    const Agreement agreement = agreement_of(bundle, surfels, angles_rad);
    if (agreement.violation > least || agreement.surfels < kFewest * commanded.surfels) return;
    least = agreement.violation;
    best = {std::move(angles_rad), as};
  };
  for (const double factor : factors()) {
    PoseExplanation scale;
    scale.best = PoseCause::AnglesScaled;
    scale.scale = factor;
    try_angles(scaled(given, factor), scale);
  }
  const double found = best.explanation.scale;
  if (best.explanation.best == PoseCause::AnglesScaled && std::abs(found - 1.0) < kMostWrong) {
    best.explanation.scale = refined_factor(bundle, surfels, given, found);
    best.angles_rad = scaled(given, best.explanation.scale);
  }
  for (std::size_t view = 1; view < given.size(); ++view) {
    PoseExplanation lost;
    lost.best = PoseCause::Turned;
    lost.views = {view};
    lost.turned_rad = given[view - 1] - given[view];
    try_angles(without_turn(given, view), lost);
  }
  if (best.explanation.best == PoseCause::AsStated) return std::nullopt;
  best.explanation.text =
      describe(best.explanation, [&](std::size_t view) { return work.name_of(view); });
  best.explanation.remedy = remedy_of(best.explanation, work.options.wrong_rig);
  return best;
}

}  // namespace frangia
