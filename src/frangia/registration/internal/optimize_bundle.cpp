#include "frangia/registration/internal/optimize_bundle.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/statistics.h"
#include "frangia/geometry/robust_gauss_newton.h"

namespace frangia {
double effective_weight(const Bundle& bundle, const BundleSums& sums) {
  constexpr double kSigmaFromMedian = 1.4826;  // of the absolute values of normal residuals
  const double pairs = static_cast<double>(std::max<std::size_t>(1, sums.distances_mm.size()));
  const double view_pairs = static_cast<double>(count_pairs(bundle.pairs));
  const double scatter = kSigmaFromMedian * static_cast<double>(median(sums.distances_mm));
  const double independent = view_pairs * std::pow(scatter / bundle.systematic_mm, 2);
  return std::min(1.0, independent / pairs);
}

namespace {

/// Orders the surfels of a view by quarters of its image, which are its regions: the mean of a
/// strip across the whole view would not show an error that tilts it along the strip.
void order_by_quarters(std::vector<SurfelMap::Surfel>& surfels) {
  const auto sort_by = [](auto begin, auto end, int axis) {
    std::stable_sort(begin, end, [axis](const auto& one, const auto& other) {
      return one.point_mm[axis] * other.point_mm.z() < other.point_mm[axis] * one.point_mm.z();
    });
  };
  const auto middle = surfels.begin() + static_cast<std::ptrdiff_t>(surfels.size() / 2);
  sort_by(surfels.begin(), surfels.end(), 0);
  sort_by(surfels.begin(), middle, 1);
  sort_by(middle, surfels.end(), 1);
}

}  // namespace

SurfelLists pick_all_surfels(const std::vector<SurfelMap>& maps, std::size_t count) {
  SurfelLists surfels;
  for (const SurfelMap& map : maps) {
    surfels.push_back(pick_surfels(map, count));
    order_by_quarters(surfels.back());
  }
  return surfels;
}

double free_space_margin_mm(const Bundle& bundle) {
  // 18 sigmas of a surfel: far in front of a surface even where the views fit badly. Within the
  // gate a point still counts as one on the surface.
  constexpr double kFreeSpaceMargin = 3.0;
  return std::min(bundle.gate_mm, kFreeSpaceMargin * bundle.min_gate_mm);
}

BundleSums sum(const Bundle& bundle, const SurfelLists& surfels) {
  return sum_bundle(surfels,
                    bundle.maps,
                    bundle.model,
                    bundle.state,
                    bundle.pairs,
                    {bundle.gate_mm, free_space_margin_mm(bundle)});
}

namespace {

/// Mean distance of the surfels from the axis.
double arm_mm(const Bundle& bundle, const SurfelLists& surfels) {
  const Turntable& table = bundle.given.table;
  double sum = 0.0;
  double count = 0.0;
  for (const auto& own : surfels) {
    for (const SurfelMap::Surfel& surfel : own) {
      sum += table.axis.cross(surfel.point_mm.cast<double>() - table.point_mm).norm();
      count += 1.0;
    }
  }
  return sum / std::max(1.0, count);
}

/// Holds the angles by which hardly any surface moves along its normals: a round part would turn by
/// many degrees to make up for a motion of a few hundredths of a millimetre.
void hold_open_angles(Linearization& at, const Bundle& bundle, const BundleSums& sums, double arm) {
  constexpr double kHeld = 1e8;  // times the information of the prior
  const std::size_t views = bundle.maps.size();
  for (std::size_t view = 1; view < views; ++view) {
    const auto i = static_cast<Eigen::Index>(view) + 3;
    if (sums.hessian(i, i) > std::pow(kOpenMotion * arm, 2) * sums.weight_of(view)) continue;
    const double held = kHeld / std::pow(bundle.prior_sigma[i], 2);
    at.hessian(i, i) += held;
    at.gradient[i] += held * deviation(bundle.state, bundle.given)[i];
  }
}

}  // namespace

void optimize_bundle(Bundle& bundle,
                     const SurfelLists& surfels,
                     int max_iterations,
                     const Run& run) {
  const Eigen::VectorXd information = bundle.prior_sigma.cwiseAbs2().cwiseInverse();
  const double arm = arm_mm(bundle, surfels);
  const auto linearize = [&](double gate_mm) {
    bundle.gate_mm = gate_mm;
    BundleSums sums = sum(bundle, surfels);
    const double weight = effective_weight(bundle, sums);
    Linearization at;
    at.hessian = weight * sums.hessian;
    at.hessian.diagonal() += information;
    at.gradient =
        weight * sums.gradient + information.cwiseProduct(deviation(bundle.state, bundle.given));
    if (bundle.ties.empty()) {
      hold_open_angles(at, bundle, sums, arm);
    } else {
      const TieSums ties = sum_ties(bundle.ties, bundle.state);
      at.hessian += ties.hessian;
      at.gradient += ties.gradient;
    }
    at.median_residual = static_cast<double>(median(std::move(sums.distances_mm)));
    return at;
  };
  const auto update = [&](const Eigen::VectorXd& step) {
    bundle.state = apply_update(bundle.state, step);
  };
  const auto result = minimize_robustly(
      {linearize, update},
      {.gate = bundle.gate_mm, .min_gate = bundle.min_gate_mm, .max_iterations = max_iterations},
      run);
  bundle.gate_mm = result.gate;
  bundle.iterations += result.iterations;
}

}  // namespace frangia
