#include "frangia/registration/explain/internal/pose_hypotheses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "frangia/core/symmetric_eigen.h"

namespace frangia {
namespace {

/// Standard deviations of a motion, as shares of the working distance: 5 um to 5 mm at 500 mm. Each
/// is as probable as the others, since the size of a slide is not known before.
constexpr std::array<double, 7> kMotions{1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2};
/// Of a table's play: 2.5 um to 0.05 mm at 500 mm.
constexpr std::array<double, 4> kPlay{5e-6, 1.5e-5, 5e-5, 1e-4};
/// Of views that are elsewhere, each by itself: 0.5 to 5 mm at 500 mm.
constexpr std::array<double, 3> kElsewhere{1e-3, 3e-3, 1e-2};
/// Of angles against those commanded.
constexpr std::array<double, 3> kAngleScales{1e-3, 1e-2, 1e-1};
/// Of the drift during a scan, over that since the calibration.
constexpr std::array<double, 3> kDrifts{0.1, 0.3, 1.0};

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Motions of points by changes of 1 mm: rotations about the part's centre by an arc of 1 mm, then
/// shifts.
Matrix6 motions_of_part(const PoseSetting& setting) {
  Matrix6 by = Matrix6::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d turn = Eigen::Vector3d::Unit(i) / setting.radius_mm;
    by.block<3, 1>(0, i) = turn;
    by.block<3, 1>(3, i) = setting.center_mm.cross(turn);
    by(3 + i, 3 + i) = 1.0;
  }
  return by;
}

/// A rotation about the table's axis by 1 rad.
Eigen::Matrix<double, 6, 1> turn_of_table() {
  return Eigen::Matrix<double, 6, 1>::Unit(2);
}

Eigen::MatrixXd repeated(const Eigen::MatrixXd& motions,
                         const Eigen::VectorXd& shares,
                         Eigen::Index unknowns) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(unknowns, motions.cols());
  for (Eigen::Index view = 0; view < shares.size(); ++view)
    all.middleRows(6 * view, 6) = shares[view] * motions;
  return all;
}

/// 1 for each view from `first` on.
Eigen::VectorXd from_on(std::size_t first, std::size_t views) {
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(views));
  shares.tail(static_cast<Eigen::Index>(views - first)).setOnes();
  return shares;
}

Eigen::VectorXd turned_angles(const PoseSetting& setting) {
  Eigen::VectorXd angles(static_cast<Eigen::Index>(setting.views));
  for (std::size_t view = 0; view < setting.views; ++view)
    angles[static_cast<Eigen::Index>(view)] = setting.angles_rad[view] - setting.angles_rad[0];
  return angles;
}

Eigen::MatrixXd unit_motions(PoseCause cause,
                             const std::vector<std::size_t>& at,
                             const PoseSetting& setting,
                             Eigen::Index unknowns) {
  const auto views = static_cast<Eigen::Index>(setting.views);
  const Eigen::Index rig = setting.rig_changes;
  Eigen::MatrixXd none(unknowns, 0);
  switch (cause) {
    case PoseCause::AsStated:
      return none;
    case PoseCause::Turntable: {
      Eigen::MatrixXd all = Eigen::MatrixXd::Zero(unknowns, setting.beyond_stated.cols());
      all.topRows(6 * views) = setting.beyond_stated;
      return all;
    }
    case PoseCause::Turned:
      return repeated(turn_of_table() / setting.radius_mm, from_on(at[0], setting.views), unknowns);
    case PoseCause::AnglesScaled:
      return repeated(turn_of_table(), turned_angles(setting), unknowns);
    case PoseCause::PartMoved:
      return repeated(motions_of_part(setting), from_on(at[0], setting.views), unknowns);
    case PoseCause::PartMovedTwice: {
      Eigen::MatrixXd all(unknowns, 12);
      all << unit_motions(PoseCause::PartMoved, {at[0]}, setting, unknowns),
          unit_motions(PoseCause::PartMoved, {at[1]}, setting, unknowns);
      return all;
    }
    case PoseCause::ViewMoved:
      return repeated(motions_of_part(setting),
                      Eigen::VectorXd::Unit(views, static_cast<Eigen::Index>(at[0])),
                      unknowns);
    case PoseCause::PartDrift:
      return repeated(motions_of_part(setting),
                      Eigen::Map<const Eigen::VectorXd>(setting.times.data(), views),
                      unknowns);
    case PoseCause::Wobble:
    case PoseCause::Unexplained: {
      Eigen::MatrixXd all = Eigen::MatrixXd::Zero(unknowns, 6 * views);
      for (Eigen::Index view = 0; view < views; ++view)
        all.block<6, 6>(6 * view, 6 * view) = motions_of_part(setting);
      return all;
    }
    case PoseCause::Rig: {
      Eigen::MatrixXd all = Eigen::MatrixXd::Zero(unknowns, rig);
      all.middleRows(6 * views, rig).setIdentity();
      return all;
    }
    case PoseCause::RigDrift: {
      // The rig may be as stated at the beginning, at the end or between: its mean change is half
      // of its drift.
      Eigen::MatrixXd all = Eigen::MatrixXd::Zero(unknowns, 2 * rig);
      all.bottomRightCorner(2 * rig, 2 * rig).setIdentity();
      all.block(6 * views, 0, rig, rig) *= 0.5;
      return all;
    }
  }
  return none;
}

