#include "frangia/registration/internal/drift_bundle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "frangia/core/linear_algebra.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/robust_gauss_newton.h"
#include "frangia/registration/internal/surfel_pair.h"
#include "frangia/registration/internal/turntable_bundle.h"
#include "frangia/registration/internal/view_transfer.h"

namespace frangia {
namespace {

constexpr double kSigmaOfMedian = 1.4826;  // of the absolute values of normal residuals

/// Where the surfels of the views are in the state of a bundle. Those of a view that is compared
/// often are computed once.
class SurfelPlaces {
 public:
  /// `surfels` of each view are compared with the views that it is paired with.
  SurfelPlaces(const DriftBundle& bundle, std::size_t surfels)
      : bundle_(bundle),
        moved_((bundle.state.w - bundle.linearized_at).cast<float>()),
        known_(bundle.views.size()) {
    parallel_chunks(known_.size(), 1, [&](std::size_t view, std::size_t /*end*/) {
      const auto own = bundle.views[view].map.surfels.pixels();
      if (own.size() > 2 * surfels * bundle.pairs[view].size()) return;
      std::vector<Eigen::Vector3d> places(own.size());
      for (std::size_t i = 0; i < own.size(); ++i)
        if (own[i].sigma_mm > 0.0F) places[i] = of(view, i);
      known_[view] = std::move(places);
    });
  }

  /// That of a surfel of the map of a view.
  [[nodiscard]] Eigen::Vector3d of(std::size_t view, std::size_t surfel) const {
    if (!known_[view].empty()) return known_[view][surfel];
    const DriftView& own = bundle_.views[view];
    const Eigen::Vector3d point = own.map.surfels.pixels()[surfel].point_mm.cast<double>();
    return point + (own.field.of(point) * moved_).cast<double>();
  }

 private:
  const DriftBundle& bundle_;
  Eigen::VectorXf moved_;
  std::vector<std::vector<Eigen::Vector3d>> known_;  ///< by view; empty: computed when asked for
};

/// Sums one view against the views that it is paired with.
class ViewComparison {
 public:
  ViewComparison(const DriftBundle& bundle, const SurfelPlaces& places, std::size_t from)
      : bundle_(bundle),
        places_(places),
        from_view_(from),
        from_(bundle.views[from]),
        free_(bundle.free_directions.cast<float>()) {
    const Eigen::Index count = free_.cols() + bundle.state.table.unknowns();
    sums.hessian = Eigen::MatrixXd::Zero(count, count);
    sums.gradient = Eigen::VectorXd::Zero(count);
    sums.region_gradients =
        Eigen::MatrixXd::Zero(count, static_cast<Eigen::Index>(kRegionsPerView));
  }

  void compare_with(std::size_t other, std::size_t every) {
    const DriftView& to = bundle_.views[other];
    const ViewTransfer transfer(bundle_.state.table, from_.station, to.station);
    const auto own = from_.map.surfels.pixels();
    std::size_t present = 0;
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (own[i].sigma_mm > 0.0F && present++ % every == 0) add_pair(own[i], i, other, transfer);
    }
  }

  DriftSums sums;

 private:
  void add_pair(const SurfelMap::Surfel& surfel,
                std::size_t index,
                std::size_t other,
                const ViewTransfer& transfer) {
    const DriftView& to = bundle_.views[other];
    const auto width = static_cast<std::size_t>(from_.map.surfels.width());
    const auto height = static_cast<std::size_t>(from_.map.surfels.height());
    region_ = (2 * (index % width) < width ? 0 : 1) + (2 * (index / width) < height ? 0 : 2);
    const Eigen::Vector3d own = places_.of(from_view_, index);
    const Eigen::Vector3d point = transfer.apply(own);
    const SurfelMap::Surfel* found = surfel_at(to.map, bundle_.camera, point);
    if (found == nullptr) return;
    SurfelMap::Surfel target = *found;
    const auto at = static_cast<std::size_t>(found - to.map.surfels.pixels().data());
    target.point_mm = places_.of(other, at).cast<float>();
    const Eigen::Vector3d facing = transfer.rotation() * surfel.normal.cast<double>();
    const SurfelPair pair(point, facing, target);
    if (facing.dot(point) >= 0.0 || !pair.faces_alike()) return;
    const double distance = pair.distance_mm();
    if (!(std::abs(distance) < bundle_.gate_mm)) return;
    const double weight = tukey_weight(distance, bundle_.gate_mm) /
                          (std::pow(static_cast<double>(surfel.sigma_mm), 2) +
                           std::pow(static_cast<double>(target.sigma_mm), 2));
    const Eigen::Vector3f at_to = pair.normal.cast<float>();
    const Eigen::Vector3f at_from = (transfer.rotation().transpose() * pair.normal).cast<float>();
    const Eigen::Vector3d middle = own - 0.5 * (transfer.rotation().transpose() * pair.offset);
    const Eigen::VectorXf by_changes =
        from_.field.of(middle).transpose() * at_from - to.field.of(pair.middle).transpose() * at_to;
    const Eigen::VectorXd by_rig = (free_.transpose() * by_changes).cast<double>();
    add_row(by_rig, transfer.jacobian(pair.normal, middle), weight, distance, to.station);
    sums.distances_mm.push_back(static_cast<float>(std::abs(distance)));
  }

