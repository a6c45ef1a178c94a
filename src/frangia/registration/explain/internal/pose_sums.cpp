#include "frangia/registration/explain/internal/pose_sums.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "frangia/core/parallel.h"
#include "frangia/geometry/robust_gauss_newton.h"
#include "frangia/registration/internal/sum_ties.h"
#include "frangia/registration/internal/surfel_pair.h"

namespace frangia {
namespace {

using Row6 = Eigen::Matrix<double, 6, 1>;

/// Sums over one chunk of a view's surfels. Its unknowns: six of the view itself and the changes of
/// the rig in it, then the same of each paired view.
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

/// @shape    `size`: unknowns of a view, where it is known
template <int size>
using ViewRow = Eigen::Matrix<double, size, 1>;

Row6 row_of_motion(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  Row6 row;
  row << point.cross(normal), normal;
  return row;
}

template <int size>
class PoseAccumulator {
 public:
  PoseAccumulator(const Bundle& bundle, const PosedViews& views, std::size_t from, double margin_mm)
      : bundle_(bundle),
        views_(views),
        from_(from),
        margin_mm_(margin_mm),
        own_(6 + (views.rig == nullptr ? 0 : views.rig->count)),
        other_(own_.size()) {
    const std::size_t others = bundle.pairs[from].size();
    const Eigen::Index count = own_.size() * static_cast<Eigen::Index>(others + 1);
    sums.equations = {Eigen::MatrixXd::Zero(count, count), Eigen::VectorXd::Zero(count)};
    sums.tallies.resize(others);
    sums.rows.assign(others, Eigen::VectorXd::Zero(2 * own_.size()));
    for (const std::size_t to : bundle.pairs[from])
      rig_from_object_.push_back(views.object_from_rig[to].inverse());
  }

  void add(const SurfelMap::Surfel& surfel) {
    const Eigen::Isometry3d& own = views_.object_from_rig[from_];
    const Eigen::Vector3d seen = surfel.point_mm.cast<double>();
    const Eigen::Vector3d point = own * seen;
    const Eigen::Vector3d facing = own.linear() * surfel.normal.cast<double>();
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
    const Eigen::Vector3d middle = back * pair.middle;
    own_.template head<6>() = row_of_motion(middle, normal);
    other_.template head<6>() = -own_.template head<6>();
    if (views_.rig != nullptr) {
      const Eigen::Isometry3d& own = views_.object_from_rig[from_];
      own_.tail(views_.rig->count) =
          row_of_rig(own.inverse() * middle, own.linear().transpose() * normal);
      other_.tail(views_.rig->count) = -row_of_rig(pair.middle, pair.normal);
    }
    add_equation(weight, distance, paired);
    tally.add({1, 0, weight, weight * distance});
    sums.weight += weight;
    sums.squares += weight * distance * distance;
    sums.distances_mm.push_back(static_cast<float>(std::abs(distance)));
    sums.over_sigma.push_back(static_cast<float>(std::abs(distance) / std::sqrt(variance)));
    return std::abs(distance);
  }

  [[nodiscard]] Eigen::VectorXd row_of_rig(const Eigen::Vector3d& point,
                                           const Eigen::Vector3d& normal) const {
    const RigChanges& rig = *views_.rig;
    return rig.field.of(point).transpose().cast<double>() * normal;
  }

  void add_equation(double weight, double distance, std::size_t paired) {
    Eigen::MatrixXd& hessian = sums.equations.hessian;
    Eigen::VectorXd& gradient = sums.equations.gradient;
    const Eigen::Index n = own_.size();
    const Eigen::Index at = n * static_cast<Eigen::Index>(paired + 1);
    const ViewRow<size> weighted = weight * own_;
    const ViewRow<size> weighted_other = weight * other_;
    hessian.template block<size, size>(0, 0, n, n).noalias() += weighted * own_.transpose();
    hessian.template block<size, size>(at, 0, n, n).noalias() += weighted_other * own_.transpose();
    hessian.template block<size, size>(at, at, n, n).noalias() +=
        weighted_other * other_.transpose();
    sums.rows[paired].head(n) += weighted;
    sums.rows[paired].tail(n) += weighted_other;
    gradient.head(n) += distance * weighted;
    gradient.segment(at, n) += distance * weighted_other;
  }

