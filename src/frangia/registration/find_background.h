#pragma once

#include <cstddef>
#include <span>

#include "frangia/core/image.h"
#include "frangia/core/missing.h"
#include "frangia/core/run.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// What stands still in front of a camera while the part turns: a wall, a bench, a pole.
struct Background {
  int step_px = 1;                 ///< `depth_mm` has every step-th pixel of the camera
  Image<float> depth_mm;           ///< rig frame; NaN: no background there. Empty: none was found
  double from_axis_mm = kMissing;  ///< distance of its nearest points from the axis
  /// Share of the points that stand still, although nothing shows whether they could turn with the
  /// table: too few views, or too narrow a field of view.
  double undecided = 0.0;

  [[nodiscard]] bool found() const { return !depth_mm.empty(); }  ///< whether there is any
};

/// Finds what does not turn with the table, from where the table states the views.
///
/// Points that several views measure at one pixel and one depth stand still, or belong to a surface
/// that looks the same in these views: one of revolution, or one that repeats itself. Such a point
/// is turned with the table into the other views. Where these see through its place to something
/// farther, it does not turn. Whether it does is decided for connected surfaces, by the pixels that
/// are seen through, or by nearly all of them leaving the field of view, as those of a far wall do.
/// Two kinds of surfaces stay: those that show the same height and radius over 90
/// degrees about the axis and are not seen through, and those within the room that moving points
/// sweep, because the table did not turn between such views.
///
/// Tolerances are three of the standard deviations that registration assumes of a turntable, so
/// that an axis or an angle that is off by as much does not make a part a background.
///
/// About 12000 pixels of at most 24 views are compared, whatever the camera and the scan.
///
/// `setups` holds the number of each view's setup. The part has another pose on the table in each
/// setup, so points are turned into views of their own setup only. The background is the same in
/// all setups.
///
/// @units    mm, rig frame
/// @missing  not found where all views have one angle, and where nothing but it would be left
/// @errors   Error(Input) when `setups` is not one for each view; Error(Cancelled)
[[nodiscard]] Background find_background(const ViewStore& views,
                                         const CameraModel& camera,
                                         std::span<const int> setups,
                                         const Run& run = {});

/// Removes the points on the background and behind it from all views.
///
/// @return   the number of removed points
/// @missing  a removed point is NaN
/// @errors   Error(Cancelled)
std::size_t remove_background(ViewStore& views,
                              const CameraModel& camera,
                              const Background& background,
                              const Run& run = {});

/// Finds and removes the background of views of one setup.
///
/// @return   the number of removed points
/// @errors   Error(Cancelled)
std::size_t clip_background(ViewStore& views, const CameraModel& camera, const Run& run = {});

}  // namespace frangia
