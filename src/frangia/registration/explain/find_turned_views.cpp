#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/registration/explain/internal/angle_classes.h"
#include "frangia/registration/explain/internal/describe_explanation.h"
#include "frangia/registration/explain/internal/turn_fits.h"
#include "frangia/registration/internal/explain_angles.h"

namespace frangia {
namespace {

constexpr double kTurnStep_rad = rad_from_deg(1.0);
constexpr int kTurnSteps = 180;
/// Of the best fit: a part that repeats itself fits in other turns, too, and better where a view
/// then lies on another one.
constexpr double kAlike = 0.5;
/// Compares the views in all turns about the stated axis.
TurnFits fits_all_around(const Registration& work) {
  constexpr std::size_t kSome = 800;  // surfels of a view
  constexpr double kOpen = 0.3;       // of the reach: where the stated axis may place views
  Bundle bundle = work.bundle;
  const std::size_t views = bundle.maps.size();
  bundle.pairs = all_view_pairs(views);  // the chosen ones are those of the stated angles
  bundle.state = bundle.given;
  std::fill(bundle.state.angles_rad.begin(), bundle.state.angles_rad.end(), 0.0);
  const double gate_mm = std::max(bundle.min_gate_mm, kOpen * work.reach_mm);
  return {bundle, {kTurnStep_rad, kTurnSteps, surfels_per_view(kSome, views), gate_mm, gate_mm}};
}

/// Searches angles of the views by how their surfaces fit.
class AllTurns {
 public:
  explicit AllTurns(const Registration& work)
      : fits_(fits_all_around(work)), given_(work.bundle.given.angles_rad) {
    for (std::size_t view = 0; view < given_.size(); ++view)
      if (!work.surfels[view].empty()) views_.push_back(view);
  }

  [[nodiscard]] double fit_as_given() const { return fits_.fit_of(given_); }

  /// The best angles of every class, the simplest first.
  [[nodiscard]] std::vector<ClassedAngles> candidates() const {
    std::vector<ClassedAngles> all;
    const auto add = [&](std::vector<Peaks> some, std::size_t most) {
      std::stable_sort(
          some.begin(), some.end(), [](const Peaks& a, const Peaks& b) { return a.most > b.most; });
      for (std::size_t i = 0; i < std::min(most, some.size()); ++i)
        std::move(some[i].angles.begin(), some[i].angles.end(), std::back_inserter(all));
    };
    const std::size_t views = given_.size();
    const double range = range_rad();
    std::vector<Peaks> steps;
    std::vector<Peaks> alone;
    std::vector<Peaks> exchanged;
    for (std::size_t view = 1; view < views; ++view) {
      steps.push_back(
          peaks(kPi, kTurnStep_rad, [&](double by) { return turned_from(given_, view, by); }));
      if (view + 1 < views)
        alone.push_back(
            peaks(kPi, kTurnStep_rad, [&](double by) { return turned_alone(given_, view, by); }));
      for (std::size_t other = 0; other < view; ++other)
        exchanged.push_back(only(exchanged_angles(given_, other, view)));
    }
    if (range > kTurnStep_rad) {
      constexpr double kMost = 3.2;  // times the stated angles: backwards by more than double
      add({peaks(kMost,
                 kTurnStep_rad / range,
                 [&](double by) { return angles_scaled_by(given_, 1.0 + by); })},
          1);
    } else {
      add({peaks(kPi, kTurnStep_rad, [&](double by) { return evenly_spaced(given_, by); })}, 1);
    }
    add(std::move(steps), 2);
    add(std::move(exchanged), 2);
    add(std::move(alone), 2);
    add({only(all_turned(given_, settled(given_, kAlike)))}, 1);
    add({only(all_turned(given_, settled(grown(), 1.0)))}, 1);
    return all;
  }

