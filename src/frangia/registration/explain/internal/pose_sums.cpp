#include "frangia/registration/explain/internal/pose_sums.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "frangia/core/parallel.h"
#include "frangia/geometry/robust_gauss_newton.h"
#include "frangia/registration/internal/surfel_pair.h"

namespace frangia {
namespace {

using Row6 = Eigen::Matrix<double, 6, 1>;

constexpr std::size_t kPosesPerChunk = 512;  // surfels; fixed: sums do not depend on threads

/// Sums over one chunk of a view's surfels. Its unknowns: the view itself, its paired views, the
/// rig.
struct PoseChunk {
  NormalEquations equations;
  double weight = 0.0;
  double squares = 0.0;
  std::vector<Eigen::VectorXd> rows;  ///< by paired view
  std::vector<float> distances_mm;
  std::vector<float> over_sigma;
  std::size_t matched = 0;
  std::size_t observed = 0;
  std::vector<PairTally> tallies;
};

Row6 row_of_motion(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  Row6 row;
  row << point.cross(normal), normal;
  return row;
}

class PoseAccumulator {
 public:
  PoseAccumulator(const Bundle& bundle, const PosedViews& views, std::size_t from, double margin_mm)
      : bundle_(bundle),
        views_(views),
        from_(from),
        margin_mm_(margin_mm),
        rig_columns_(views.rig == nullptr ? 0 : 2 * views.rig->count) {
    const std::size_t others = bundle.pairs[from].size();
    const auto count = static_cast<Eigen::Index>(6 * (others + 1)) + rig_columns_;
    sums.equations = {Eigen::MatrixXd::Zero(count, count), Eigen::VectorXd::Zero(count)};
    sums.tallies.resize(others);
    sums.rows.assign(others, Eigen::VectorXd::Zero(12 + rig_columns_));
    for (const std::size_t to : bundle.pairs[from])
      rig_from_object_.push_back(views.object_from_rig[to].inverse());
    by_rig_ = Eigen::VectorXd::Zero(rig_columns_);
  }

  void add(const SurfelMap::Surfel& surfel) {
    const Eigen::Isometry3d& own = views_.object_from_rig[from_];
    const Eigen::Vector3d seen = surfel.point_mm.cast<double>();
    const Eigen::Vector3d point = own * seen;
    const Eigen::Vector3d facing = own.linear() * surfel.normal.cast<double>();
    has_own_drift_ = false;
    bool observed = false;
    bool matched = false;
    for (std::size_t i = 0; i < rig_from_object_.size(); ++i) {
      const double distance = add_pair(surfel, point, facing, i);
      observed = observed || !std::isnan(distance);
      matched = matched || distance < bundle_.gate_mm;
    }
    sums.observed += observed ? 1U : 0U;
    sums.matched += matched ? 1U : 0U;
  }

  PoseChunk sums;

 private:
  double add_pair(const SurfelMap::Surfel& surfel,
                  const Eigen::Vector3d& point,
                  const Eigen::Vector3d& facing,
                  std::size_t paired) {
    const std::size_t to = bundle_.pairs[from_][paired];
    const Eigen::Isometry3d& rig_from_object = rig_from_object_[paired];
    const Eigen::Vector3d there = rig_from_object * point;
    const SurfelMap::Surfel* target = surfel_at(bundle_.maps[to], bundle_.model, there);
    if (target == nullptr) return std::nan("");
    const Eigen::Vector3d towards = rig_from_object.linear() * facing;
    const SurfelPair pair(there, towards, *target);
    PairTally& tally = sums.tallies[paired];
    const double variance = std::pow(static_cast<double>(surfel.sigma_mm), 2) +
                            std::pow(static_cast<double>(target->sigma_mm), 2);
    tally.violations +=
        pair.violates_free_space(SurfelPair::margin_mm(margin_mm_, variance)) ? 1U : 0U;
    if (towards.dot(there) >= 0.0 || !pair.faces_alike()) return std::nan("");
    const double distance = pair.distance_mm();
    if (!(std::abs(distance) < bundle_.gate_mm)) return std::abs(distance);
    const double weight = tukey_weight(distance, bundle_.gate_mm) / variance;
    const Eigen::Isometry3d& back = views_.object_from_rig[to];
    const Eigen::Vector3d normal = back.linear() * pair.normal;
    const Eigen::Vector3d foot = back * target->point_mm.cast<double>();
    if (rig_columns_ > 0) differentiate_by_rig(surfel, *target, normal, pair.normal, to);
    add_equation(
        row_of_motion(point, normal), -row_of_motion(foot, normal), weight, distance, paired);
    tally.add({1, 0, weight, weight * distance});
    sums.weight += weight;
    sums.squares += weight * distance * distance;
    sums.distances_mm.push_back(static_cast<float>(std::abs(distance)));
    sums.over_sigma.push_back(static_cast<float>(std::abs(distance) / std::sqrt(variance)));
    return std::abs(distance);
  }

