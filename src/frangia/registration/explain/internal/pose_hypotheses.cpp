#include "frangia/registration/explain/internal/pose_hypotheses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "frangia/core/linear_algebra.h"
#include "frangia/registration/explain/internal/cause_motions.h"
#include "frangia/registration/explain/internal/moved_rig.h"
#include "frangia/registration/explain/internal/time_profiles.h"

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
/// Of a rig all through the scan, over the drift since its calibration: a calibration may be wrong,
/// too.
constexpr std::array<double, 3> kRigs{1.0, 3.0, 10.0};
/// Of the drift during a scan, over that since the calibration.
constexpr std::array<double, 3> kDrifts{0.1, 0.3, 1.0};
/// Of a knock, in units of the setting: 0.003 to 0.3 degrees, and 15 um to 1.5 mm at 500 mm.
constexpr std::array<double, 5> kKnocks{0.03, 0.1, 0.3, 1.0, 3.0};

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Collects the hypotheses of all causes.
class CauseScores {
 public:
  void add(CauseHypothesis hypothesis) {
    Score& score = scores_[hypothesis.cause];
    score.log_odds.push_back(hypothesis.log_odds);
    const auto [at, is_new] =
        score.kinds.try_emplace({hypothesis.views, hypothesis.profile}, hypothesis);
    if (!is_new && hypothesis.log_odds > at->second.log_odds) at->second = hypothesis;
    if (score.log_odds.size() == 1 || hypothesis.log_odds > score.best.log_odds)
      score.best = std::move(hypothesis);
  }
  /// Adds hypotheses that differ by the standard deviation of their changes.
  template <std::size_t n>
  void add_scales(PoseCause cause,
                  const std::vector<std::size_t>& views,
                  const NormalEquations& data,
                  const std::array<double, n>& scales,
                  double unit,
                  bool slides = false,
                  std::size_t profile = 0) {
    for (const double share : scales) {
      const double scale = share * unit;
      add({cause,
           views,
           scale,
           PoseEvidence::log_odds(scale * scale * data.hessian, scale * data.gradient),
           slides,
           false,
           profile});
    }
  }
  [[nodiscard]] std::vector<ScoredCause> sorted() const {
    std::vector<ScoredCause> all;
    for (const auto& [cause, score] : scores_) {
      const double most = score.best.log_odds;
      double sum = 0.0;
      for (const double odds : score.log_odds)
        sum += std::exp(odds - most);
      const auto count = static_cast<double>(score.log_odds.size());
      const double mean = most + std::log(sum / count);
      all.push_back({cause, mean, score.best, others_than(score, std::log(count))});
    }
    std::stable_sort(all.begin(), all.end(), [](const ScoredCause& a, const ScoredCause& b) {
      return a.log_odds > b.log_odds;
    });
    return all;
  }

 private:
  /// Views and course in time.
  using Kind = std::pair<std::vector<std::size_t>, std::size_t>;
  struct Score {
    std::vector<double> log_odds;
    CauseHypothesis best;
    std::map<Kind, CauseHypothesis> kinds;  ///< the best of each
  };

  static std::vector<CauseHypothesis> others_than(const Score& score, double log_count) {
    constexpr double kNearly = 7.0;  // 1000 : 1
    constexpr std::size_t kMost = 20;
    std::vector<CauseHypothesis> others;
    for (const auto& [kind, hypothesis] : score.kinds) {
      if (kind == Kind(score.best.views, score.best.profile) ||
          hypothesis.log_odds < score.best.log_odds - kNearly)
        continue;
      others.push_back(hypothesis);
      others.back().log_odds -= log_count;
    }
    std::stable_sort(others.begin(), others.end(), [](const auto& a, const auto& b) {
      return a.log_odds > b.log_odds;
    });
    if (others.size() > kMost) others.resize(kMost);
    return others;
  }

  std::map<PoseCause, Score> scores_;
};

NormalEquations project(const NormalEquations& data, const Eigen::MatrixXd& motions) {
  return {motions.transpose() * data.hessian * motions, motions.transpose() * data.gradient};
}

/// Equations in unknowns that all views from one on share, from those of each view: the blocks
/// (a, b) are sums over the views from a on, and from b on.
NormalEquations summed_from_on(NormalEquations of_views, Eigen::Index size) {
  NormalEquations& all = of_views;
  for (Eigen::Index view = all.gradient.size() - 2 * size; view >= 0; view -= size) {
    all.hessian.middleRows(view, size) += all.hessian.middleRows(view + size, size);
    all.gradient.segment(view, size) += all.gradient.segment(view + size, size);
  }
  for (Eigen::Index view = all.gradient.size() - 2 * size; view >= 0; view -= size)
    all.hessian.middleCols(view, size) += all.hessian.middleCols(view + size, size);
  return of_views;
}

