#include "frangia/registration/internal/drift_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/registration/internal/view_transfer.h"

namespace frangia {
namespace {

/// Surfels of a map.
constexpr std::size_t kSurfelsOfView = 30'000;

}  // namespace

std::vector<DriftView> drift_views(std::span<const RigSurfaces> surfaces,
                                   const Rig& given,
                                   const Rig& rig,
                                   bool changed,
                                   const Run& run) {
  const Run silent{.stop = run.stop};
  std::vector<DriftView> views;
  for (const RigSurfaces& surface : surfaces) {
    const std::size_t budget = surfels_per_view(kSurfelsOfView, surface.views.size());
    const auto maps =
        changed
            ? make_surfel_maps(retriangulate_views(surface.views, surface.pattern, given, rig, run),
                               rig.reference().model,
                               budget,
                               silent)
            : make_surfel_maps(surface.views, rig.reference().model, budget, silent);
    for (std::size_t i = 0; i < maps.size(); ++i)
      views.push_back({maps[i], surface.stations[i]});
  }
  return views;
}

void differentiate(std::vector<DriftView>& views,
                   std::span<const RigSurfaces> surfaces,
                   const PointDrift& drift) {
  constexpr std::size_t kSome = 1000;  // surfels that show the field
  std::vector<const Pattern*> patterns;
  for (const RigSurfaces& surface : surfaces)
    patterns.insert(patterns.end(), surface.stations.size(), &surface.pattern);
  parallel_chunks(views.size(), 1, [&](std::size_t view, std::size_t /*end*/) {
    views[view].field = DriftField(drift, *patterns[view], pick_surfels(views[view].map, kSome));
  });
}

ViewPairs comparable_pairs(const std::vector<DriftView>& views,
                           std::span<const Station> stations,
                           const TableState& table,
                           const FastCameraModel& camera,
                           bool turns) {
  std::vector<SurfelMap> maps;
  std::vector<Eigen::Isometry3d> poses;
  for (const DriftView& view : views) {
    maps.push_back(view.map);
    poses.push_back(table.table.rig_from_object(table.angles_rad[view.station]));
  }
  ViewPairs pairs = choose_view_pairs(maps, camera, poses);
  for (std::size_t from = 0; from < pairs.size(); ++from) {
    const std::size_t own = views[from].station;
    std::erase_if(pairs[from], [&](std::size_t to) {
      const std::size_t other = views[to].station;
      return turns ? stations[own].setup != stations[other].setup : own != other;
    });
  }
  return pairs;
}

SurfelScale scale_of(const std::vector<DriftView>& views) {
  constexpr std::size_t kSamples = 1000;  // of a view
  std::vector<float> sigmas_mm;
  std::vector<float> distances_mm;
  for (const DriftView& view : views) {
    for (const auto& surfel : pick_surfels(view.map, kSamples)) {
      sigmas_mm.push_back(surfel.sigma_mm);
      distances_mm.push_back(surfel.point_mm.norm());
    }
  }
  if (sigmas_mm.empty()) throw Error(ErrorKind::Numeric, "refine_rig: the views hold no surface");
  return {static_cast<double>(median(std::move(distances_mm))),
          static_cast<double>(median(std::move(sigmas_mm)))};
}

namespace {

/// Factors of the standard deviations of a group that is not as stated, and of all groups: a rig of
/// which everything is far off is less to be expected than one with a wrong lens.
constexpr std::array<double, 3> kWidenings{3.0, 10.0, 30.0};
constexpr double kAllWider = 3.0;
/// Natural logarithm of the odds that one of the groups is not, before the surfaces are seen.
constexpr double kDriftNotAsStated = -6.9;

/// The evidence about no change of the rig.
DriftEvidence from_zero(const DriftEvidence& evidence, const Eigen::VectorXd& w) {
  return {evidence.hessian, evidence.gradient - product(evidence.hessian, w)};
}

/// Natural logarithm of the evidence of a prior of w, over that of no change at all.
double log_evidence(const DriftEvidence& about_zero, const Eigen::MatrixXd& factor) {
  Eigen::MatrixXd hessian = congruence(factor, about_zero.hessian);
  hessian.diagonal().array() += 1.0;
  const Cholesky factors(hessian);
  const Eigen::VectorXd gradient = transposed_product(factor, about_zero.gradient);
  return 0.5 * (gradient.dot(factors.solve(gradient)) - factors.log_determinant());
}

}  // namespace

Eigen::VectorXd widening_by_evidence(const DriftHypotheses& hypotheses,
                                     const DriftEvidence& evidence,
                                     const Eigen::VectorXd& w) {
  const DriftEvidence about_zero = from_zero(evidence, w);
  const Eigen::VectorXd none = Eigen::VectorXd::Ones(hypotheses.parameters);
  std::vector<Eigen::VectorXd> widenings{none, kAllWider * none};
  const double rare =
      kDriftNotAsStated -
      std::log(static_cast<double>(1 + hypotheses.groups.size() * kWidenings.size()));
  std::vector<double> log_odds{
      log_evidence(about_zero, hypotheses.factor(none)),
      rare + log_evidence(about_zero, hypotheses.factor(kAllWider * none))};
  for (const std::vector<Eigen::Index>& group : hypotheses.groups) {
    for (const double wider : kWidenings) {
      Eigen::VectorXd widening = none;
      for (const Eigen::Index parameter : group)
        widening[parameter] = wider;
      log_odds.push_back(rare + log_evidence(about_zero, hypotheses.factor(widening)));
      widenings.push_back(std::move(widening));
    }
  }
  const double most = *std::max_element(log_odds.begin(), log_odds.end());
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(hypotheses.parameters);
  double sum = 0.0;
  for (std::size_t i = 0; i < log_odds.size(); ++i) {
    const double odds = std::exp(log_odds[i] - most);
    squares += odds * widenings[i].cwiseAbs2();
    sum += odds;
  }
  return (squares / sum).cwiseSqrt();
}

double gain_by_widening(const DriftHypotheses& hypotheses,
                        const DriftEvidence& evidence,
                        const Eigen::VectorXd& w,
                        const Eigen::VectorXd& widening) {
  const DriftEvidence about_zero = from_zero(evidence, w);
  const Eigen::MatrixXd factor = hypotheses.factor(widening);
  Eigen::MatrixXd hessian = congruence(factor, about_zero.hessian);
  hessian.diagonal().array() += 1.0;
  const Eigen::VectorXd gradient = transposed_product(factor, about_zero.gradient);
  const Eigen::VectorXd likely = -product(factor, Cholesky(hessian).solve(gradient));
  const auto loss = [&](const Eigen::VectorXd& at) {
    return at.dot(0.5 * product(about_zero.hessian, at) + about_zero.gradient);
  };
  return 2.0 * (loss(w) - loss(likely));
}

}  // namespace frangia