/// Collects the hypotheses of all causes.
class CauseScores {
 public:
  void add(CauseHypothesis hypothesis) {
    Score& score = scores_[hypothesis.cause];
    score.log_odds.push_back(hypothesis.log_odds);
    if (score.log_odds.size() == 1 || hypothesis.log_odds > score.best.log_odds)
      score.best = std::move(hypothesis);
  }
  /// Adds hypotheses that differ by the standard deviation of their changes.
  template <std::size_t n>
  void add_scales(PoseCause cause,
                  const std::vector<std::size_t>& views,
                  const NormalEquations& data,
                  const std::array<double, n>& scales,
                  double unit) {
    for (const double share : scales) {
      const double scale = share * unit;
      add({cause,
           views,
           scale,
           PoseEvidence::log_odds(scale * scale * data.hessian, scale * data.gradient)});
    }
  }
  [[nodiscard]] std::vector<ScoredCause> sorted() const {
    std::vector<ScoredCause> all;
    for (const auto& [cause, score] : scores_) {
      const double most = score.best.log_odds;
      double sum = 0.0;
      for (const double odds : score.log_odds)
        sum += std::exp(odds - most);
      const double mean = most + std::log(sum / static_cast<double>(score.log_odds.size()));
      all.push_back({cause, mean, score.best});
    }
    std::stable_sort(all.begin(), all.end(), [](const ScoredCause& a, const ScoredCause& b) {
      return a.log_odds > b.log_odds;
    });
    return all;
  }

 private:
  struct Score {
    std::vector<double> log_odds;
    CauseHypothesis best;
  };
  std::map<PoseCause, Score> scores_;
};

NormalEquations project(const NormalEquations& data, const Eigen::MatrixXd& motions) {
  return {motions.transpose() * data.hessian * motions, motions.transpose() * data.gradient};
}

/// Equations in motions of the part that some views share, from those of each view.
class PartEquations {
 public:
  PartEquations(const NormalEquations& data, const PoseSetting& setting) : views_(setting.views) {
    const auto n = static_cast<Eigen::Index>(6 * views_);
    const Eigen::MatrixXd motions = unit_motions(PoseCause::Wobble, {}, setting, n);
    of_views_ = project({data.hessian.topLeftCorner(n, n), data.gradient.head(n)}, motions);
    // later(a, b): sum over the views from a on, and from b on.
    later_ = of_views_;
    for (Eigen::Index view = n - 12; view >= 0; view -= 6) {
      later_.hessian.middleRows(view, 6) += later_.hessian.middleRows(view + 6, 6);
      later_.gradient.segment<6>(view) += later_.gradient.segment<6>(view + 6);
    }
    for (Eigen::Index view = n - 12; view >= 0; view -= 6)
      later_.hessian.middleCols(view, 6) += later_.hessian.middleCols(view + 6, 6);
  }

  [[nodiscard]] const NormalEquations& of_views() const { return of_views_; }
  [[nodiscard]] NormalEquations of_view(std::size_t view) const { return part(of_views_, view); }
  [[nodiscard]] NormalEquations from_on(std::size_t first) const { return part(later_, first); }
  [[nodiscard]] NormalEquations from_on(std::size_t first, std::size_t second) const {
    NormalEquations both{Eigen::MatrixXd(12, 12), Eigen::VectorXd(12)};
    const std::array<Eigen::Index, 2> at{static_cast<Eigen::Index>(6 * first),
                                         static_cast<Eigen::Index>(6 * second)};
    for (Eigen::Index a = 0; a < 2; ++a) {
      const Eigen::Index row = at.at(static_cast<std::size_t>(a));
      both.gradient.segment<6>(6 * a) = later_.gradient.segment<6>(row);
      for (Eigen::Index b = 0; b < 2; ++b) {
        both.hessian.block<6, 6>(6 * a, 6 * b) =
            later_.hessian.block<6, 6>(row, at.at(static_cast<std::size_t>(b)));
      }
    }
    return both;
  }
  [[nodiscard]] std::size_t views() const { return views_; }

