#include "frangia/registration/internal/assess_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/linear_algebra.h"
#include "frangia/core/statistics.h"
#include "frangia/registration/internal/table_state.h"
#include "frangia/registration/internal/turntable_bundle.h"

namespace frangia {
namespace {

double violation_share(const PairTally& tally) {
  const std::size_t all = tally.agree + tally.violations;
  return all == 0 ? 0.0 : static_cast<double>(tally.violations) / static_cast<double>(all);
}

/// Largest share of a view's comparisons that violate free space, as if there were no view `left`.
double contradiction_without(const BundleSums& sums, const SurfelLists& surfels, std::size_t left) {
  double most = 0.0;
  for (std::size_t view = 0; view < surfels.size(); ++view) {
    if (view == left) continue;
    PairTally all;
    for (std::size_t other = 0; other < surfels.size(); ++other) {
      if (other == left) continue;
      all.add(sums.pair(view, other));
      all.add(sums.pair(other, view));
    }
    const double fewest = kMinOverlap * static_cast<double>(surfels[view].size());
    if (static_cast<double>(all.agree + all.violations) > fewest)
      most = std::max(most, violation_share(all));
  }
  return most;
}

}  // namespace

double rms_of(const std::vector<float>& distances) {
  double sum = 0.0;
  for (const float d : distances)
    sum += static_cast<double>(d) * static_cast<double>(d);
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, distances.size())));
}

double overlap_of(const BundleSums& sums, const SurfelLists& surfels) {
  std::size_t all = 0;
  for (const auto& own : surfels)
    all += own.size();
  const std::size_t matched =
      std::accumulate(sums.matched.begin(), sums.matched.end(), std::size_t{0});
  return static_cast<double>(matched) / static_cast<double>(std::max<std::size_t>(1, all));
}

std::vector<std::size_t> find_outliers(const BundleSums& sums, double outlier_overlap) {
  std::vector<double> shares;
  for (std::size_t view = 0; view < sums.matched.size(); ++view) {
    const auto observed = static_cast<double>(sums.observed[view]);
    shares.push_back(observed > 0.0 ? static_cast<double>(sums.matched[view]) / observed : 1.0);
  }
  const double usual = median(shares);
  std::vector<std::size_t> outliers;
  for (std::size_t view = 0; view < shares.size(); ++view) {
    if (shares[view] < outlier_overlap * usual) outliers.push_back(view);
  }
  return outliers;
}

double free_space_violation(const BundleSums& sums) {
  PairTally all;
  for (const PairTally& region : sums.regions)
    all.add(region);
  return violation_share(all);
}

double contradiction_of(const BundleSums& sums, const SurfelLists& surfels) {
  return contradiction_without(sums, surfels, surfels.size());
}

std::optional<std::size_t> contradicting_view(const BundleSums& sums,
                                              const SurfelLists& surfels,
                                              double limit) {
  std::optional<std::size_t> found;
  for (std::size_t view = 0; view < surfels.size(); ++view) {
    if (surfels[view].empty() || contradiction_without(sums, surfels, view) > limit) continue;
    if (found) return std::nullopt;  // two views contradict each other, and no third decides
    found = view;
  }
  return found;
}

std::optional<std::size_t> disagreeing_view(const BundleSums& sums) {
  constexpr double kExplains = 0.75;   // of what is more than noise, by the pairs of the view
  constexpr double kOtherViews = 0.5;  // at most, by those of any other view
  const std::size_t views = sums.matched.size();
  // Chi squared of the mean distances of regions, less its expectation. Each pair counts for both.
  std::vector<double> of_view(views, 0.0);
  double all = 0.0;
  for (std::size_t from = 0; from < views; ++from) {
    for (std::size_t to = 0; to < views; ++to) {
      for (std::size_t region = 0; region < kRegionsPerView; ++region) {
        const PairTally& pair = sums.regions[kRegionsPerView * (from * views + to) + region];
        if (!(pair.weight > 0.0)) continue;
        const double excess = pair.weighted_mm * pair.weighted_mm / pair.weight - 1.0;
        all += excess;
        of_view[from] += excess;
        of_view[to] += excess;
      }
    }
  }
  const auto most = std::max_element(of_view.begin(), of_view.end());
  if (!(all > 0.0) || *most < kExplains * all) return std::nullopt;
  const auto view = static_cast<std::size_t>(most - of_view.begin());
  of_view.erase(most);
  if (of_view.empty() || *std::max_element(of_view.begin(), of_view.end()) > kOtherViews * all)
    return std::nullopt;
  return view;
}

