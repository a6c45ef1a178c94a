#include "frangia/registration/explain/internal/angle_classes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "frangia/core/angles.h"
#include "frangia/registration/internal/table_state.h"

namespace frangia {
namespace {

constexpr double kNamed_rad = rad_from_deg(0.3);  // smaller differences are to be expected

double mean_of(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  return std::accumulate(at(begin), at(end), 0.0) / static_cast<double>(end - begin);
}

/// Share of steps by which differences grow, least squares.
double share_of(const std::vector<double>& differences, const std::vector<double>& steps) {
  const double products =
      std::inner_product(differences.begin(), differences.end(), steps.begin(), 0.0);
  const double squares = std::inner_product(steps.begin(), steps.end(), steps.begin(), 0.0);
  return products / std::max(1e-300, squares);
}

std::vector<double> from_first(std::vector<double> angles_rad) {
  const double first = angles_rad.front();
  for (double& angle : angles_rad)
    angle -= first;
  return angles_rad;
}

std::vector<double> difference(const std::vector<double>& angles_rad,
                               const std::vector<double>& given_rad) {
  std::vector<double> turned;
  for (std::size_t view = 0; view < given_rad.size(); ++view)
    turned.push_back(wrap_rad(angles_rad[view] - given_rad[view]));
  return turned;
}

/// Names the views whose angles differ.
ClassedAngles wrong_angles(const std::vector<double>& given_rad,
                           std::vector<double> angles_rad,
                           AngleClass kind) {
  ClassedAngles wrong{std::move(angles_rad), kind};
  wrong.as.best = PoseCause::AnglesWrong;
  const std::vector<double> turned = difference(wrong.angles_rad, given_rad);
  double most = 0.0;
  for (std::size_t view = 0; view < turned.size(); ++view) {
    if (std::abs(turned[view]) < kNamed_rad) continue;
    wrong.as.views.push_back(view);
    wrong.as.turns_rad.push_back(turned[view]);
    if (std::abs(turned[view]) > std::abs(most)) most = turned[view];
  }
  wrong.as.turned_rad = most;
  wrong.as.exchanged = kind == AngleClass::Exchanged;
  return wrong;
}

}  // namespace

ClassedAngles angles_scaled_by(const std::vector<double>& given_rad, double factor) {
  ClassedAngles scaled{given_rad, AngleClass::Scaled};
  for (double& angle : scaled.angles_rad)
    angle = given_rad[0] + factor * (angle - given_rad[0]);
  scaled.as.best = PoseCause::AnglesScaled;
  scaled.as.scale = factor;
  return scaled;
}

ClassedAngles turned_from(const std::vector<double>& given_rad, std::size_t first, double by_rad) {
  ClassedAngles turned{given_rad, AngleClass::Step};
  for (std::size_t view = first; view < given_rad.size(); ++view)
    turned.angles_rad[view] += by_rad;
  turned.as.best = PoseCause::Turned;
  turned.as.views = {first};
  turned.as.turned_rad = by_rad;
  return turned;
}

ClassedAngles turned_alone(const std::vector<double>& given_rad, std::size_t view, double by_rad) {
  std::vector<double> angles_rad = given_rad;
  angles_rad[view] += by_rad;
  return wrong_angles(given_rad, std::move(angles_rad), AngleClass::Alone);
}

ClassedAngles exchanged_angles(const std::vector<double>& given_rad,
                               std::size_t one,
                               std::size_t other) {
  std::vector<double> angles_rad = given_rad;
  std::swap(angles_rad[one], angles_rad[other]);
  return wrong_angles(given_rad, std::move(angles_rad), AngleClass::Exchanged);
}

ClassedAngles evenly_spaced(const std::vector<double>& given_rad, double step_rad) {
  std::vector<double> angles_rad;
  for (std::size_t view = 0; view < given_rad.size(); ++view)
    angles_rad.push_back(given_rad[0] + static_cast<double>(view) * step_rad);
  ClassedAngles even = wrong_angles(given_rad, std::move(angles_rad), AngleClass::Even);
  even.as.spacing_rad = step_rad;
  return even;
}

ClassedAngles all_turned(const std::vector<double>& given_rad, std::vector<double> angles_rad) {
  constexpr double kSame_rad = rad_from_deg(1.5);  // the search finds turns to a degree
  const std::vector<double> turned = difference(angles_rad, given_rad);
  double common = 0.0;
  double mean = 0.0;
  std::ptrdiff_t most = 0;
  for (const double by : turned) {
    double sum = 0.0;
    std::ptrdiff_t count = 0;
    for (const double other : turned) {
      if (std::abs(wrap_rad(other - by)) > kSame_rad) continue;
      sum += wrap_rad(other - by);
      ++count;
    }
    if (count <= most) continue;
    most = count;
    common = by;
    mean = sum / static_cast<double>(count);
  }
  for (double& angle : angles_rad)
    angle -= common + mean;
  return wrong_angles(given_rad, std::move(angles_rad), AngleClass::All);
}

ClassedAngles simplest_of(const std::vector<double>& given_rad,
                          const std::vector<double>& turned_rad) {
  constexpr double kFollows_rad = rad_from_deg(0.5);
  const std::size_t views = given_rad.size();
  const std::vector<double> commanded = from_first(given_rad);
  const double share = share_of(turned_rad, commanded);
  double least = 0.0;
  for (std::size_t view = 0; view < views; ++view)
    least = std::max(least, std::abs(turned_rad[view] - share * commanded[view]));
  ClassedAngles best = angles_scaled_by(given_rad, 1.0 + share);
  for (std::size_t first = 1; first < views; ++first) {
    const double before = mean_of(turned_rad, 0, first);
    const double after = mean_of(turned_rad, first, views);
    double rest = 0.0;
    for (std::size_t view = 0; view < views; ++view)
      rest = std::max(rest, std::abs(turned_rad[view] - (view < first ? before : after)));
    if (rest >= least) continue;
    least = rest;
    best = turned_from(given_rad, first, after - before);
  }
  if (least < kFollows_rad) return best;
  std::vector<double> angles_rad = given_rad;
  for (std::size_t view = 0; view < views; ++view)
    angles_rad[view] += turned_rad[view];
  return all_turned(given_rad, std::move(angles_rad));
}

ClassedAngles followed(const std::vector<double>& given_rad,
                       const ClassedAngles& found,
                       const std::vector<double>& refined_rad) {
  const std::size_t views = given_rad.size();
  const std::vector<double> more = difference(refined_rad, found.angles_rad);
  switch (found.kind) {
    case AngleClass::Scaled:
      return angles_scaled_by(given_rad,
                              found.as.scale + share_of(from_first(more), from_first(given_rad)));
    case AngleClass::Step: {
      const std::size_t first = found.as.views.front();
      return turned_from(
          given_rad,
          first,
          found.as.turned_rad + mean_of(more, first, views) - mean_of(more, 0, first));
    }
    case AngleClass::Even: {
      std::vector<double> steps(views);
      std::iota(steps.begin(), steps.end(), 0.0);
      return evenly_spaced(given_rad, found.as.spacing_rad + share_of(from_first(more), steps));
    }
    case AngleClass::Alone: {
      if (found.as.views.empty()) return found;  // turned back to where it is stated
      const std::size_t view = found.as.views.front();
      return turned_alone(given_rad, view, found.as.turned_rad + more[view]);
    }
    case AngleClass::Exchanged:
      return found;
    case AngleClass::All:
      break;
  }
  std::vector<double> angles_rad = found.angles_rad;
  for (const std::size_t view : found.as.views)
    angles_rad[view] += more[view];
  return wrong_angles(given_rad, std::move(angles_rad), AngleClass::All);
}

std::vector<double> turned_to(const TableState& given,
                              const std::vector<Eigen::Isometry3d>& object_from_rig) {
  const std::vector<Eigen::Isometry3d> stated = object_poses(given);
  TableState turned = given;
  constexpr double kTurn_rad = 0.1;  // shows the sense of the angles
  turned.angles_rad[0] += kTurn_rad;
  const auto turn_of = [&](std::size_t view, const Eigen::Isometry3d& rig_from_object) {
    const Eigen::Matrix3d by = (stated[view].inverse() * rig_from_object).linear();
    return std::atan2(by(1, 0) - by(0, 1), by(0, 0) + by(1, 1));
  };
  const double sense = std::copysign(1.0, turn_of(0, object_poses(turned)[0]));
  std::vector<double> turns;
  for (std::size_t view = 0; view < stated.size(); ++view)
    turns.push_back(sense * turn_of(view, object_from_rig[view].inverse()));
  const double first = turns.front();
  for (double& turn : turns)
    turn = wrap_rad(turn - first);
  return turns;
}

ViewChange largest_change(const std::vector<double>& given_rad,
                          const std::vector<double>& angles_rad) {
  const std::vector<double> turned = difference(angles_rad, given_rad);
  ViewChange most;
  for (std::size_t view = 0; view < turned.size(); ++view) {
    const double change_rad = std::abs(wrap_rad(turned[view] - turned.front()));
    if (change_rad > most.change_rad) most = {view, change_rad};
  }
  return most;
}

}  // namespace frangia