  void differentiate_by_rig(const SurfelMap::Surfel& surfel,
                            const SurfelMap::Surfel& target,
                            const Eigen::Vector3d& normal,
                            const Eigen::Vector3d& normal_to,
                            std::size_t to) {
    const RigChanges& rig = *views_.rig;
    if (!has_own_drift_) {
      own_drift_ =
          rig.drift.of(surfel.point_mm.cast<double>(), rig.pattern).transpose().cast<double>();
    }
    has_own_drift_ = true;
    const Eigen::VectorXd by_own =
        own_drift_ * (views_.object_from_rig[from_].linear().transpose() * normal);
    const Eigen::VectorXd by_other =
        rig.drift.of(target.point_mm.cast<double>(), rig.pattern).transpose().cast<double>() *
        normal_to;
    by_rig_.head(rig.count) = by_own - by_other;
    by_rig_.tail(rig.count) = rig.times[from_] * by_own - rig.times[to] * by_other;
  }

  void add_equation(
      const Row6& own, const Row6& other, double weight, double distance, std::size_t paired) {
    Eigen::MatrixXd& hessian = sums.equations.hessian;
    Eigen::VectorXd& gradient = sums.equations.gradient;
    const auto at = static_cast<Eigen::Index>(6 * (paired + 1));
    const Row6 weighted = weight * own;
    const Row6 weighted_other = weight * other;
    hessian.topLeftCorner<6, 6>() += weighted * own.transpose();
    hessian.block<6, 6>(at, 0) += weighted_other * own.transpose();
    hessian.block<6, 6>(at, at) += weighted_other * other.transpose();
    sums.rows[paired].head<6>() += weighted;
    sums.rows[paired].segment<6>(6) += weighted_other;
    sums.rows[paired].tail(rig_columns_) += weight * by_rig_;
    gradient.head<6>() += distance * weighted;
    gradient.segment<6>(at) += distance * weighted_other;
    if (rig_columns_ == 0) return;
    hessian.bottomLeftCorner(rig_columns_, 6) += by_rig_ * weighted.transpose();
    hessian.block(hessian.rows() - rig_columns_, at, rig_columns_, 6) +=
        by_rig_ * weighted_other.transpose();
    hessian.bottomRightCorner(rig_columns_, rig_columns_) += weight * by_rig_ * by_rig_.transpose();
    gradient.tail(rig_columns_) += weight * distance * by_rig_;
  }

  const Bundle& bundle_;
  const PosedViews& views_;
  std::size_t from_;
  double margin_mm_;
  Eigen::Index rig_columns_;
  std::vector<Eigen::Isometry3d> rig_from_object_;  ///< of the paired views
  Eigen::MatrixXd own_drift_;  ///< of the surfel by the changes of the rig, changes x 3
  bool has_own_drift_ = false;
  Eigen::VectorXd by_rig_;
};

/// Adds a chunk's equations, of which the lower triangle is known, to those of all views.
void add_equations(NormalEquations& all,
                   const NormalEquations& part,
                   std::size_t from,
                   const std::vector<std::size_t>& others) {
  const std::size_t blocks = others.size() + 1;
  const auto rig = part.gradient.size() - static_cast<Eigen::Index>(6 * blocks);
  struct Block {
    Eigen::Index at, to, size;
  };
  std::vector<Block> places;
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t view = block == 0 ? from : others[block - 1];
    places.push_back(
        {static_cast<Eigen::Index>(6 * block), static_cast<Eigen::Index>(6 * view), 6});
  }
  if (rig > 0) places.push_back({part.gradient.size() - rig, all.gradient.size() - rig, rig});
  for (std::size_t a = 0; a < places.size(); ++a) {
    const Block& row = places[a];
    all.gradient.segment(row.to, row.size) += part.gradient.segment(row.at, row.size);
    for (std::size_t b = 0; b <= a; ++b) {
      const Block& column = places[b];
      const auto value = part.hessian.block(row.at, column.at, row.size, column.size);
      all.hessian.block(row.to, column.to, row.size, column.size) += value;
      if (a != b) all.hessian.block(column.to, row.to, column.size, row.size) += value.transpose();
    }
  }
}

void add_fit(PoseSums& sums,
             std::size_t from,
             std::size_t region,
             const std::vector<std::size_t>& others,
             PoseChunk& part) {
  BundleSums& all = sums.fit;
  sums.weight += part.weight;
  sums.squares += part.squares;
  all.distances_mm.insert(
      all.distances_mm.end(), part.distances_mm.begin(), part.distances_mm.end());
  all.over_sigma.insert(all.over_sigma.end(), part.over_sigma.begin(), part.over_sigma.end());
  part.distances_mm = {};
  part.over_sigma = {};
  all.matched[from] += part.matched;
  all.observed[from] += part.observed;
  for (std::size_t i = 0; i < others.size(); ++i) {
    const std::size_t pair = from * all.matched.size() + others[i];
    const std::size_t at = kRegionsPerView * pair + region;
    all.regions[at].add(part.tallies[i]);
    if (part.tallies[i].agree == 0) continue;
    if (sums.region_rows[at].size() == 0) sums.region_rows[at].setZero(part.rows[i].size());
    sums.region_rows[at] += part.rows[i];
  }
}

}  // namespace