  /// Angles of the same class with which what is turned fits elsewhere, however much less well:
  /// where it contradicts others it does not fit at all. Turns that are several times as far from
  /// the stated angles count for free angles and spacings alone.
  [[nodiscard]] std::vector<std::vector<double>> elsewhere(const ClassedAngles& found) const {
    std::vector<std::vector<double>> all;
    const auto add = [&](std::size_t first, std::size_t last, double change_rad) {
      constexpr double kFarther = 2.9;  // times the change
      const auto turned = [&](int steps) {
        std::vector<double> angles_rad = found.angles_rad;
        for (std::size_t view = first; view < last; ++view)
          angles_rad[view] += steps * kTurnStep_rad;
        return angles_rad;
      };
      const auto fit = [&](const std::vector<double>& angles_rad) {
        return fit_between(first, last, angles_rad);
      };
      const auto is_likely = [&](int steps) {
        const double there = wrap_rad(change_rad + steps * kTurnStep_rad);
        return std::abs(there) <= kFarther * std::abs(change_rad);
      };
      add_other_fits(all, turned, fit, is_likely);
    };
    const std::size_t views = given_.size();
    switch (found.kind) {
      case AngleClass::Step:
        add(found.as.views.front(), views, found.as.turned_rad);
        break;
      case AngleClass::Alone:
        add(found.as.views.front(), found.as.views.front() + 1, found.as.turned_rad);
        break;
      case AngleClass::Exchanged:
        for (std::size_t i = 0; i < found.as.views.size(); ++i)
          add(found.as.views[i], found.as.views[i] + 1, found.as.turns_rad[i]);
        break;
      case AngleClass::All:
        for (const std::size_t view : found.as.views)
          add(view, view + 1, kTwoPi);
        break;
      case AngleClass::Even:
        add_other_fits(
            all,
            [&](int steps) {
              return evenly_spaced(given_, found.as.spacing_rad + steps * kTurnStep_rad).angles_rad;
            },
            [&](const std::vector<double>& angles_rad) { return fits_.fit_of(angles_rad); },
            [](int /*steps*/) { return true; });
        break;
      case AngleClass::Scaled: {
        // A part that repeats itself fits with any share of the angles, of which one is found.
        const std::size_t farthest = largest_change(given_, found.angles_rad).view;
        add(farthest, farthest + 1, kTwoPi);
        break;
      }
    }
    return all;
  }