namespace {

/// How far the pairs disagree, over their noise and over what the places add to it.
void assess_disagreement(RegistrationReport& report,
                         const BundleSums& sums,
                         const Eigen::VectorXd& sigma) {
  constexpr std::size_t kFewest = 50;  // pairs: fewer are chance, such as edges
  const std::size_t count = sums.distances_mm.size();
  if (count < kFewest) return;
  report.disagreement_mm = static_cast<double>(median(sums.distances_mm));
  report.disagreement_over_noise = static_cast<double>(median(sums.over_sigma)) / kMedianOfNormal;
  // The variance that the places add to a pair, over that of its noise; the mean of all pairs.
  const double added = sums.hessian.diagonal().dot(sigma.cwiseAbs2()) / static_cast<double>(count);
  report.disagreement_over_sigma = report.disagreement_over_noise / std::sqrt(1.0 + added);
}

/// The information of the pairs on the unknowns: H C^-1 H with C the covariance of their gradient.
/// It is that of the noise that their distances show, and of an error that each region of a view
/// has by itself and that all of its pairs repeat, also those in which it is the target.
Eigen::MatrixXd information_of(const Bundle& bundle,
                               const BundleSums& sums,
                               const Eigen::VectorXd& sigma) {
  const double excess =
      std::max(1.0, static_cast<double>(median(sums.over_sigma)) / kMedianOfNormal);
  const double region_mm = shared_error_mm(bundle, sums) / std::sqrt(2.0);  // of either view
  const Eigen::VectorXd unit = sigma.unaryExpr([](double s) { return s > 0.0 ? s : 1.0; });
  const Eigen::MatrixXd hessian = scaled(sums.hessian, unit);
  const Eigen::MatrixXd repeated = 2.0 * region_mm * (unit.asDiagonal() * sums.region_gradients);
  Eigen::MatrixXd covariance = excess * excess * hessian + product_transposed(repeated, repeated);
  covariance.diagonal().array() += 1e-12 * covariance.trace();
  const Eigen::MatrixXd information =
      product(hessian, solve_symmetric_columns(covariance, hessian));
  return scaled(0.5 * (information + information.transpose()), unit.cwiseInverse());
}

/// The information that leaves axis and angles to the rig: of the part poses of further setups, on
/// which the rig says nothing.
Eigen::MatrixXd of_part_poses(Eigen::MatrixXd information, const TableState& state) {
  const Eigen::Index own = state.index_of_setup(1);
  information.topRows(own).setZero();
  information.leftCols(own).setZero();
  return information;
}

/// The information of points that several views measured.
Eigen::MatrixXd information_of_ties(const Bundle& bundle) {
  const TieSums ties = sum_ties(bundle.ties, bundle.state);
  return ties.hessian / std::pow(ties.excess(), 2);
}

/// The standard deviations of the rig's own turntable, at least as large as its values differ from
/// those that the views fit, which contradict a smaller one.
TurntableSigma as_found(const TurntableSigma& stated, const Bundle& bundle) {
  const Eigen::VectorXd moved = deviation(bundle.state, bundle.given);
  const auto rms = [](const auto& some) {
    return some.norm() / std::sqrt(static_cast<double>(some.size()));
  };
  const auto angles = static_cast<Eigen::Index>(bundle.state.angles_rad.size()) - 1;
  TurntableSigma found = stated;
  found.axis_rad = std::max(found.axis_rad, rms(moved.head<2>()));
  found.point_mm = std::max(found.point_mm, rms(moved.segment<2>(2)));
  found.angle_rad = std::max(found.angle_rad, rms(moved.segment(4, angles)));
  return found;
}

}  // namespace

