#include "frangia/registration/internal/optimize_bundle.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/robust_gauss_newton.h"
#include "frangia/local_fit/surfel_map.h"

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

/// Information of the prior beside pairs that count by one weight for all. The pairs of a noisy
/// view share an error that is small beside their noise, so that more of them are independent: the
/// prior of its angle counts less by as much. Else it would pull the view out of the gate.
Eigen::VectorXd prior_information(const Bundle& bundle, const BundleSums& sums, double weight) {
  Eigen::VectorXd information = bundle.prior_sigma.cwiseAbs2().cwiseInverse();
  PairTally all;
  std::vector<PairTally> of_view(bundle.maps.size());
  for (std::size_t view = 0; view < of_view.size(); ++view) {
    for (const std::size_t other : bundle.pairs[view]) {
      const PairTally pair = sums.pair(view, other);
      of_view[view].add(pair);
      of_view[other].add(pair);
      all.add(pair);
    }
  }
  for (std::size_t view = 1; view < of_view.size(); ++view) {
    if (of_view[view].agree == 0) continue;
    const double variance = static_cast<double>(of_view[view].agree) / of_view[view].weight;
    const double noisier = variance * all.weight / static_cast<double>(all.agree);
    information[static_cast<Eigen::Index>(view) + 3] *= std::clamp(1.0 / noisier, weight, 1.0);
  }
  return information;
}

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
  const double arm = arm_mm(bundle, surfels);
  const auto linearize = [&](double gate_mm) {
    bundle.gate_mm = gate_mm;
    BundleSums sums = sum(bundle, surfels);
    const double weight = effective_weight(bundle, sums);
    const Eigen::VectorXd information = prior_information(bundle, sums, weight);
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

namespace {

/// Pose of the part in each view, relative to the first setup at angle 0.
std::vector<Eigen::Isometry3d> poses_of(const TableState& state) {
  std::vector<Eigen::Isometry3d> poses;
  const Eigen::Isometry3d table_from_rig = state.table.rig_from_object(0.0).inverse();
  for (std::size_t view = 0; view < state.angles_rad.size(); ++view) {
    poses.push_back(state.table.rig_from_object(state.angles_rad[view]) * table_from_rig *
                    state.part_pose(state.setup_of(view)));
  }
  return poses;
}

}  // namespace

Eigen::VectorXd prior_sigmas(const TableState& state,
                             const RegisterOptions& options,
                             double distance_mm) {
  // Nothing is known of a part pose: any place within ten working distances, any rotation.
  constexpr double kUnknownShift = 10.0;
  constexpr double kUnknownRotation_rad = 10.0 * kTwoPi;
  Eigen::VectorXd sigma = Eigen::VectorXd::Constant(state.unknowns(), options.angle_sigma_rad);
  sigma.head<2>().setConstant(options.tilt_sigma_rad);
  sigma.segment<2>(2).setConstant(options.relative_shift_sigma * distance_mm);
  for (std::size_t setup = 1; setup <= state.part_poses.size(); ++setup) {
    sigma.segment<3>(state.index_of_setup(setup)).setConstant(kUnknownShift * distance_mm);
    sigma.segment<3>(state.index_of_setup(setup) + 3).setConstant(kUnknownRotation_rad);
  }
  return sigma;
}

TableState given_state(const TurntableStations& given, const RegisterOptions& options) {
  TableState state{given.table, {}, {}, {}};
  const Eigen::Isometry3d rig_from_table = given.table.rig_from_object(0.0);
  for (const Station& station : given.stations) {
    require(station.setup <= options.part_poses.size(),
            "register_views: each further setup needs a part pose to start from");
    state.angles_rad.push_back(station.angle_rad);
    state.setups.push_back(station.setup);
  }
  for (const Eigen::Isometry3d& part_pose : options.part_poses)
    state.part_poses.push_back(rig_from_table * part_pose * rig_from_table.inverse());
  return state;
}

Bundle make_bundle(const ViewStore& views,
                   const CameraModel& camera,
                   const TableState& given,
                   const RegisterOptions& options,
                   const Run& run) {
  constexpr std::size_t kSamples = 1000;  // of a view, for medians
  // Of one surfel. The distance of a pair has the noise of two, so this is over four of its sigmas.
  constexpr double kGateSigmas = 6.0;
  Bundle bundle{make_surfel_maps(views, camera, kSurfelsPerView, run),
                FastCameraModel(camera),
                given,
                given,
                {}};
  bundle.pairs = choose_view_pairs(bundle.maps, bundle.model, poses_of(given));
  // View 0 is its own closing view when it is the only one of the first setup.
  const std::size_t closing = given.closing_view();
  if (closing != 0) add_view_pair(bundle.pairs, 0, closing);
  std::vector<float> sigmas_mm;
  std::vector<float> distances_mm;
  for (const SurfelMap& map : bundle.maps) {
    for (const auto& surfel : pick_surfels(map, kSamples)) {
      sigmas_mm.push_back(surfel.sigma_mm);
      distances_mm.push_back(surfel.point_mm.norm());
    }
  }
  const auto working_distance_mm = static_cast<double>(median(std::move(distances_mm)));
  bundle.prior_sigma = prior_sigmas(given, options, working_distance_mm);
  bundle.gate_mm = options.relative_reach * working_distance_mm;
  bundle.min_gate_mm = kGateSigmas * static_cast<double>(median(std::move(sigmas_mm)));
  bundle.systematic_mm = options.relative_systematic * working_distance_mm;
  return bundle;
}

PartScale measure_part_scale(const Bundle& bundle,
                             const SurfelLists& surfels,
                             const CameraModel& camera) {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> depths_mm;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const std::vector<Eigen::Isometry3d> poses = poses_of(bundle.state);
  for (std::size_t view = 0; view < surfels.size(); ++view) {
    const Eigen::Isometry3d part_from_rig = poses[view].inverse();
    for (const SurfelMap::Surfel& surfel : surfels[view]) {
      points.emplace_back(part_from_rig * surfel.point_mm.cast<double>());
      depths_mm.push_back(static_cast<double>(surfel.point_mm.z()));
      sum += points.back();
    }
  }
  if (points.empty()) return {};
  const Eigen::Vector3d centroid = sum / static_cast<double>(points.size());
  std::vector<double> radii_mm;
  radii_mm.reserve(points.size());
  for (const Eigen::Vector3d& point : points)
    radii_mm.push_back((point - centroid).norm());
  const auto at = radii_mm.begin() + static_cast<std::ptrdiff_t>(radii_mm.size() * 95 / 100);
  std::nth_element(radii_mm.begin(), at, radii_mm.end());
  return {*at, median(std::move(depths_mm)) / camera.focal_px.x()};
}

}  // namespace frangia