 private:
  /// Adds the angles by steps around the circle with which views fit better than by a step more or
  /// less, and by a share of the fit without a step at least.
  template <class At, class Fit, class IsLikely>
  static void add_other_fits(std::vector<std::vector<double>>& all,
                             const At& at,
                             const Fit& fit_of,
                             const IsLikely& is_likely) {
    constexpr double kFits = 0.2;
    constexpr int kNear = 5;  // steps
    std::vector<double> fit;
    for (int i = 0; i <= 2 * kTurnSteps; ++i)
      fit.push_back(fit_of(at(i)));
    for (int i = kNear; i <= 2 * kTurnSteps - kNear; ++i) {
      const auto step = static_cast<std::size_t>(i);
      if (!is_likely(i) || fit[step] < kFits * fit[0]) continue;
      if (fit[step] >= fit[step - 1] && fit[step] >= fit[step + 1]) all.push_back(at(i));
    }
  }
  /// Of some views with all others.
  [[nodiscard]] double fit_between(std::size_t first,
                                   std::size_t last,
                                   const std::vector<double>& angles_rad) const {
    double all = 0.0;
    for (const std::size_t view : views_) {
      if (view < first || view >= last) continue;
      for (const std::size_t other : views_) {
        if (other >= first && other < last) continue;
        const double turn_rad = angles_rad[view] - angles_rad[other];
        all += fits_.fit_of(view, other, turn_rad) + fits_.fit_of(other, view, -turn_rad);
      }
    }
    return all;
  }
  [[nodiscard]] ClassedAngles scored(ClassedAngles angles) const {
    angles.fit = fits_.fit_of(angles.angles_rad);
    return angles;
  }
  [[nodiscard]] double range_rad() const {
    const auto [least, most] = std::minmax_element(given_.begin(), given_.end());
    return *most - *least;
  }
  /// Angles that fit better than their neighbours, those with the least change first.
  struct Peaks {
    std::vector<ClassedAngles> angles;
    double most = 0.0;  ///< fit
  };
  [[nodiscard]] Peaks only(ClassedAngles angles) const {
    Peaks one{{scored(std::move(angles))}};
    one.most = one.angles.front().fit;
    return one;
  }
  /// Of changes by steps up to a limit.
  template <class At>
  [[nodiscard]] Peaks peaks(double limit, double step, const At& at) const {
    constexpr std::size_t kMost = 3;
    std::vector<ClassedAngles> tried;
    const int steps = static_cast<int>(limit / step);
    Peaks all;
    for (int i = -steps; i <= steps; ++i) {
      tried.push_back(scored(at(i * step)));
      all.most = std::max(all.most, tried.back().fit);
    }
    const auto fit = [&](int i) { return tried[static_cast<std::size_t>(i + steps)].fit; };
    const auto is_peak = [&](int i) {
      return fit(i) >= kAlike * all.most && (i == -steps || fit(i) >= fit(i - 1)) &&
             (i == steps || fit(i) >= fit(i + 1));
    };
    for (int i = 1; i <= steps; ++i) {
      for (const int side : {i, -i}) {
        if (all.angles.size() < kMost && is_peak(side))
          all.angles.push_back(std::move(tried[static_cast<std::size_t>(side + steps)]));
      }
    }
    return all;
  }
  /// How a view fits the others in all turns from its own on.
  [[nodiscard]] std::vector<double> fits_around(std::size_t view,
                                                std::vector<double> angles_rad) const {
    const double own = angles_rad[view];
    std::vector<double> fit;
    for (int i = 0; i < 2 * kTurnSteps; ++i) {
      angles_rad[view] = own + i * kTurnStep_rad;
      fit.push_back(fits_.fit_of_view(view, angles_rad));
    }
    return fit;
  }
  /// The angle of a view that fits the others: of those that fit alike the nearest to its own.
  [[nodiscard]] double best_angle(std::size_t view,
                                  const std::vector<double>& angles_rad,
                                  double alike) const {
    const std::vector<double> fit = fits_around(view, angles_rad);
    const double most = *std::max_element(fit.begin(), fit.end());
    const auto at = [&](int i) {
      return fit[static_cast<std::size_t>((i + 4 * kTurnSteps) % (2 * kTurnSteps))];
    };
    for (int i = 0; i <= kTurnSteps; ++i) {
      for (const int side : {i, -i}) {
        if (at(side) >= alike * most && at(side) >= at(side - 1) && at(side) >= at(side + 1))
          return angles_rad[view] + side * kTurnStep_rad;
      }
    }
    return angles_rad[view];
  }
  /// Angles from which no view by itself fits better elsewhere.
  [[nodiscard]] std::vector<double> settled(std::vector<double> angles_rad, double alike) const {
    const std::size_t rounds = 2 * views_.size();
    for (std::size_t round = 0; round < rounds; ++round) {
      // The view that gains most goes first: the others then know where it is.
      std::size_t gaining = 0;
      double most = 0.0;
      double there = 0.0;
      for (const std::size_t view : views_) {
        std::vector<double> moved = angles_rad;
        moved[view] = best_angle(view, angles_rad, alike);
        const double gain = fits_.fit_of_view(view, moved) - fits_.fit_of_view(view, angles_rad);
        if (gain <= most) continue;
        most = gain;
        gaining = view;
        there = moved[view];
      }
      if (most <= 0.0) break;
      angles_rad[gaining] = there;
    }
    return angles_rad;
  }
  /// Angles found from nothing: two views that fit, and one view after the other that fits them.
  [[nodiscard]] std::vector<double> grown() const {
    std::vector<double> angles_rad = given_;
    std::vector<std::size_t> left = views_;
    std::vector<std::size_t> group{left.front()};
    left.erase(left.begin());
    while (!left.empty()) {
      std::size_t next = 0;
      double most = -1.0;
      double there = 0.0;
      for (std::size_t i = 0; i < left.size(); ++i) {
        const std::size_t view = left[i];
        for (int turn = -kTurnSteps; turn < kTurnSteps; ++turn) {
          const double angle = given_[view] + turn * kTurnStep_rad;
          double fit = 0.0;
          for (const std::size_t other : group)
            fit += fits_.fit_of(view, other, angle - angles_rad[other]) +
                   fits_.fit_of(other, view, angles_rad[other] - angle);
          if (fit <= most) continue;
          most = fit;
          next = i;
          there = angle;
        }
      }
      angles_rad[left[next]] = there;
      group.push_back(left[next]);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(next));
    }
    return angles_rad;
  }

