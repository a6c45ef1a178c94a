#include "frangia/registration/explain/internal/spread_of_causes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "frangia/core/linear_algebra.h"

namespace frangia {
namespace {

using Rows6 = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// The rigid motion of a view that is nearest to how its points move with each change of the rig.
Rows6 rigid_part(const RigChanges& rig,
                 const std::vector<SurfelMap::Surfel>& surfels,
                 const Eigen::Isometry3d& object_from_rig) {
  constexpr std::size_t kSome = 300;  // surfels that represent the view
  constexpr double kAlong = 0.01;     // weight of motions along the surface
  const std::size_t step = surfels.size() / kSome + 1;
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(6, 6);
  Rows6 products = Rows6::Zero(6, rig.count);
  for (std::size_t i = 0; i < surfels.size(); i += step) {
    const Eigen::Vector3d seen = surfels[i].point_mm.cast<double>();
    const Eigen::Vector3d point = object_from_rig * seen;
    const Eigen::Vector3d normal = object_from_rig.linear() * surfels[i].normal.cast<double>();
    const Eigen::MatrixXd moved =
        product(object_from_rig.linear(), rig.field.of(seen).cast<double>());
    Eigen::Matrix<double, 3, 6> by;
    by << 0.0, point.z(), -point.y(), 1.0, 0.0, 0.0, -point.z(), 0.0, point.x(), 0.0, 1.0, 0.0,
        point.y(), -point.x(), 0.0, 0.0, 0.0, 1.0;
    const Eigen::Matrix3d weight =
        normal * normal.transpose() + kAlong * Eigen::Matrix3d::Identity();
    const Eigen::MatrixXd weighted = weight * by;
    squares += transposed_product(weighted, by);
    products += transposed_product(weighted, moved);
  }
  if (!(squares(5, 5) > 0.0)) return products;
  return solve_symmetric_columns(squares, products);
}

/// Motions of the views alone that are nearest to motions of views and rig.
class ViewsAlone {
 public:
  ViewsAlone(const PoseRound& scored, const Registration& work) {
    if (!scored.rig) return;
    for (std::size_t view = 0; view < work.surfels.size(); ++view)
      by_rig_.push_back(rigid_part(*scored.rig, work.surfels[view], scored.poses[view]));
    basis_ = scored.rig->basis;
  }

  [[nodiscard]] Eigen::MatrixXd of(const Eigen::MatrixXd& motions) const {
    const auto views = static_cast<Eigen::Index>(6 * by_rig_.size());
    if (by_rig_.empty() || motions.rows() == views) return motions;
    Eigen::MatrixXd all = motions.topRows(views);
    const Eigen::Index count = by_rig_.front().cols();
    for (std::size_t view = 0; view < by_rig_.size(); ++view) {
      Eigen::MatrixXd changes = Eigen::MatrixXd::Zero(count, motions.cols());
      for (Eigen::Index i = 0; i < basis_.cols(); ++i) {
        changes += basis_(static_cast<Eigen::Index>(view), i) *
                   motions.middleRows(views + count * i, count);
      }
      all.middleRows(static_cast<Eigen::Index>(6 * view), 6) += product(by_rig_[view], changes);
    }
    return all;
  }

 private:
  std::vector<Rows6> by_rig_;  ///< of each view; empty: the rig has no unknowns
  Eigen::MatrixXd basis_;
};

/// Whether odds below those from which on a cause is named count in full.
enum class SmallOdds : bool { Count, HardlyCount };

/// The probability of each cause or hypothesis of a round by the logarithm of its odds.
class Probabilities {
 public:
  explicit Probabilities(const PoseRound& scored, SmallOdds small = SmallOdds::Count)
      : most_(scored.causes.front().log_odds), small_(small) {
    for (const ScoredCause& cause : scored.causes)
      sum_ += std::exp(-behind(cause.log_odds));
  }
  [[nodiscard]] double of(double log_odds) const { return std::exp(-behind(log_odds)) / sum_; }

 private:
  /// By how much something is less probable than the best: a logarithm. Between faults, errors
  /// that surfaces have in common are taken for evidence, too, so that what is not decided is open.
  [[nodiscard]] double behind(double log_odds) const {
    constexpr double kOfSmall = 0.2;  // share that counts
    const double all = most_ - log_odds;
    if (small_ == SmallOdds::Count) return all;
    return all - (1.0 - kOfSmall) * std::min(all, kNamed);
  }

