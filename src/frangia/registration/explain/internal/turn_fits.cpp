#include "frangia/registration/explain/internal/turn_fits.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/angles.h"
#include "frangia/core/parallel.h"
#include "frangia/registration/internal/surfel_pair.h"
#include "frangia/registration/internal/table_state.h"

namespace frangia {

TurnFits::TurnFits(const Bundle& bundle, const TurnGrid& grid)
    : grid_(grid), views_(bundle.maps.size()), pairs_(bundle.pairs) {
  const SurfelLists surfels = pick_all_surfels(bundle.maps, grid.surfels);
  const auto turns = static_cast<std::size_t>(2 * grid.steps + 1);
  fits_.assign(views_ * views_, std::vector<float>(turns, 0.0F));
  parallel_chunks(
      turns, 1, [&](std::size_t begin, std::size_t /*end*/) { compare(bundle, surfels, begin); });
}

double TurnFits::fit_of(std::size_t from, std::size_t to, double turn_rad) const {
  const double at = wrap_rad(turn_rad) / grid_.step_rad + grid_.steps;
  const auto index = static_cast<std::size_t>(std::clamp(at, 0.0, 2.0 * grid_.steps - 1.0));
  const double share = std::clamp(at - static_cast<double>(index), 0.0, 1.0);
  const std::vector<float>& fit = fits_[from * views_ + to];
  return (1.0 - share) * static_cast<double>(fit[index]) +
         share * static_cast<double>(fit[index + 1]);
}

double TurnFits::fit_of(const std::vector<double>& turned_rad) const {
  double all = 0.0;
  for (std::size_t from = 0; from < views_; ++from) {
    for (const std::size_t to : pairs_[from])
      all += fit_of(from, to, turned_rad[from] - turned_rad[to]);
  }
  return all;
}

double TurnFits::fit_of_view(std::size_t view, const std::vector<double>& turned_rad) const {
  double all = 0.0;
  for (const std::size_t other : pairs_[view]) {
    const double turn_rad = turned_rad[view] - turned_rad[other];
    all += fit_of(view, other, turn_rad) + fit_of(other, view, -turn_rad);
  }
  return all;
}

void TurnFits::compare(const Bundle& bundle, const SurfelLists& surfels, std::size_t at) {
  constexpr float kContradicts = 3.0F;  // pairs that agree, which one that contradicts outweighs
  constexpr double kShowsTurn = 0.3;    // motion along the normal by a turn, over the way
  const double turn_rad = (static_cast<double>(at) - grid_.steps) * grid_.step_rad;
  TableState turned = bundle.state;
  for (double& angle : turned.angles_rad)
    angle += turn_rad;
  const std::vector<Eigen::Isometry3d> there = object_poses(bundle.state);
  const std::vector<Eigen::Isometry3d> here = object_poses(turned);
  for (std::size_t from = 0; from < views_; ++from) {
    const Eigen::Isometry3d object_from_rig = here[from].inverse();
    for (const std::size_t to : pairs_[from]) {
      const Eigen::Isometry3d to_from = there[to] * object_from_rig;
      float& fit = fits_[from * views_ + to][at];
      for (const SurfelMap::Surfel& surfel : surfels[from]) {
        const Eigen::Vector3d point = to_from * surfel.point_mm.cast<double>();
        const SurfelMap::Surfel* target = surfel_at(bundle.maps[to], bundle.model, point);
        if (target == nullptr) continue;
        const SurfelPair pair(point, to_from.linear() * surfel.normal.cast<double>(), *target);
        const double variance = std::pow(static_cast<double>(surfel.sigma_mm), 2) +
                                std::pow(static_cast<double>(target->sigma_mm), 2);
        if (pair.violates_free_space(SurfelPair::margin_mm(grid_.margin_mm, variance)))
          fit -= kContradicts;
        const double distance = pair.distance_mm();
        if (!pair.faces_alike() || std::abs(distance) > grid_.gate_mm) continue;
        const Eigen::Vector3d seen = object_from_rig * surfel.point_mm.cast<double>();
        const Eigen::Vector3d normal = object_from_rig.linear() * surfel.normal.cast<double>();
        const double way = seen.head<2>().norm();
        if (std::abs(Eigen::Vector3d::UnitZ().cross(seen).dot(normal)) > kShowsTurn * way)
          fit += static_cast<float>(1.0 - std::pow(distance / grid_.gate_mm, 2));
      }
    }
  }
}

}  // namespace frangia