  TurnFits fits_;
  const std::vector<double>& given_;
  std::vector<std::size_t> views_;  ///< with surfaces
};

/// The angles of a class near to given ones to which some surfels of the views are refined.
ClassedAngles refined(const Registration& work, const SurfelLists& some, ClassedAngles found) {
  constexpr int kTurns = 2;
  constexpr double kOpen_rad = 2.0 * kTurnStep_rad;  // how near the search comes
  Bundle bundle = work.bundle;
  const auto angles = static_cast<Eigen::Index>(found.angles_rad.size()) - 1;
  bundle.prior_sigma.segment(4, angles).setConstant(kOpen_rad);
  const std::vector<double>& given = work.bundle.given.angles_rad;
  for (int turn = 0; turn < kTurns; ++turn) {
    bundle.gate_mm = work.reach_mm;
    bundle.given.angles_rad = found.angles_rad;
    bundle.state = bundle.given;
    optimize_bundle(bundle, some, work.options.max_iterations, work.run);
    found = followed(given, found, bundle.state.angles_rad);
  }
  return found;
}

/// Whether one view is a copy of another one, which fits wherever that one does.
bool has_copies(const Registration& work) {
  const auto same = [](const SurfelMap::Surfel& a, const SurfelMap::Surfel& b) {
    return a.point_mm == b.point_mm;
  };
  for (auto own = work.surfels.begin(); own != work.surfels.end(); ++own) {
    const bool is_copy = std::any_of(work.surfels.begin(), own, [&](const auto& other) {
      return std::equal(own->begin(), own->end(), other.begin(), other.end(), same);
    });
    if (is_copy && !own->empty()) return true;
  }
  return false;
}

/// Whether what is turned fits in no other turn: a part that repeats itself would be put together
/// from some of its sides.
bool is_unique(const Registration& work, const AllTurns& search, const ClassedAngles& found) {
  for (std::vector<double>& angles_rad : search.elsewhere(found)) {
    Registration other = work;
    other.bundle.given.angles_rad = std::move(angles_rad);
    other.optimize_again();
    if (fits_by_table(other)) return false;
  }
  return true;
}

/// With its sentence.
ExplainedAngles worded(const ClassedAngles& found, const Registration& work) {
  ExplainedAngles words{found.angles_rad, found.as};
  PoseExplanation& as = words.explanation;
  as.text = describe(as, [&](std::size_t view) { return work.name_of(view); });
  as.remedy = remedy_of(as, work.options.wrong_rig);
  return words;
}

}  // namespace

bool find_turned_views(const Registration& work,
                       const std::optional<CorrectedPoses>& free,
                       const TryAngles& try_angles) {
  constexpr double kNoticeable_rad = 0.5 * kTurnStep_rad;  // smaller ones are nearly linear
  constexpr double kBetter = 0.05;                         // of the fit
  constexpr std::size_t kSome = 500;                       // surfels of a view, which find angles
  const TableState& given = work.bundle.given;
  if (!given.part_poses.empty() || given.angles_rad.size() < 3 || has_copies(work)) return false;
  const auto tries = [&](const ClassedAngles& angles) {
    work.run.check();
    return largest_change(given.angles_rad, angles.angles_rad).change_rad > kNoticeable_rad &&
           try_angles(worded(angles, work));
  };
  const SurfelLists some = pick_all_surfels(work.bundle.maps, kSome);
  if (free) {
    const ClassedAngles angles =
        simplest_of(given.angles_rad, turned_to(given, free->object_from_rig));
    if (angles.kind != AngleClass::All && tries(refined(work, some, angles))) return true;
  }
  const AllTurns search(work);
  const double before = search.fit_as_given();
  for (const ClassedAngles& one : search.candidates()) {
    if (one.fit < before + kBetter * std::max(one.fit, std::abs(before))) continue;
    const ClassedAngles near = refined(work, some, one);
    if (tries(near) && is_unique(work, search, near)) return true;
  }
  return false;
}

}  // namespace frangia
