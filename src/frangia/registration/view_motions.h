#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/rig/rig.h"

namespace frangia {

struct RegisterOptions;
struct TurntableStations;

/// How the poses of a scan's views may be wrong: small motions of the points that a view measured,
/// in the object frame, by independent changes of the axis, the angles and the part poses of one
/// standard deviation each. A change moves all views at once.
///
/// @shape    one matrix a view; six rows: a rotation (rad) and a translation (mm), which move p by
///           rotation x p + translation; one column for each change
using ViewMotions = std::vector<Eigen::Matrix<double, 6, Eigen::Dynamic>>;

/// A motion that moves a surface along its normals by less than this share of the way, root mean
/// square, leaves it where it is: the pairs do not determine it. Noise of normals and a part off
/// the axis by a tenth of a millimetre stay far below, a keyway or a handle in the view is above.
inline constexpr double kOpenMotion = 0.03;

/// Standard deviations of the axis and the angles of a turntable.
struct TurntableSigma {
  double point_mm = 0.0;   ///< of the place of the axis, in each direction across it
  double axis_rad = 0.0;   ///< of its direction, in each of two
  double angle_rad = 0.0;  ///< of the angle of a view
  bool stated = false;     ///< all three by the rig
};

/// Returns what the rig states, and `unverified_share` of the priors of the refinement for what it
/// does not state.
///
/// @units    `distance_mm`: the working distance
[[nodiscard]] TurntableSigma sigma_of(const Turntable& table,
                                      const RegisterOptions& options,
                                      double distance_mm);

/// Returns the motions of views of one setup whose poses rest on the axis and angles of the rig
/// alone.
///
/// @shape    one for each view
[[nodiscard]] ViewMotions motions_of_rig(const TurntableStations& given,
                                         const TurntableSigma& sigma);

/// Narrows motions by what else is known of one view against the others, whose mean stays: along
/// `known`, of one standard deviation, it moves by no more than that.
///
/// @shape    `points_mm`: of the view, object frame
void narrow_motions(ViewMotions& motions,
                    std::size_t view,
                    const Eigen::Matrix<double, 6, 1>& known,
                    std::span<const Eigen::Vector3f> points_mm);

}  // namespace frangia
