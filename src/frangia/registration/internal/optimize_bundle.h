#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/run.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/registration/internal/sum_ties.h"
#include "frangia/registration/internal/turntable_bundle.h"
#include "frangia/registration/internal/view_pairs.h"
#include "frangia/registration/register_views.h"
#include "frangia/rig/camera_model.h"

namespace frangia {

/// A turntable registration in progress.
struct Bundle {
  std::vector<SurfelMap> maps;
  FastCameraModel model;
  TableState given;
  TableState state;
  Eigen::VectorXd prior_sigma;   ///< of each unknown
  double gate_mm = 0.0;          ///< pairs farther apart do not count
  double min_gate_mm = 0.0;      ///< the noise of the surfels allows no narrower gate
  double systematic_mm = 0.0;    ///< error that all pairs of two views have in common
  int iterations = 0;            ///< of all optimizations
  ViewPairs pairs{};             ///< the views that are compared
  std::vector<PointTie> ties{};  ///< points that several views measured
};

/// One list of surfels a view.
using SurfelLists = std::vector<std::vector<SurfelMap::Surfel>>;

/// What changes the distances of views by less than this many times the error that surfaces of
/// sound scans have in common is no fault: some cause far off always explains a part of that.
inline constexpr double kCommonErrors = 2.5;

/// Picks surfels of each view as `pick_surfels` does. Each quarter of a list is one region of the
/// view.
[[nodiscard]] SurfelLists pick_all_surfels(const std::vector<SurfelMap>& maps, std::size_t count);

/// Distance in front of another view's surface from which a point contradicts it.
[[nodiscard]] double free_space_margin_mm(const Bundle& bundle);

/// Compares all views in the state of the bundle, within its gate.
[[nodiscard]] BundleSums sum(const Bundle& bundle, const SurfelLists& surfels);

/// Weight of the pairs relative to the prior, at most 1. The pairs of two views share an error of
/// `systematic_mm`, so that they count as (scatter / systematic_mm)^2 independent ones at most.
[[nodiscard]] double effective_weight(const Bundle& bundle, const BundleSums& sums);

/// Refines the state of the bundle by `minimize_robustly`, with its prior.
void optimize_bundle(Bundle& bundle,
                     const SurfelLists& surfels,
                     int max_iterations,
                     const Run& run);

/// The state that rig, stations and options give to start from.
///
/// @errors   Error(Input) when a further setup has no part pose
[[nodiscard]] TableState given_state(const TurntableStations& given,
                                     const RegisterOptions& options);

/// Standard deviations of the prior of each unknown of a state.
[[nodiscard]] Eigen::VectorXd prior_sigmas(const TableState& state,
                                           const RegisterOptions& options,
                                           double distance_mm);

/// A bundle with the surfel map of each view, in the given state. Lengths of the options are
/// relative to the working distance, the median distance of the surfels from the camera.
[[nodiscard]] Bundle make_bundle(const ViewStore& views,
                                 const CameraModel& camera,
                                 const TableState& given,
                                 const RegisterOptions& options,
                                 const Run& run);

/// Lengths of the measured part.
struct PartScale {
  double radius_mm = 0.0;    ///< 95 % of the surfels are nearer to their centroid
  double sampling_mm = 0.0;  ///< median distance between points of neighbouring pixels
};

[[nodiscard]] PartScale measure_part_scale(const Bundle& bundle,
                                           const SurfelLists& surfels,
                                           const CameraModel& camera);

}  // namespace frangia
