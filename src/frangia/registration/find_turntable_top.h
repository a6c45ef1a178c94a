#pragma once

#include <cstddef>
#include <optional>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/clip_views.h"
#include "frangia/views/view_store.h"

namespace frangia {

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
/// near the origin of the object frame, or be much wider than everything above it and not stand on
/// the origin itself, as a gear with a hub does; a rim must not lie above the origin. A flange at
/// that height on a table too dark to be measured is still mistaken for a top: the caller reports
/// what it removes.
///
/// @missing  none when no disc or rim meets all criteria
/// @errors   Error(Cancelled)
[[nodiscard]] std::optional<TurntableTop> find_turntable_top(const ViewStore& views,
                                                             const CameraModel& camera,
                                                             const Run& run = {});

/// Clips the top of the turntable from the views, if there is one: it stands still on the table
/// when the part moves, and is no surface of the part.
///
/// @return   the number of points removed
/// @errors   Error(Cancelled)
std::size_t clip_turntable_top(ViewStore& views, const CameraModel& camera, const Run& run = {});

}  // namespace frangia
