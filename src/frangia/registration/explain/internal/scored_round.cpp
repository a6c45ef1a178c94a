#include "frangia/registration/explain/internal/scored_round.h"

#include <utility>

#include <Eigen/Cholesky>

#include "frangia/registration/explain/internal/cause_motions.h"
#include "frangia/registration/explain/internal/pose_round.h"
#include "frangia/registration/explain/internal/time_profiles.h"

namespace frangia {
namespace {

/// Of a fault before the scan is looked at: one scan in twenty has one.
constexpr double kFaultsAreRare = -3.0;
/// Of a turntable that is not as stated: the last hypothesis.
constexpr double kStatementsHold = -4.6;
/// Share of its effect by which a simpler cause may differ from one that explains more.
constexpr double kAlike = 0.05;
/// The same between a change of the rig all through the scan and one that differs from view to
/// view: from the rig that is stated, with which points hardly move linearly, and from one that was
/// found.
constexpr double kAlikeRigs = 0.25;
constexpr double kAlikeFoundRigs = 0.1;

/// Motions of the richest hypothesis: every view and the rig are elsewhere.
Eigen::MatrixXd everything(const PoseChart& chart, Eigen::Index unknowns) {
  const CauseHypothesis free{PoseCause::Unexplained, {}, 0.004 * chart.setting.distance_mm, 0.0};
  const Eigen::MatrixXd own = motions_of(free, chart.setting, unknowns);
  if (chart.setting.rig_changes == 0) return own;
  CauseHypothesis drift{PoseCause::RigDrift, {}, 1.0};
  drift.profile = kSmoothProfile;
  const Eigen::MatrixXd of_rig = motions_of(drift, chart.setting, unknowns);
  Eigen::MatrixXd both(unknowns, own.cols() + of_rig.cols());
  both << own, of_rig;
  return both;
}

double log_of_sum(double one, double other) {
  const double most = std::max(one, other);
  return most + std::log(std::exp(one - most) + std::exp(other - most));
}

/// The causes, each with a table that is nearly exact or not: either is as probable.
std::vector<ScoredCause> with_either_table(const PoseRound& round) {
  std::vector<ScoredCause> causes = score_causes(*round.evidence, round.chart.setting);
  const std::vector<ScoredCause> exact = score_causes(*round.exact, round.chart.setting);
  const double odds = round.exact->table_log_odds() - round.evidence->table_log_odds();
  double stated = 0.0;
  for (ScoredCause& cause : causes) {
    const auto same = std::find_if(exact.begin(), exact.end(), [&](const ScoredCause& other) {
      return other.cause == cause.cause;
    });
    if (same == exact.end()) continue;
    ScoredCause with_exact = *same;
    with_exact.log_odds += odds;
    with_exact.best.exact_table = true;
    for (CauseHypothesis& other : with_exact.others) {
      other.exact_table = true;
      other.log_odds += odds;
    }
    const double sum = log_of_sum(cause.log_odds, with_exact.log_odds);
    if (with_exact.log_odds > cause.log_odds) cause = std::move(with_exact);
    cause.log_odds = sum;
    if (cause.cause == PoseCause::AsStated) stated = sum;
  }
  for (ScoredCause& cause : causes) {
    cause.log_odds -= stated;
    for (CauseHypothesis& other : cause.others)
      other.log_odds -= stated;
  }
  return causes;
}

/// Whether a cause needs a change of axis or angles that their prior makes improbable.
bool leaves_prior(const PoseRound& round, const CauseHypothesis& cause) {
  constexpr double kUnlikely = 3.5;  // standard deviations of a change
  const auto own = static_cast<Eigen::Index>(round.chart.setting.views) + 3;
  Eigen::VectorXd table = round.posterior(cause).table;
  if (cause.exact_table) table = table.cwiseProduct(round.chart.exact_share).eval();
  return table.head(own).cwiseAbs().maxCoeff() > kUnlikely;
}

/// Prepares the equations of a round whose noise is known.
void weigh_with_noise(PoseRound& round) {
  NormalEquations data = from_stated(round.sums.all(), round.at());
  const Eigen::Index unknowns = data.gradient.size();
  data.hessian *= round.noise.scale;
  data.gradient *= round.noise.scale;
  if (const auto ties = round.ties()) data.add(*ties);
  round.exact.emplace(data, padded(round.chart.with_exact_table().table, unknowns));
  round.evidence.emplace(std::move(data), padded(round.chart.table, unknowns));
}

void score_weighed(PoseRound& round) {
  round.causes = with_either_table(round);
  for (ScoredCause& cause : round.causes) {
    double rare = cause.cause == PoseCause::AsStated ? 0.0 : kFaultsAreRare;
    if (cause.cause == PoseCause::Turntable) rare += kStatementsHold;
    cause.log_odds += rare;
    for (CauseHypothesis& other : cause.others)
      other.log_odds += rare;
  }
  std::stable_sort(
      round.causes.begin(), round.causes.end(), [](const ScoredCause& a, const ScoredCause& b) {
        return a.log_odds > b.log_odds;
      });
  for (const ScoredCause& cause : round.causes)
    round.motions.push_back(round.posterior(cause.best).motion);
}

}  // namespace

double PoseRound::surface_mm(const Eigen::VectorXd& difference) const {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Motion = Eigen::Matrix<double, 6, 1>;
  Matrix6 all = Matrix6::Zero();
  Motion product = Motion::Zero();
  double squares = 0.0;
  double views = 0.0;
  for (std::size_t view = 0; view < surfaces.size(); ++view) {
    const Motion own = difference.segment<6>(static_cast<Eigen::Index>(6 * view));
    all += surfaces[view];
    product += surfaces[view] * own;
    squares += own.dot(surfaces[view] * own);
    views += surfaces[view].isZero() ? 0.0 : 1.0;
  }
  if (views == 0.0) return 0.0;
  all.diagonal().array() += 1e-9 * all.trace();
  const double common = product.dot(all.ldlt().solve(product));
  return std::sqrt(std::max(0.0, squares - common) / views);
}

std::vector<Eigen::Matrix<double, 6, 6>> surfaces_of(
    const SurfelLists& surfels, const std::vector<Eigen::Isometry3d>& object_from_rig) {
  std::vector<Eigen::Matrix<double, 6, 6>> surfaces;
  for (std::size_t view = 0; view < surfels.size(); ++view) {
    Eigen::Matrix<double, 6, 6>& own = surfaces.emplace_back();
    own.setZero();
    for (const SurfelMap::Surfel& surfel : surfels[view]) {
      const Eigen::Vector3d point = object_from_rig[view] * surfel.point_mm.cast<double>();
      const Eigen::Vector3d normal = object_from_rig[view].linear() * surfel.normal.cast<double>();
      Eigen::Matrix<double, 6, 1> row;
      row << point.cross(normal), normal;
      own += row * row.transpose();
    }
    own /= static_cast<double>(std::max<std::size_t>(1, surfels[view].size()));
  }
  return surfaces;
}

void weigh(PoseRound& round) {
  const Eigen::VectorXd at = round.at();
  const NormalEquations data = from_stated(round.sums.all(), at);
  const Eigen::Index unknowns = data.gradient.size();
  const Eigen::MatrixXd table = padded(round.chart.table, unknowns);
  const PoseEvidence plain(data, table);
  const PosePosterior rich = plain.posterior(everything(round.chart, unknowns));
  round.noise = noise_after(round.bundle, round.sums, plain, at, rich.motion);
  // The number of changes that the data determines: MacKay 1992.
  const double determined =
      static_cast<double>(rich.changes.size()) - rich.changes_covariance.trace();
  round.noise.left_share = std::max(0.0, 1.0 - determined / std::max(1.0, round.noise.regions));
  weigh_with_noise(round);
}

void sum_pairs(PoseRound& round,
               const SurfelLists& surfels,
               const TurntableStations& given,
               const std::optional<DriftModel>& model,
               const Eigen::VectorXd& rig_at) {
  if (model) {
    round.rig_at = rig_at;
    round.rig = rig_changes(*model, *given.pattern, surfels, round.chart.setting.rig_basis, rig_at);
    PoseSetting& setting = round.chart.setting;
    setting.rig_changes = model->count();
    setting.projector_moves = model->by_motions_of_projector(setting.tilt_rad, setting.shift_mm);
  }
  const RigChanges* rig = round.rig ? &*round.rig : nullptr;
  round.sums = sum_poses(round.bundle, surfels, {round.poses, rig});
}

void score(PoseRound& round) {
  weigh(round);
  score_weighed(round);
}

void score_with(PoseRound& round, const PairNoise& noise) {
  round.noise = noise;
  weigh_with_noise(round);
  score_weighed(round);
}

double noticeable_mm(const PoseRound& round) {
  constexpr double kScatter = 0.2;     // of a pair
  constexpr double kOfPair = 0.75;     // of a pair, where nothing tells what they have in common
  constexpr double kLeastShare = 0.3;  // of the regions: fewer have been fitted
  const PairNoise& noise = round.noise;
  if (noise.left_share < kLeastShare)
    return std::max(kCommonErrors * noise.shared_mm, kOfPair * noise.scatter_mm);
  // The regions that are left scatter by less than all of them would.
  const double common_mm = noise.shared_mm / std::sqrt(noise.left_share);
  return std::max(kCommonErrors * common_mm, kScatter * noise.scatter_mm);
}

bool is_beyond_prior(const PoseRound& round) {
  return leaves_prior(round, {});
}

double effect_of(const PoseRound& round, std::size_t cause) {
  const bool explains_table =
      is_beyond_prior(round) && !leaves_prior(round, round.causes[cause].best);
  const Eigen::VectorXd& motion = round.motions[cause];
  return round.effect_mm(explains_table ? motion : Eigen::VectorXd(motion - round.stated()));
}

bool is_noticeable(const PoseRound& round, std::size_t cause) {
  // Views that all move by themselves follow what their rims have in common, too.
  constexpr double kEach = 1.5;
  const PoseCause of = round.causes[cause].cause;
  const bool each_moves = of == PoseCause::Unexplained || of == PoseCause::Wobble;
  return effect_of(round, cause) >= (each_moves ? kEach : 1.0) * noticeable_mm(round);
}

bool changes_rig(PoseCause cause) {
  return cause == PoseCause::Rig || cause == PoseCause::RigDrift || cause == PoseCause::RigMoved;
}

bool is_drift(PoseCause cause) {
  return cause == PoseCause::RigDrift || cause == PoseCause::PartDrift;
}

int freedom_of(PoseCause cause) {
  switch (cause) {
    case PoseCause::AsStated:
      return 0;
    case PoseCause::Turned:
    case PoseCause::AnglesScaled:
    case PoseCause::AnglesWrong:
      return 1;
    case PoseCause::PartMoved:
    case PoseCause::ViewMoved:
    case PoseCause::PartDrift:
    case PoseCause::TableMoved:
    case PoseCause::RigMoved:
      return 2;
    case PoseCause::Rig:
    case PoseCause::Turntable:
      return 3;
    case PoseCause::PartMovedTwice:
      return 5;
    case PoseCause::RigDrift:
    case PoseCause::ViewsMoved:
      return 6;
    case PoseCause::Wobble:  // differs by its size alone from views that are all elsewhere
    case PoseCause::Unexplained:
      break;
  }
  return 7;
}

bool are_alike(const PoseRound& round, const CauseMotion& one, const CauseMotion& other) {
  // The linearization of knocks and drifts, which differ between the views, has similar errors.
  const bool constant = one.cause == PoseCause::Rig || other.cause == PoseCause::Rig;
  const bool rigs = constant && changes_rig(one.cause) && changes_rig(other.cause);
  // A knock, which may be of all views but the first, is none of the errors of a linearization.
  const bool knocked = one.cause == PoseCause::RigMoved || other.cause == PoseCause::RigMoved;
  const double of_rigs = round.rig_at.isZero() && !knocked ? kAlikeRigs : kAlikeFoundRigs;
  const double share = rigs ? of_rigs : kAlike;
  const Eigen::VectorXd none = round.stated();
  const Eigen::VectorXd apart = one.motion - other.motion;
  const Eigen::VectorXd first = one.motion - none;
  const Eigen::VectorXd second = other.motion - none;
  if (round.effect_mm(apart) >= share * std::min(round.effect_mm(first), round.effect_mm(second)))
    return false;
  if (changes_rig(one.cause) || changes_rig(other.cause)) return true;
  return round.surface_mm(apart) <
         share * std::min(round.surface_mm(first), round.surface_mm(second));
}

bool are_alike(const PoseRound& round, std::size_t one, std::size_t other) {
  return are_alike(round,
                   {round.causes[one].cause, round.motions[one]},
                   {round.causes[other].cause, round.motions[other]});
}

std::size_t most_probable_of(const PoseRound& round) {
  std::size_t first = 0;
  while (round.causes[first].cause != PoseCause::AsStated && !is_noticeable(round, first))
    ++first;
  return first;
}

std::size_t winner_of(const PoseRound& round) {
  const std::size_t first = most_probable_of(round);
  std::size_t best = first;
  for (std::size_t i = first + 1; i < round.causes.size(); ++i) {
    const ScoredCause& cause = round.causes[i];
    if (cause.log_odds > kNamed && freedom_of(cause.cause) < freedom_of(round.causes[best].cause) &&
        are_alike(round, first, i))
      best = i;
  }
  return best;
}

bool predicts(const PoseRound& round, const CauseHypothesis& hypothesis) {
  double gain = 0.0;
  const Eigen::VectorXd at = round.at();
  const Eigen::Index unknowns = at.size();
  const Eigen::MatrixXd own = motions_of(hypothesis, round.chart.setting, unknowns);
  const std::optional<NormalEquations> ties = round.ties();
  for (std::size_t half = 0; half < 2; ++half) {
    const auto evidence = [&](std::size_t which) {
      NormalEquations data = from_stated(round.sums.halves.at(which), at);
      data.hessian *= round.noise.scale;
      data.gradient *= round.noise.scale;
      if (ties) data.add(*ties, 0.5);
      const PoseChart chart = hypothesis.exact_table ? round.chart.with_exact_table() : round.chart;
      return PoseEvidence(std::move(data), padded(chart.table, unknowns));
    };
    const PoseEvidence seen = evidence(half);
    const PoseEvidence unseen = evidence(1 - half);
    gain += unseen.loss(seen.posterior(Eigen::MatrixXd(unknowns, 0)).motion) -
            unseen.loss(seen.posterior(own).motion);
  }
  return gain > 0.0;
}

}  // namespace frangia