std::vector<float> PoseSums::region_means_mm(const Eigen::VectorXd& motion,
                                             std::size_t fewest) const {
  std::vector<float> means_mm;
  const std::size_t views = fit.matched.size();
  for (std::size_t i = 0; i < fit.regions.size(); ++i) {
    if (fit.regions[i].agree < fewest) continue;
    const std::size_t pair = i / kRegionsPerView;
    const auto from = static_cast<Eigen::Index>(6 * (pair / views));
    const auto to = static_cast<Eigen::Index>(6 * (pair % views));
    const Eigen::VectorXd& row = region_rows[i];
    const Eigen::Index rig = row.size() - 12;
    const double sum = fit.regions[i].weighted_mm + row.head<6>().dot(motion.segment<6>(from)) +
                       row.segment<6>(6).dot(motion.segment<6>(to)) +
                       row.tail(rig).dot(motion.tail(rig));
    means_mm.push_back(static_cast<float>(sum / fit.regions[i].weight));
  }
  return means_mm;
}

NormalEquations PoseSums::all() const {
  return {halves[0].hessian + halves[1].hessian, halves[0].gradient + halves[1].gradient};
}

PoseSums sum_poses(const Bundle& bundle, const SurfelLists& surfels, const PosedViews& views) {
  struct Place {
    std::size_t view;
    std::size_t first;
  };
  std::vector<Place> places;
  for (std::size_t view = 0; view < surfels.size(); ++view) {
    for (std::size_t first = 0; first < surfels[view].size(); first += kPosesPerChunk)
      places.push_back({view, first});
  }
  const double margin_mm = free_space_margin_mm(bundle);
  std::vector<PoseChunk> parts(places.size());
  parallel_chunks(places.size(), 1, [&](std::size_t begin, std::size_t /*end*/) {
    const auto [view, first] = places[begin];
    PoseAccumulator accumulator(bundle, views, view, margin_mm);
    const std::size_t end = std::min(first + kPosesPerChunk, surfels[view].size());
    for (std::size_t i = first; i < end; ++i)
      accumulator.add(surfels[view][i]);
    parts[begin] = std::move(accumulator.sums);
  });
  const auto count = static_cast<Eigen::Index>(6 * bundle.maps.size()) +
                     (views.rig == nullptr ? 0 : 2 * views.rig->count);
  PoseSums all;
  for (NormalEquations& half : all.halves)
    half = {Eigen::MatrixXd::Zero(count, count), Eigen::VectorXd::Zero(count)};
  all.fit.matched.assign(bundle.maps.size(), 0);
  all.fit.observed.assign(bundle.maps.size(), 0);
  all.fit.regions.resize(kRegionsPerView * bundle.maps.size() * bundle.maps.size());
  all.region_rows.resize(all.fit.regions.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [view, first] = places[i];
    const std::size_t region = kRegionsPerView * first / surfels[view].size();
    const std::vector<std::size_t>& others = bundle.pairs[view];
    add_equations(all.halves.at(region % 2), parts[i].equations, view, others);
    add_fit(all, view, region, others, parts[i]);
  }
  return all;
}

}  // namespace frangia