  void add_row(const Eigen::VectorXd& by_rig,
               const PairJacobian& by,
               double weight,
               double distance,
               std::size_t to) {
    indices_.clear();
    values_.clear();
    const auto add = [&](Eigen::Index unknown, double value) {
      indices_.push_back(unknown);
      values_.push_back(value);
    };
    const Eigen::Index table = by_rig.size();
    for (Eigen::Index i = 0; i < table; ++i)
      add(i, by_rig[i]);
    if (to != from_.station) {
      for (Eigen::Index i = 0; i < 2; ++i)
        add(table + i, by.tilt[i]);
      for (Eigen::Index i = 0; i < 2; ++i)
        add(table + 2 + i, by.shift[i]);
    }
    const std::size_t first = values_.size();  // the unknowns before it stand side by side
    if (to != from_.station) {
      if (to != 0) add(table + 3 + static_cast<Eigen::Index>(to), by.angle_to);
      if (from_.station != 0)
        add(table + 3 + static_cast<Eigen::Index>(from_.station), by.angle_from);
    }
    weighted_.resize(values_.size());
    for (std::size_t i = 0; i < values_.size(); ++i) {
      weighted_[i] = weight * values_[i];
      sums.gradient[indices_[i]] += weighted_[i] * distance;
      sums.region_gradients(indices_[i], region_) += weighted_[i] * distance;
    }
    for (std::size_t j = 0; j < values_.size(); ++j) {
      double* const column = &sums.hessian(0, indices_[j]);
      for (std::size_t i = 0; i < first; ++i)
        column[i] += weighted_[i] * values_[j];
      for (std::size_t i = first; i < values_.size(); ++i)
        column[indices_[i]] += weighted_[i] * values_[j];
    }
  }

  const DriftBundle& bundle_;
  const SurfelPlaces& places_;
  std::size_t from_view_;
  const DriftView& from_;
  Eigen::MatrixXf free_;
  Eigen::Index region_ = 0;  ///< of the surfel
  std::vector<Eigen::Index> indices_;
  std::vector<double> values_;
  std::vector<double> weighted_;
};

}  // namespace

double DriftSums::weight(const DriftBundle& bundle) const {
  if (distances_mm.empty()) return 0.0;
  const auto view_pairs = static_cast<double>(count_pairs(bundle.pairs));
  const double scatter = kSigmaOfMedian * static_cast<double>(median(distances_mm));
  const double independent = view_pairs * std::pow(bundle.noise_mm / bundle.systematic_mm, 2);
  const double excess = std::max(1.0, std::pow(scatter / bundle.noise_mm, 2));
  return std::min(1.0, independent / static_cast<double>(distances_mm.size())) / excess;
}

DriftSums sum_drift(const DriftBundle& bundle, std::size_t surfels) {
  const SurfelPlaces places(bundle, surfels);
  std::vector<DriftSums> parts(bundle.views.size());
  parallel_chunks(parts.size(), 1, [&](std::size_t view, std::size_t /*end*/) {
    const auto own = bundle.views[view].map.surfels.pixels();
    const auto present = static_cast<std::size_t>(
        std::count_if(own.begin(), own.end(), [](const auto& s) { return s.sigma_mm > 0.0F; }));
    ViewComparison comparison(bundle, places, view);
    for (const std::size_t other : bundle.pairs[view])
      comparison.compare_with(other, present / surfels + 1);
    parts[view] = std::move(comparison.sums);
  });
  DriftSums all = std::move(parts.front());
  const Eigen::Index regions = all.region_gradients.cols();
  all.region_gradients.conservativeResize(Eigen::NoChange,
                                          regions * static_cast<Eigen::Index>(parts.size()));
  for (std::size_t view = 1; view < parts.size(); ++view) {
    all.region_gradients.middleCols(regions * static_cast<Eigen::Index>(view), regions) =
        parts[view].region_gradients;
    all.hessian += parts[view].hessian;
    all.gradient += parts[view].gradient;
    all.distances_mm.insert(
        all.distances_mm.end(), parts[view].distances_mm.begin(), parts[view].distances_mm.end());
  }
  return all;
}

