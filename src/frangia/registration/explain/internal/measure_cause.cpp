#include "frangia/registration/explain/internal/measure_cause.h"

#include <algorithm>
#include <cmath>

#include "frangia/registration/explain/internal/cause_motions.h"
#include "frangia/registration/explain/internal/moved_rig.h"
#include "frangia/registration/explain/internal/time_profiles.h"

namespace frangia {
namespace {

/// The largest of the motions of the part that a cause consists of: how far its centre moved, and
/// how far it turned about it.
void measure_motion(PoseExplanation& explanation,
                    const PosePosterior& found,
                    const CauseHypothesis& cause,
                    double radius_mm) {
  constexpr double kTurns = 0.2;  // share of the motion that is a rotation worth a word
  double largest = -1.0;
  const Eigen::Matrix<double, 6, 1> scales = cause.scale * shares_of_motion(cause.slides);
  for (Eigen::Index at = 0; at < found.changes.size(); at += 6) {
    const Eigen::Matrix<double, 6, 1> motion = scales.cwiseProduct(found.changes.segment<6>(at));
    const Eigen::Vector3d arc = motion.head<3>();
    const Eigen::Vector3d way = motion.tail<3>();
    const double size = arc.squaredNorm() + way.squaredNorm();
    if (size < largest) continue;
    largest = size;
    // What no overlap sees of it counts, too.
    const Eigen::Matrix<double, 6, 1> variances =
        scales.cwiseAbs2().cwiseProduct(found.changes_covariance.diagonal().segment<6>(at));
    const double arc_sigma_mm = std::sqrt(variances.head<3>().sum());
    explanation.moved_mm = way.norm();
    explanation.moved_sigma_mm = std::sqrt(variances.tail<3>().sum());
    const bool turned = arc.norm() > 3.0 * arc_sigma_mm && arc.norm() > kTurns * std::sqrt(size);
    explanation.turned_rad = turned ? arc.norm() / radius_mm : kMissing;
    explanation.turned_sigma_rad = turned ? arc_sigma_mm / radius_mm : kMissing;
  }
}

/// What was knocked, by how much the part moved with it in the rig's frame, or would have, and how
/// far it turned.
void measure_knock(PoseExplanation& explanation,
                   const PosePosterior& found,
                   const CauseHypothesis& cause,
                   const PoseSetting& setting) {
  const bool is_rig = cause.cause == PoseCause::RigMoved;
  if (is_rig) {
    explanation.terms = {static_cast<MovedRig>(cause.profile) == MovedRig::Camera ? "camera"
                                                                                  : "projector"};
  }
  const Eigen::Vector3d center = setting.object_from_rig.front().inverse() * setting.center_mm;
  // Of the six own motions: rotations about the camera, then the motion of the part's centre.
  Eigen::Matrix<double, 6, 6> by = Eigen::Matrix<double, 6, 6>::Zero();
  for (int i = 0; i < 3; ++i) {
    by(i, i) = setting.tilt_rad;
    by.block<3, 1>(3, i) = setting.tilt_rad * Eigen::Vector3d::Unit(i).cross(center);
    by(3 + i, 3 + i) = setting.shift_mm;
  }
  by *= cause.scale;
  const Eigen::Matrix<double, 6, 1> motion = by * found.changes.head<6>();
  const Eigen::Matrix<double, 6, 1> variances =
      (by * found.changes_covariance.topLeftCorner<6, 6>() * by.transpose()).diagonal();
  explanation.moved_mm = motion.tail<3>().norm();
  explanation.moved_sigma_mm = std::sqrt(variances.tail<3>().sum());
  explanation.turned_rad = motion.head<3>().norm();
  explanation.turned_sigma_rad = std::sqrt(variances.head<3>().sum());
}

/// What the winner found, in numbers.
PoseExplanation measured(const PoseRound& round, std::size_t first, const Registration& work) {
  PoseExplanation explanation;
  const ScoredCause& winner = round.causes[first];
  explanation.best = winner.cause;
  const PosePosterior found = round.posterior(winner.best);
  const double scale = winner.best.scale;
  explanation.views = winner.best.views;
  explanation.effect_mm = effect_of(round, first);
  explanation.unexplained_mm = round.noise.shared_mm;
  if (is_drift(winner.cause)) {
    explanation.time_constant = time_constant_of(winner.best.profile);
    explanation.times_assumed = !are_times_stated(work.stations);
  }
  switch (winner.cause) {
    case PoseCause::Turned:
      // The points turn back by what the table has turned too far.
      explanation.turned_rad = -scale / round.chart.setting.radius_mm * found.changes[0];
      break;
    case PoseCause::AnglesScaled:
      explanation.scale = work.angle_factor * (1.0 - scale * found.changes[0]);
      break;
    case PoseCause::PartMoved:
    case PoseCause::PartMovedTwice:
    case PoseCause::ViewMoved:
    case PoseCause::ViewsMoved:
    case PoseCause::PartDrift:
      measure_motion(explanation, found, winner.best, round.chart.setting.radius_mm);
      break;
    case PoseCause::TableMoved:
    case PoseCause::RigMoved:
      measure_knock(explanation, found, winner.best, round.chart.setting);
      break;
    case PoseCause::Wobble:
      explanation.scale = scale;
      break;
    default:
      break;
  }
  return explanation;
}

/// The second best of the causes, and those that move the views as the winner does.
void compare(PoseExplanation& explanation, const PoseRound& round, std::size_t first) {
  const ScoredCause& winner = round.causes[first];
  const std::size_t most = most_probable_of(round);
  bool has_second = false;
  for (std::size_t i = most; i < round.causes.size(); ++i) {
    const ScoredCause& other = round.causes[i];
    if (i == first) continue;
    if (are_alike(round, first, i)) {
      if (freedom_of(other.cause) <= freedom_of(winner.cause) &&
          other.log_odds > winner.log_odds - kNamed)
        explanation.alike.push_back(other.cause);
    } else if (!has_second) {
      has_second = true;
      explanation.second = other.cause;
      explanation.log_odds = round.causes[most].log_odds - other.log_odds;
    }
  }
  // The same cause at other views counts against it, too.
  for (const CauseHypothesis& other : winner.others) {
    const double log_odds = winner.log_odds - other.log_odds;
    if (log_odds > std::min(kNamed, explanation.log_odds)) break;
    if (are_alike(round,
                  {winner.cause, round.motions[first]},
                  {winner.cause, round.posterior(other).motion}))
      continue;
    explanation.second = winner.cause;
    explanation.log_odds = log_odds;
    break;
  }
  explanation.log_odds_stated = winner.log_odds - round.log_odds_of(PoseCause::AsStated);
  explanation.decided = explanation.log_odds > kNamed && explanation.log_odds_stated > kNamed &&
                        predicts(round, winner.best);
}

}  // namespace

std::vector<std::string> terms_of(const DriftModel& model,
                                  const Eigen::MatrixXd& changes,
                                  bool drifts) {
  constexpr double kMost = 0.5;  // of the largest
  const Eigen::MatrixXd all = model.factor() * changes;
  const Eigen::VectorXd way = all.rowwise().maxCoeff() - all.rowwise().minCoeff();
  const Eigen::VectorXd prior = model.factor().rowwise().norm();
  const Eigen::VectorXd shares =
      (drifts ? way : all.col(0)).cwiseAbs().cwiseQuotient(prior.cwiseMax(1e-300));
  std::vector<std::string> names;
  for (Eigen::Index i = 0; i < shares.size(); ++i) {
    if (shares[i] > kMost * shares.maxCoeff())
      names.push_back(model.parameters()[static_cast<std::size_t>(i)]);
  }
  return names;
}

PoseExplanation explanation_by(const PoseRound& round,
                               std::size_t first,
                               const Registration& work) {
  PoseExplanation explanation = measured(round, first, work);
  compare(explanation, round, first);
  return explanation;
}

}  // namespace frangia
