#pragma once

#include "frangia/core/run.h"
#include "frangia/registration/internal/optimize_bundle.h"
#include "frangia/registration/register_views.h"

namespace frangia {

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