/// Equations in motions of the part that some views share, from those of each view.
class PartEquations {
 public:
  PartEquations(const NormalEquations& data, const PoseSetting& setting, bool slides)
      : views_(setting.views), slides_(slides) {
    const auto n = static_cast<Eigen::Index>(6 * views_);
    const Eigen::MatrixXd motions = unit_motions(PoseCause::Wobble, {}, setting, n) *
                                    shares_of_motion(slides).replicate(n / 6, 1).asDiagonal();
    of_views_ = project({data.hessian.topLeftCorner(n, n), data.gradient.head(n)}, motions);
    later_ = summed_from_on(of_views_, 6);
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
  [[nodiscard]] bool slides() const { return slides_; }

 private:
  [[nodiscard]] static NormalEquations part(const NormalEquations& of, std::size_t view) {
    const auto at = static_cast<Eigen::Index>(6 * view);
    return {of.hessian.block<6, 6>(at, at), of.gradient.segment<6>(at)};
  }

  std::size_t views_;
  bool slides_;
  NormalEquations of_views_;
  NormalEquations later_;
};

/// The view whose motion by itself explains most, but for some, and the logarithm of its odds.
std::pair<std::size_t, double> most_displaced(const NormalEquations& of_views,
                                              const std::vector<std::size_t>& but_for) {
  std::pair<std::size_t, double> best{0, -std::numeric_limits<double>::infinity()};
  for (std::size_t view = 0; 6 * static_cast<Eigen::Index>(view) < of_views.gradient.size();
       ++view) {
    if (std::find(but_for.begin(), but_for.end(), view) != but_for.end()) continue;
    const auto at = static_cast<Eigen::Index>(6 * view);
    const double log_odds = PoseEvidence::log_odds(of_views.hessian.block<6, 6>(at, at),
                                                   of_views.gradient.segment<6>(at));
    if (log_odds > best.second) best = {view, log_odds};
  }
  return best;
}

/// Reduces equations to what is left once a view moves by itself, with a prior of 1.
void explain_view(NormalEquations& of_views, std::size_t view) {
  const auto at = static_cast<Eigen::Index>(6 * view);
  Eigen::MatrixXd own = of_views.hessian.block<6, 6>(at, at);
  own.diagonal().array() += 1.0;
  const Eigen::MatrixXd across = of_views.hessian.middleCols<6>(at);
  const Cholesky factors(own);
  of_views.gradient -= product(across, factors.solve(of_views.gradient.segment<6>(at)));
  of_views.hessian -= product(across, factors.solve_columns(across.transpose()));
}

void add_part(CauseScores& scores, const PartEquations& part, double distance_mm) {
  const std::size_t views = part.views();
  for (std::size_t view = 1; view < views; ++view) {
    scores.add_scales(
        PoseCause::PartMoved, {view}, part.from_on(view), kMotions, distance_mm, part.slides());
    for (std::size_t later = view + 1; later < views; ++later) {
      scores.add_scales(PoseCause::PartMovedTwice,
                        {view, later},
                        part.from_on(view, later),
                        kMotions,
                        distance_mm,
                        part.slides());
    }
    // A last view that is elsewhere is one before which the part moved.
    if (view + 1 < views && views > 3) {
      scores.add_scales(
          PoseCause::ViewMoved, {view}, part.of_view(view), kMotions, distance_mm, part.slides());
    }
  }
}

/// Natural logarithm of the number of ways to choose some of the views.
double log_choices(std::size_t views, std::size_t some) {
  const auto n = static_cast<double>(views);
  const auto k = static_cast<double>(some);
  return std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0);
}