  double most_;
  SmallOdds small_;
  double sum_ = 0.0;
};

/// Causes that are less probable leave nothing open.
constexpr double kLeastProbable = 1e-3;

/// What two views have in common that the winner does not explain.
double left_mm(const PoseRound& scored, const Eigen::VectorXd& motion) {
  const PoseEvidence unscaled(from_stated(scored.sums.all(), scored.at()),
                              Eigen::MatrixXd(motion.size(), 0));
  const PairNoise noise = noise_after(scored.bundle, scored.sums, unscaled, scored.at(), motion);
  const double least_mm = scored.bundle.systematic_mm;
  return std::sqrt(std::max(0.0, noise.shared_mm * noise.shared_mm - least_mm * least_mm));
}

}  // namespace

ViewMotions PoseSpread::of_views() const {
  const Eigen::Index views = columns.rows() / 6;
  Rows6 common = Rows6::Zero(6, columns.cols());
  for (Eigen::Index view = 0; view < views; ++view)
    common += columns.middleRows(6 * view, 6) / static_cast<double>(views);
  ViewMotions motions;
  for (Eigen::Index view = 0; view < views; ++view)
    motions.emplace_back(columns.middleRows(6 * view, 6) - common);
  return motions;
}

PoseSpread operator+(const PoseSpread& one, const PoseSpread& other) {
  PoseSpread both{Eigen::MatrixXd(one.columns.rows(), one.columns.cols() + other.columns.cols())};
  both.columns << one.columns, other.columns;
  return both;
}

PoseSpread spread_of_winner(const PoseRound& scored,
                            const PosePosterior& won,
                            const Registration& work) {
  // Errors that the views have in common are those of views, not of their regions.
  const double wider = std::sqrt(static_cast<double>(kRegionsPerView));
  return {wider * ViewsAlone(scored, work).of(won.factor)};
}

PoseSpread spread_of_causes(const PoseRound& scored,
                            const ScoredCause& winner,
                            const Registration& work) {
  const Eigen::VectorXd own = scored.posterior(winner.best).motion;
  const auto views = static_cast<Eigen::Index>(6 * work.surfels.size());
  const ViewsAlone alone(scored, work);
  Eigen::MatrixXd columns(views, 0);
  // Also where the pairs speak for a fault that is not noticeable: along flat faces it is larger
  // than what they show.
  const bool faulty =
      winner.cause != PoseCause::AsStated || scored.causes.front().log_odds > kNamed;
  const Probabilities probability(scored, faulty ? SmallOdds::HardlyCount : SmallOdds::Count);
  const auto add = [&](double share, const CauseHypothesis& hypothesis) {
    if (share < kLeastProbable) return;
    const PosePosterior other = scored.posterior(hypothesis);
    // What axis and angles leave open by themselves is in sigma for every cause.
    const Eigen::Index open = other.changes.size();
    Eigen::MatrixXd changes(own.size(), open + 1);
    changes << other.factor.rightCols(open), other.motion - own;
    columns.conservativeResize(Eigen::NoChange, columns.cols() + open + 1);
    columns.rightCols(open + 1) = std::sqrt(share) * alone.of(changes);
  };
  for (const ScoredCause& cause : scored.causes) {
    double rest = probability.of(cause.log_odds);  // of its best hypothesis
    for (const CauseHypothesis& other : cause.others) {
      const double own_share = probability.of(other.log_odds);
      rest -= own_share;
      add(own_share, other);
    }
    if (cause.cause != winner.cause) add(rest, cause.best);
  }
  PoseSpread spread{std::move(columns)};
  const double shift_mm = left_mm(scored, own);
  if (!(shift_mm > scored.bundle.systematic_mm)) return spread;
  PoseSpread left{Eigen::MatrixXd::Zero(views, views / 2)};
  for (Eigen::Index view = 0; view < views / 6; ++view)
    left.columns.block<3, 3>(6 * view + 3, 3 * view).setIdentity();
  left.columns *= shift_mm / std::sqrt(2.0);  // of each of the two
  return spread + left;
}

RigCovariance open_rig(const PoseRound& scored,
                       const DriftModel& model,
                       const std::optional<PoseCause>& applied) {
  if (!scored.rig) return {};
  const Eigen::VectorXd mean = scored.rig->basis.colwise().mean();
  const Eigen::Index count = scored.rig->count;
  const auto views = static_cast<Eigen::Index>(6 * scored.poses.size());
  const auto mean_of_views = [&](const Eigen::MatrixXd& motions) {
    Eigen::MatrixXd changes = Eigen::MatrixXd::Zero(count, motions.cols());
    for (Eigen::Index i = 0; i < mean.size(); ++i)
      changes += mean[i] * motions.middleRows(views + count * i, count);
    return changes;
  };
  const Probabilities probability(scored, SmallOdds::HardlyCount);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
  for (const ScoredCause& cause : scored.causes) {
    const double share = probability.of(cause.log_odds);
    if (!changes_rig(cause.cause) || share < kLeastProbable) continue;
    const PosePosterior found = scored.posterior(cause.best);
    // Sound views have small errors in common, which some rig far off explains. Their evidence is
    // none about the rig, least of all about changes that no overlap shows: a rig that wins by
    // them alone is not noticeable. One that does not win is open as soon as it moves the views by
    // more than they have in common.
    const bool wins = cause.cause == scored.causes.front().cause;
    const double least_mm = wins ? noticeable_mm(scored) : scored.noise.shared_mm;
    if (scored.effect_mm(found.motion - scored.stated()) < least_mm) continue;
    const Eigen::MatrixXd open = mean_of_views(found.factor);
    covariance += share * product_transposed(open, open);
    if (applied == cause.cause) continue;
    const Eigen::VectorXd change = mean_of_views(found.motion);
    covariance += share * product_transposed(change, change);
  }
  if (covariance.isZero()) return {};
  return {model.parameters(), congruence(model.factor().transpose(), covariance)};
}

}  // namespace frangia