  const Bundle& bundle_;
  const PosedViews& views_;
  std::size_t from_;
  double margin_mm_;
  ViewRow<size> own_;    ///< derivatives of a distance by the unknowns of its view
  ViewRow<size> other_;  ///< and of the paired view
  std::vector<Eigen::Isometry3d> rig_from_object_;  ///< of the paired views
};

/// Adds a chunk's equations, of which the lower triangle is known, to those of all views.
class EquationsOfViews {
 public:
  EquationsOfViews(std::size_t views, const RigChanges* rig)
      : rig_(rig),
        poses_(static_cast<Eigen::Index>(6 * views)),
        terms_(rig == nullptr ? 0 : rig->count) {}

  void add(NormalEquations& all,
           const NormalEquations& part,
           std::size_t from,
           const std::vector<std::size_t>& others) const {
    for (std::size_t block = 0; block <= others.size(); ++block) {
      const std::size_t view = block == 0 ? from : others[block - 1];
      const Eigen::Index at = (6 + terms_) * static_cast<Eigen::Index>(block);
      add_gradient(all.gradient, part.gradient.segment(at, 6 + terms_), view);
      add_block(all.hessian, part.hessian.block(at, at, 6 + terms_, 6 + terms_), view, view);
      if (block == 0) continue;
      const Eigen::MatrixXd across = part.hessian.block(at, 0, 6 + terms_, 6 + terms_);
      add_block(all.hessian, across, view, from);
      add_block(all.hessian, across.transpose(), from, view);
    }
  }
  [[nodiscard]] Eigen::Index unknowns() const {
    return poses_ + (rig_ == nullptr ? 0 : rig_->unknowns());
  }

 private:
  static Eigen::Index index_of(std::size_t view) { return static_cast<Eigen::Index>(6 * view); }

  void add_gradient(Eigen::VectorXd& all, const Eigen::VectorXd& part, std::size_t view) const {
    all.segment<6>(index_of(view)) += part.head<6>();
    for (Eigen::Index i = 0; rig_ != nullptr && i < rig_->basis.cols(); ++i)
      all.segment(poses_ + terms_ * i, terms_) += share(view, i) * part.tail(terms_);
  }
  void add_block(Eigen::MatrixXd& all,
                 const Eigen::MatrixXd& part,
                 std::size_t row,
                 std::size_t column) const {
    all.block<6, 6>(index_of(row), index_of(column)) += part.topLeftCorner<6, 6>();
    if (rig_ == nullptr) return;
    for (Eigen::Index i = 0; i < rig_->basis.cols(); ++i) {
      const Eigen::Index at = poses_ + terms_ * i;
      if (share(column, i) != 0.0) {
        all.block(index_of(row), at, 6, terms_) +=
            share(column, i) * part.topRightCorner(6, terms_);
      }
      if (share(row, i) == 0.0) continue;
      all.block(at, index_of(column), terms_, 6) +=
          share(row, i) * part.bottomLeftCorner(terms_, 6);
      for (Eigen::Index j = 0; j < rig_->basis.cols(); ++j) {
        const double both = share(row, i) * share(column, j);
        if (both == 0.0) continue;
        all.block(at, poses_ + terms_ * j, terms_, terms_) +=
            both * part.bottomRightCorner(terms_, terms_);
      }
    }
  }
  [[nodiscard]] double share(std::size_t view, Eigen::Index function) const {
    return rig_->basis(static_cast<Eigen::Index>(view), function);
  }