void optimize_drift(DriftBundle& bundle, std::size_t surfels, int max_iterations, const Run& run) {
  const Eigen::Index changes = bundle.free_directions.cols();
  const Eigen::VectorXd table_information = bundle.table_sigma.cwiseAbs2().cwiseInverse();
  const auto linearize = [&](double gate_mm) {
    bundle.gate_mm = gate_mm;
    DriftSums sums = sum_drift(bundle, surfels);
    const double weight = sums.weight(bundle);
    Linearization at;
    at.solvable = !sums.distances_mm.empty();
    if (!at.solvable) return at;
    at.hessian = weight * sums.hessian;
    at.hessian.diagonal().head(changes).array() += 1.0;
    at.hessian.diagonal().tail(table_information.size()) += table_information;
    at.gradient = weight * sums.gradient;
    at.gradient.head(changes) += transposed_product(bundle.free_directions, bundle.state.w);
    at.gradient.tail(table_information.size()) +=
        table_information.cwiseProduct(deviation(bundle.state.table, bundle.given));
    at.median_residual = static_cast<double>(median(std::move(sums.distances_mm)));
    return at;
  };
  const auto update = [&](const Eigen::VectorXd& step) {
    bundle.state.w += product(bundle.free_directions, step.head(changes));
    bundle.state.table = apply_update(bundle.state.table, step.tail(step.size() - changes));
  };
  const auto result = minimize_robustly(
      {linearize, update},
      {.gate = bundle.gate_mm, .min_gate = bundle.min_gate_mm, .max_iterations = max_iterations},
      run);
  bundle.gate_mm = result.gate;
}

namespace {

/// Equations of w and the table, reduced to those of w, with the prior of the table.
DriftEvidence without_table(const DriftBundle& bundle,
                            const Eigen::VectorXd& table_sigma,
                            Eigen::MatrixXd hessian,
                            Eigen::VectorXd gradient) {
  const Eigen::Index changes = bundle.free_directions.cols();
  const Eigen::Index table = table_sigma.size();
  const Eigen::VectorXd prior = table_sigma.cwiseAbs2().cwiseInverse();
  hessian.diagonal().tail(table) += prior;
  gradient.tail(table) += prior.cwiseProduct(deviation(bundle.state.table, bundle.given));
  const Eigen::MatrixXd across = hessian.topRightCorner(changes, table);
  const Eigen::MatrixXd by_table =
      solve_symmetric_columns(hessian.bottomRightCorner(table, table), across.transpose());
  const Eigen::MatrixXd& free = bundle.free_directions;
  return {
      congruence(free.transpose(),
                 hessian.topLeftCorner(changes, changes) - product(across, by_table)),
      product(free, gradient.head(changes) - transposed_product(by_table, gradient.tail(table)))};
}

}  // namespace

DriftEvidence evidence_of(const DriftBundle& bundle,
                          const DriftSums& sums,
                          const Eigen::VectorXd& table_sigma) {
  const double weight = sums.weight(bundle);
  return without_table(bundle, table_sigma, weight * sums.hessian, weight * sums.gradient);
}

Eigen::MatrixXd information_of(const DriftBundle& bundle, const DriftSums& sums) {
  const double weight = sums.weight(bundle);
  const Eigen::Index changes = bundle.free_directions.cols();
  // In units of the prior, so that one ridge suits all unknowns.
  Eigen::VectorXd unit = Eigen::VectorXd::Ones(changes + bundle.table_sigma.size());
  unit.tail(bundle.table_sigma.size()) = bundle.table_sigma;
  const Eigen::MatrixXd hessian = weight * scaled(sums.hessian, unit);
  const Eigen::MatrixXd pulls = weight * (unit.asDiagonal() * sums.region_gradients);
  const auto regions = static_cast<double>(pulls.cols());
  // The unknowns have been fitted to the same regions, and either view of a pair repeats an error.
  const double left = std::max(1.0, regions - static_cast<double>(hessian.rows()));
  Eigen::MatrixXd covariance = hessian + 2.0 * regions / left * product_transposed(pulls, pulls);
  covariance.diagonal().array() += 1e-9 * covariance.trace();
  const Eigen::MatrixXd all = product(hessian, solve_symmetric_columns(covariance, hessian));
  return without_table(bundle,
                       bundle.table_sigma,
                       scaled(0.5 * (all + all.transpose()), unit.cwiseInverse()),
                       Eigen::VectorXd::Zero(unit.size()))
      .hessian;
}

}  // namespace frangia
