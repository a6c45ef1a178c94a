#pragma once

#include <cstddef>
#include <optional>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"
#include "frangia/core/run.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/clip_views.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Criteria of a turntable top. Relative lengths are shares of the working distance, the median
/// distance of the measured points from the camera.
struct TurntableTopOptions {
  double max_tilt_rad = rad_from_deg(3.0);  ///< of the top against the axis
  double min_share = 0.03;                  ///< of all points that lie on the top, or on its rim
  double max_below = 0.02;        ///< points below the top and within its edge, as a share of those
                                  ///< on it
  double min_visible_edge = 0.6;  ///< share of the directions from the axis in which the edge is
                                  ///< measured
  double max_edge_variation = 0.05;    ///< of the edge's radius, as a share of it
  double relative_max_height = 0.006;  ///< of a top near the origin, above or below it: 3 mm at
                                       ///< 500 mm
  double min_width_ratio = 1.5;  ///< a top that is not near the origin must be this many times as
                                 ///< wide as everything above it; a narrower disc is a base
  double relative_band = 0.004;  ///< thickness of the layer that is searched for a plane: a tilt of
                                 ///< the axis of 1 degree over 60 mm at 500 mm, twice
  double relative_clearance = 0.001;  ///< points nearer to the top than this are mixed with it
  double min_gap = 0.2;  ///< between a rim and everything else, as a share of the rim's radius

  /// @errors   Error(Input) that names the value which is out of its range
  void check() const;
};

/// The top of the turntable in the views.
///
/// @units    mm, object frame as far as the poses of the views are known
struct TurntableTop {
  Eigen::Hyperplane<double, 3> plane;  ///< its normal points up
  double clearance_mm = 0.0;           ///< remove points up to this distance above the plane, too
  bool rim_only = false;  ///< the top is too grazing to be measured: only its rim is in the views

  /// Height of the top on the z axis of the object frame.
  [[nodiscard]] double height_mm() const { return -plane.offset() / plane.normal().z(); }
  /// What keeps the points above it.
  [[nodiscard]] Clip clip() const {
    Clip above;
    above.floor = {plane.normal(), plane.offset() - clearance_mm};
    return above;
  }
};

/// Finds the top of the turntable: a horizontal disc centred on the axis with no points below it
/// but its own rim. When the camera sees the top edge-on, finds only the rim: a cylinder about the
/// axis, below everything else and apart from it.
///
/// A round base or flange of the part has the same shape. A turntable top therefore must also lie
/// near the origin of the object frame, or be much wider than everything above it; a rim must not
/// lie above the origin. A flange at that height on a table too dark to be measured is still
/// mistaken for a top: the caller reports what it removes.
///
/// @missing  none when no disc or rim meets all criteria
/// @errors   Error(Input) as `TurntableTopOptions::check`
[[nodiscard]] std::optional<TurntableTop> find_turntable_top(
    const ViewStore& views,
    const CameraModel& camera,
    const TurntableTopOptions& options = {},
    const Run& run = {});

/// Clips the top of the turntable from the views, if there is one: it stands still on the table
/// when the part moves, and is no surface of the part.
///
/// @return   the number of points removed
/// @errors   as `find_turntable_top`
std::size_t clip_turntable_top(ViewStore& views, const CameraModel& camera, const Run& run = {});

}  // namespace frangia