 private:
  [[nodiscard]] static NormalEquations part(const NormalEquations& of, std::size_t view) {
    const auto at = static_cast<Eigen::Index>(6 * view);
    return {of.hessian.block<6, 6>(at, at), of.gradient.segment<6>(at)};
  }

  std::size_t views_;
  NormalEquations of_views_;
  NormalEquations later_;
};

void add_part(CauseScores& scores, const PartEquations& part, double distance_mm) {
  const std::size_t views = part.views();
  for (std::size_t view = 1; view < views; ++view) {
    scores.add_scales(PoseCause::PartMoved, {view}, part.from_on(view), kMotions, distance_mm);
    for (std::size_t later = view + 1; later < views; ++later) {
      scores.add_scales(PoseCause::PartMovedTwice,
                        {view, later},
                        part.from_on(view, later),
                        kMotions,
                        distance_mm);
    }
    // A last view that is elsewhere is one before which the part moved.
    if (view + 1 < views && views > 3)
      scores.add_scales(PoseCause::ViewMoved, {view}, part.of_view(view), kMotions, distance_mm);
  }
}

/// Motions of every view by itself, for which the equations are diagonalized once.
void add_independent(CauseScores& scores, const PartEquations& part, double distance_mm) {
  const auto eigen = symmetric_eigen(part.of_views().hessian);
  const Eigen::ArrayXd squares =
      (eigen.vectors.transpose() * part.of_views().gradient).array().square();
  const auto log_odds = [&](double scale) {
    const Eigen::ArrayXd gain = 1.0 + scale * scale * eigen.values.array().max(0.0);
    return 0.5 * (scale * scale * squares / gain - gain.log()).sum();
  };
  for (const double share : kPlay)
    scores.add({PoseCause::Wobble, {}, share * distance_mm, log_odds(share * distance_mm)});
  for (const double share : kElsewhere)
    scores.add({PoseCause::Unexplained, {}, share * distance_mm, log_odds(share * distance_mm)});
}

}  // namespace

Eigen::MatrixXd motions_of(const CauseHypothesis& hypothesis,
                           const PoseSetting& setting,
                           Eigen::Index unknowns) {
  return hypothesis.scale * unit_motions(hypothesis.cause, hypothesis.views, setting, unknowns);
}

std::vector<ScoredCause> score_causes(const PoseEvidence& evidence, const PoseSetting& setting) {
  const NormalEquations& data = evidence.without_table();
  const Eigen::Index unknowns = data.gradient.size();
  CauseScores scores;
  scores.add({PoseCause::AsStated, {}, 0.0, 0.0});
  const auto of = [&](PoseCause cause, const std::vector<std::size_t>& views) {
    return project(data, unit_motions(cause, views, setting, unknowns));
  };
  constexpr std::array<double, 1> kAsPrior{1.0};
  if (setting.beyond_stated.cols() > 0)
    scores.add_scales(PoseCause::Turntable, {}, of(PoseCause::Turntable, {}), kAsPrior, 1.0);
  for (std::size_t view = 1; view < setting.views; ++view) {
    scores.add_scales(
        PoseCause::Turned, {view}, of(PoseCause::Turned, {view}), kMotions, setting.distance_mm);
  }
  scores.add_scales(
      PoseCause::AnglesScaled, {}, of(PoseCause::AnglesScaled, {}), kAngleScales, 1.0);
  scores.add_scales(
      PoseCause::PartDrift, {}, of(PoseCause::PartDrift, {}), kMotions, setting.distance_mm);
  const PartEquations part(data, setting);
  add_part(scores, part, setting.distance_mm);
  add_independent(scores, part, setting.distance_mm);
  if (setting.rig_changes > 0) {
    scores.add_scales(PoseCause::Rig, {}, of(PoseCause::Rig, {}), kAsPrior, 1.0);
    scores.add_scales(PoseCause::RigDrift, {}, of(PoseCause::RigDrift, {}), kDrifts, 1.0);
  }
  return scores.sorted();
}

}  // namespace frangia