double shared_error_mm(const Bundle& bundle, const BundleSums& sums) {
  constexpr std::size_t kFewest = 200;  // pairs of a region: their noise must not count
  std::vector<float> means_mm;
  for (const PairTally& region : sums.regions) {
    if (region.agree >= kFewest) means_mm.push_back(static_cast<float>(std::abs(region.mean_mm())));
  }
  const auto regions = static_cast<double>(means_mm.size());
  // The unknowns have been fitted to the same distances.
  const double left = regions - static_cast<double>(bundle.state.unknowns());
  if (left < 1.0) return bundle.systematic_mm;
  return static_cast<double>(median(std::move(means_mm))) / kMedianOfNormal *
         std::sqrt(regions / left);
}

void assess_places(RegistrationReport& report,
                   const Bundle& bundle,
                   const BundleSums& sums,
                   const RegisterOptions& options,
                   Overlap overlap,
                   const Eigen::VectorXd& offset) {
  const double distance_mm = bundle.prior_sigma[2] / options.relative_shift_sigma;
  report.sigma = sigma_of(report.given, options, distance_mm);
  report.rests_on_rig = overlap == Overlap::SaysNothing;
  TableState state = bundle.state;
  state.table = nearest_to(report.given, state.table);
  const bool moved = overlap == Overlap::Determines && !report.kept_rig;
  const Eigen::VectorXd sigma =
      sigmas_of(state, moved ? as_found(report.sigma, bundle) : report.sigma, bundle.prior_sigma);
  Eigen::MatrixXd information;
  if (overlap == Overlap::Determines)
    information = information_of(bundle, sums, bundle.prior_sigma);
  else if (!state.part_poses.empty() && !sums.distances_mm.empty())
    information = of_part_poses(information_of(bundle, sums, bundle.prior_sigma), state);
  if (!bundle.ties.empty()) {
    const Eigen::MatrixXd of_ties = information_of_ties(bundle);
    information = information.size() > 0 ? Eigen::MatrixXd(information + of_ties) : of_ties;
  }
  report.motions = state_motions(state, sigma, information, offset);
  if (report.rests_on_rig) assess_disagreement(report, sums, sigma);
}

void Registration::optimize_again() {
  bundle.state = bundle.given;
  bundle.gate_mm = reach_mm;
  optimize_bundle(bundle, surfels, options.max_iterations, run);
}

void Registration::leave_out(std::size_t view) {
  views.clear(view);
  surfels[view].clear();
  std::erase_if(bundle.ties,
                [view](const PointTie& tie) { return tie.from == view || tie.to == view; });
  for (auto& surfel : bundle.maps[view].surfels.pixels())
    surfel = {};
}

bool fits(const BundleSums& sums, const Registration& work) {
  if (contradiction_of(sums, work.surfels) > work.options.max_contradiction) return false;
  const std::vector<std::size_t> outliers = find_outliers(sums, work.options.outlier_overlap);
  return std::all_of(outliers.begin(), outliers.end(), [&](std::size_t view) {
    return work.surfels[view].empty();  // left out already
  });
}

bool fits_by_table(const Registration& work) {
  return fits(sum(work.bundle, work.surfels), work);
}

void leave_out_outliers(RegistrationReport& report, Registration& work) {
  const std::vector<std::size_t> outliers =
      find_outliers(sum(work.bundle, work.surfels), work.options.outlier_overlap);
  bool some = false;
  for (const std::size_t view : outliers) {
    if (work.surfels[view].empty()) continue;  // left out already
    some = true;
    report.outliers.push_back(view);
    work.run.warn(
        fmt::format("view {} fits no other view and is left out: check whether the part moved "
                    "before it was taken",
                    work.name_of(view)));
    work.leave_out(view);
  }
  if (some) work.optimize_again();
}

std::optional<std::size_t> view_at_fault(const RegistrationReport& report,
                                         const Registration& work) {
  if (!report.trustworthy) return work.contradicting;
  if (report.explanation.best != PoseCause::Unexplained) return std::nullopt;
  Bundle as_given = work.bundle;
  as_given.state = work.bundle.given;
  return disagreeing_view(sum(as_given, work.surfels));
}

}  // namespace frangia
