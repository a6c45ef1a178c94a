#include "frangia/registration/internal/make_bundle.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/core/statistics.h"
#include "frangia/local_fit/surfel_map.h"

namespace frangia {
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