/// Several views that are elsewhere, each by itself, up to half of them: every two of a scan of few
/// views, then the one that explains most of what the others leave.
void add_several_views(CauseScores& scores, const PartEquations& part, double distance_mm) {
  constexpr std::size_t kFewViews = 24;
  const std::size_t views = part.views();
  const std::size_t most = views / 2;
  if (most < 2) return;
  // Each number of views is as probable, and so are all choices of that many. The odds of a cause
  // are the mean over its hypotheses, which a scan of few views has several times: found from each
  // of their views.
  const double listed = views > kFewViews ? static_cast<double>(most - 1)
                                          : static_cast<double>(views * (views - 1 + most - 2));
  const auto log_weight = [&](std::size_t some) {
    const double times = views > kFewViews ? 1.0 : static_cast<double>(some);
    return std::log(listed / (times * static_cast<double>(most - 1))) - log_choices(views, some);
  };
  for (const double share : kMotions) {
    const double scale = share * distance_mm;
    NormalEquations all = part.of_views();
    all.hessian *= scale * scale;
    all.gradient *= scale;
    const auto begin_with = [&](std::size_t first) {
      NormalEquations left = all;
      double log_odds =
          PoseEvidence::log_odds(left.hessian.block<6, 6>(static_cast<Eigen::Index>(6 * first),
                                                          static_cast<Eigen::Index>(6 * first)),
                                 left.gradient.segment<6>(static_cast<Eigen::Index>(6 * first)));
      explain_view(left, first);
      CauseHypothesis several{PoseCause::ViewsMoved, {first}, scale, 0.0, part.slides()};
      const auto add = [&](const CauseHypothesis& some, double odds) {
        CauseHypothesis sorted = some;
        sorted.log_odds = odds + log_weight(some.views.size());
        std::sort(sorted.views.begin(), sorted.views.end());
        scores.add(std::move(sorted));
      };
      for (std::size_t second = first + 1; views <= kFewViews && second < views; ++second) {
        const auto at = static_cast<Eigen::Index>(6 * second);
        CauseHypothesis two = several;
        two.views.push_back(second);
        add(two,
            log_odds + PoseEvidence::log_odds(left.hessian.block<6, 6>(at, at),
                                              left.gradient.segment<6>(at)));
      }
      while (several.views.size() < most) {
        const auto [next, more] = most_displaced(left, several.views);
        several.views.push_back(next);
        log_odds += more;
        explain_view(left, next);
        if (views > kFewViews || several.views.size() > 2) add(several, log_odds);
      }
    };
    if (views > kFewViews) {
      begin_with(most_displaced(all, {}).first);
    } else {
      for (std::size_t first = 0; first < views; ++first)
        begin_with(first);
    }
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

/// A table or a rig that is knocked between two views.
void add_knocks(CauseScores& scores, const NormalEquations& data, const PoseSetting& setting) {
  if (setting.object_from_rig.size() != setting.views) return;
  const auto views = static_cast<Eigen::Index>(setting.views);
  const Eigen::Index size = knows_each_view(setting) ? 12 : 6;
  Eigen::MatrixXd motions(data.gradient.size(), size * views);
  for (Eigen::Index view = 0; view < views; ++view) {
    motions.middleCols(size * view, size) =
        motions_in_rig(setting, Eigen::VectorXd::Unit(views, view), data.gradient.size());
  }
  const NormalEquations later = summed_from_on(project(data, motions), size);
  for (Eigen::Index view = 1; view < views; ++view) {
    const NormalEquations from{later.hessian.block(size * view, size * view, size, size),
                               later.gradient.segment(size * view, size)};
    const std::vector<std::size_t> at{static_cast<std::size_t>(view)};
    scores.add_scales(PoseCause::TableMoved,
                      at,
                      {from.hessian.topLeftCorner<6, 6>(), from.gradient.head<6>()},
                      kKnocks,
                      1.0);
    for (std::size_t moved = 0; size == 12 && moved < kMovedRigs; ++moved) {
      scores.add_scales(PoseCause::RigMoved,
                        at,
                        project(from, motions_of_knock(static_cast<MovedRig>(moved))),
                        kKnocks,
                        1.0,
                        false,
                        moved);
    }
  }
}

}  // namespace

std::vector<ScoredCause> score_causes(const PoseEvidence& evidence, const PoseSetting& setting) {
  const NormalEquations& data = evidence.without_table();
  const Eigen::Index unknowns = data.gradient.size();
  CauseScores scores;
  scores.add({PoseCause::AsStated, {}, 0.0, 0.0});
  const auto of = [&](PoseCause cause, const std::vector<std::size_t>& views) {
    return project(data, unit_motions(cause, views, setting, unknowns));
  };
  const auto add_drifts =
      [&](PoseCause cause, std::size_t profiles, const auto& scales, double unit) {
        for (std::size_t profile = 0; profile < profiles; ++profile) {
          const auto drift = project(data, unit_motions(cause, {}, setting, unknowns, profile));
          scores.add_scales(cause, {}, drift, scales, unit, false, profile);
        }
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
  // A part creeps or settles; a smooth course of its own would be that of whatever moves the views.
  add_drifts(PoseCause::PartDrift, kSmoothProfile, kMotions, setting.distance_mm);
  for (const bool slides : {true, false}) {
    const PartEquations part(data, setting, slides);
    add_part(scores, part, setting.distance_mm);
    add_several_views(scores, part, setting.distance_mm);
    if (!slides) add_independent(scores, part, setting.distance_mm);
  }
  add_knocks(scores, data, setting);
  if (setting.rig_changes > 0) {
    scores.add_scales(PoseCause::Rig, {}, of(PoseCause::Rig, {}), kRigs, 1.0);
    add_drifts(PoseCause::RigDrift, kTimeProfiles, kDrifts, 1.0);
  }
  return scores.sorted();
}

}  // namespace frangia