  const RigChanges* rig_;
  Eigen::Index poses_;
  Eigen::Index terms_;
};

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
  const Eigen::Index rig = motion.size() - static_cast<Eigen::Index>(6 * views);
  const Eigen::MatrixXd of_rig = rig == 0 ? Eigen::MatrixXd(0, static_cast<Eigen::Index>(views))
                                          : changes_of_views(motion.tail(rig), rig_basis);
  const auto moved = [&](const auto& row, std::size_t view) {
    const auto at = static_cast<Eigen::Index>(view);
    return row.template head<6>().dot(motion.segment<6>(6 * at)) +
           row.tail(row.size() - 6).dot(of_rig.col(at));
  };
  for (std::size_t i = 0; i < fit.regions.size(); ++i) {
    if (fit.regions[i].agree < fewest) continue;
    const std::size_t pair = i / kRegionsPerView;
    const Eigen::VectorXd& row = region_rows[i];
    const double sum = fit.regions[i].weighted_mm + moved(row.head(row.size() / 2), pair / views) +
                       moved(row.tail(row.size() / 2), pair % views);
    means_mm.push_back(static_cast<float>(sum / fit.regions[i].weight));
  }
  return means_mm;
}

NormalEquations PoseSums::all() const {
  return {halves[0].hessian + halves[1].hessian, halves[0].gradient + halves[1].gradient};
}

PoseSums sum_poses(const Bundle& bundle, const SurfelLists& surfels, const PosedViews& views) {
  const std::vector<SurfelChunk> places = chunks_of(surfels);
  const double margin_mm = free_space_margin_mm(bundle);
  std::vector<PoseChunk> parts(places.size());
  const auto sum_chunk = [&](auto accumulator, const SurfelChunk& place) {
    for (std::size_t i = place.first; i < place.first + place.count; ++i)
      accumulator.add(surfels[place.view][i]);
    return std::move(accumulator.sums);
  };
  parallel_chunks(places.size(), 1, [&](std::size_t begin, std::size_t /*end*/) {
    const SurfelChunk& place = places[begin];
    parts[begin] =
        views.rig == nullptr
            ? sum_chunk(PoseAccumulator<6>(bundle, views, place.view, margin_mm), place)
            : sum_chunk(PoseAccumulator<Eigen::Dynamic>(bundle, views, place.view, margin_mm),
                        place);
  });
  const EquationsOfViews of_views(bundle.maps.size(), views.rig);
  const Eigen::Index count = of_views.unknowns();
  PoseSums all;
  if (views.rig != nullptr) all.rig_basis = views.rig->basis;
  for (NormalEquations& half : all.halves)
    half = {Eigen::MatrixXd::Zero(count, count), Eigen::VectorXd::Zero(count)};
  all.fit.matched.assign(bundle.maps.size(), 0);
  all.fit.observed.assign(bundle.maps.size(), 0);
  all.fit.regions.resize(kRegionsPerView * bundle.maps.size() * bundle.maps.size());
  all.region_rows.resize(all.fit.regions.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const SurfelChunk& place = places[i];
    const std::vector<std::size_t>& others = bundle.pairs[place.view];
    // Opposite quarters: either half of a view is all over it.
    const std::size_t half = place.region == 0 || place.region == 3 ? 0 : 1;
    of_views.add(all.halves.at(half), parts[i].equations, place.view, others);
    add_fit(all, place.view, place.region, others, parts[i]);
  }
  return all;
}

NormalEquations sum_pose_ties(const Bundle& bundle, const PosedViews& views) {
  const EquationsOfViews of_views(bundle.maps.size(), views.rig);
  const Eigen::Index unknowns = of_views.unknowns();
  NormalEquations all{Eigen::MatrixXd::Zero(unknowns, unknowns), Eigen::VectorXd::Zero(unknowns)};
  const Eigen::Index size = 6 + (views.rig == nullptr ? 0 : views.rig->count);
  const auto row_of = [&](const Eigen::Isometry3d& object_from_rig,
                          const Eigen::Vector3d& point,
                          const Eigen::Vector3d& along) {
    Eigen::VectorXd row(size);
    row.head<6>() = row_of_motion(object_from_rig * point, along);
    if (views.rig != nullptr) {
      row.tail(views.rig->count) = views.rig->field.of(point).transpose().cast<double>() *
                                   (object_from_rig.linear().transpose() * along);
    }
    return row;
  };
  for (const PointTie& tie : bundle.ties) {
    const Eigen::Isometry3d& from = views.object_from_rig[tie.from];
    const Eigen::Isometry3d& to = views.object_from_rig[tie.to];
    const Eigen::Matrix3d covariance =
        from.linear() * tie.from_covariance_mm2 * from.linear().transpose() +
        to.linear() * tie.to_covariance_mm2 * to.linear().transpose();
    const TieResidual tied =
        tie_residual(from * tie.from_mm - to * tie.to_mm, covariance, tie.share);
    NormalEquations part{Eigen::MatrixXd::Zero(2 * size, 2 * size),
                         Eigen::VectorXd::Zero(2 * size)};
    for (Eigen::Index i = 0; i < 3; ++i) {
      Eigen::VectorXd row(2 * size);
      row << row_of(from, tie.from_mm, tied.axes.col(i)), -row_of(to, tie.to_mm, tied.axes.col(i));
      part.hessian += tied.information[i] * row * row.transpose();
      part.gradient += tied.information[i] * tied.away_mm[i] * row;
    }
    of_views.add(all, part, tie.from, {tie.to});
  }
  return all;
}

}  // namespace frangia
